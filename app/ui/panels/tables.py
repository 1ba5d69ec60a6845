"""Small tables of HTML: the first column names, the others are numbers."""

from __future__ import annotations

import html
from collections.abc import Sequence

STYLE = (
    "width:calc(100% - 24px);margin:4px 12px;font-size:0.8em;line-height:1.6;border-collapse:collapse;"
    "font-variant-numeric:tabular-nums"
)


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Cells are HTML, the head is text. The last cell of a short row takes the rest of its width."""
    titles = "".join(
        f'<th style="{"text-align:left" if k == 0 else "text-align:right;padding-left:6px"}">{html.escape(name)}</th>'
        for k, name in enumerate(head)
    )
    return f'<table style="{STYLE}"><tr>{titles}</tr>{"".join(_row(row, len(head)) for row in rows)}</table>'


def _row(cells: Sequence[str], width: int) -> str:
    last = len(cells) - 1
    spans = [f' colspan="{width - last}"' if k == last and last + 1 < width else "" for k in range(len(cells))]
    sides = [_side(k) if not span else "text-align:left" for k, span in enumerate(spans)]
    shown = zip(cells, spans, sides, strict=True)
    return f"<tr>{''.join(f'<td{span} style={side!r}>{cell}</td>' for cell, span, side in shown)}</tr>"


def _side(column: int) -> str:
    return "text-align:left" if column == 0 else "text-align:right;white-space:nowrap;padding-left:6px"
