"""Small print between the inputs of a panel."""

from __future__ import annotations

import html

from app.ui import theme


def small(content: str) -> str:
    """HTML content as a short line of explanation."""
    return f'<div style="padding:1px 12px 5px;font-size:0.82em;line-height:1.4;opacity:0.9">{content}</div>'


def problem(sentence: str) -> str:
    """HTML of why something cannot be."""
    return small(f'<b style="color:{theme.css(theme.WARNING)}">▲ {html.escape(sentence)}</b>')
