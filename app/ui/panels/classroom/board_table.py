"""The live board as HTML: who needs help first, and where everybody is."""

from __future__ import annotations

import html
from collections.abc import Sequence

from app.classroom.board import Bar, BoardRow
from app.ui import theme
from app.ui.panels.text import small

STYLE = f"""<style>
.deltalab-board {{ width: calc(100% - 24px); margin: 4px 12px; border-collapse: collapse; font-size: 0.82em;
  line-height: 1.35; font-variant-numeric: tabular-nums; }}
.deltalab-board th {{ text-align: left; font-weight: 600; opacity: 0.75; padding: 2px 6px 2px 0; }}
.deltalab-board td {{ padding: 2px 6px 2px 0; border-top: 1px solid var(--mantine-color-default-border); }}
.deltalab-board td:not(:first-child, :last-child) {{ white-space: nowrap; }}
.deltalab-board button {{ font: inherit; color: inherit; background: none; border: none; padding: 4px 0;
  cursor: pointer; text-align: left; text-decoration: underline dotted; overflow-wrap: anywhere; min-height: 28px; }}
.deltalab-board tr.chosen td {{ background: rgba(28,111,196,.16); }}
.deltalab-board tr.away {{ opacity: 0.55; }}
.deltalab-board b.hand {{ color: {theme.css(theme.MARK)}; }}
.deltalab-board b.stuck {{ color: {theme.css(theme.WARNING)}; }}
.deltalab-bars {{ margin: 4px 12px; font-size: 0.82em; line-height: 1.5; }}
.deltalab-bars div {{ display: grid; grid-template-columns: 130px 1fr 24px; gap: 6px; align-items: center; }}
.deltalab-bars span {{ overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }}
.deltalab-bars i {{ display: block; height: 12px; border-radius: 3px; background: {theme.css(theme.LEGS[0])}; }}
@media (pointer: coarse) {{ .deltalab-board button {{ min-height: 44px; }} }}
</style>"""
"""To be put on the page once."""

HEAD = ("Student", "Step", "Done", "Min", "Needs")


def board_table(rows: Sequence[BoardRow], chosen: str, wire: str) -> str:
    """A row a student, in the order given; a press on a name says `pick ID` through the text input `wire`."""
    if not rows:
        return small("Nobody has joined yet: show the QR code under Invite.")
    head = "".join(f"<th>{title}</th>" for title in HEAD)
    body = "".join(_row(row, row.member_id == chosen, wire) for row in rows)
    return f'<table class="deltalab-board"><tr>{head}</tr>{body}</table>'


def summary(rows: Sequence[BoardRow]) -> str:
    """One line about all of them."""
    here, hands = sum(row.online for row in rows), sum(row.hand_s is not None for row in rows)
    stuck = sum(row.stuck_s is not None for row in rows)
    return small(f"<b>{here}</b> of {len(rows)} here · <b>{hands}</b> raised hands · <b>{stuck}</b> stuck")


def bars(histogram: Sequence[Bar]) -> str:
    """How many students are at each step."""
    if not histogram:
        return small("Nobody has opened a lesson yet.")
    most = max(1, *(bar.count for bar in histogram))
    return f'<div class="deltalab-bars">{"".join(_bar(bar, most) for bar in histogram)}</div>'


def short_key(lesson: str) -> str:
    """The number in a lesson's key, or all of it."""
    return lesson.partition("-")[0] or lesson


def minutes(seconds: float) -> str:
    """Whole ones, so that the board changes seldom."""
    return "< 1" if seconds < 60 else f"{int(seconds // 60)}"


def _for(seconds: float) -> str:
    return "" if seconds < 60 else f" {minutes(seconds)} min"


def _row(row: BoardRow, chosen: bool, wire: str) -> str:
    classes = " ".join(name for name, so in (("chosen", chosen), ("away", not row.online)) if so)
    pick = f'type="button" data-press="{html.escape(row.member_id)}" data-wire="{html.escape(wire)}"'
    name = f'<button {pick} aria-pressed="{str(chosen).lower()}">{html.escape(row.name)}</button>'
    if row.lesson:
        cells = [f"{html.escape(short_key(row.lesson))} · {row.step}", f"{row.checks}/{row.checks_of}"]
        cells.append(minutes(row.seconds))
    else:
        cells = ["exploring", "", ""]
    body = "".join(f"<td>{cell}</td>" for cell in (name, *cells, _needs(row)))
    return f'<tr class="{classes}">{body}</tr>'


def _needs(row: BoardRow) -> str:
    words = []
    if row.hand_s is not None:
        words.append(f'<b class="hand">◆ hand{_for(row.hand_s)}</b>')
    if row.stuck_s is not None:
        words.append(f'<b class="stuck">▲ stuck{_for(row.stuck_s)}</b>')
    if row.holds_robot:
        words.append("has the robot")
    if not row.online:
        words.append("away")
    return "<br>".join(words)


def _bar(bar: Bar, most: int) -> str:
    title = html.escape(f"{short_key(bar.lesson)} · {bar.step} {bar.title}")
    names = html.escape(", ".join(bar.names))
    share = round(100 * bar.count / most)
    return f'<div title="{names}"><span title="{title}">{title}</span><i style="width:{share}%"></i>{bar.count}</div>'
