"""Small print between the inputs of a panel."""

from __future__ import annotations


def small(content: str) -> str:
    """HTML content as a short line of explanation."""
    return f'<div style="padding:1px 12px 5px;font-size:0.82em;line-height:1.4;opacity:0.9">{content}</div>'
