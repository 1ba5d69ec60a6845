"""The laws in the order of their errors, with every axis, and what became of the order before."""

from __future__ import annotations

import html
from collections.abc import Mapping

from app.control.laws import LAWS
from app.ui import theme
from app.ui.compare.desk import Comparison, Look
from app.ui.compare.score import IN_PLANE, Score, ranking, unit_of
from app.ui.panels.compare.marks import component_mark, fine_figure, law_mark
from app.ui.panels.tables import table
from app.ui.panels.text import small

BEST = "★"
MEANING = {
    "p": "spring",
    "d": "damper",
    "i": "integral",
    "M": "moves the masses",
    "n": "gravity, Coriolis",
    "ff": "fed forward",
    "dob": "observer",
    "s": "sliding",
    "qp": "planned ahead",
}
"""What a part of the effort is, in a word."""


def ranking_table(comparison: Comparison, look: Look, places_before: Mapping[str, int]) -> str:
    """HTML: one row a law, the best of each column marked."""
    scores = comparison.scores
    order = ranking(scores, look.quantity, look.stretch)
    notes = "".join(_refusal(law, reason) for law, reason in comparison.refusals.items())
    if not order:
        return notes
    shown = [name for name in scores[order[0]].quantities if name != IN_PLANE or look.quantity == IN_PLANE]
    best = {name: ranking(scores, name, look.stretch)[0] for name in shown}
    saturated = {law: max(score.saturation) for law, score in scores.items()}
    any_saturated = max(saturated.values()) > 0.0
    head = ("law", *shown, *(("limit",) if any_saturated else ()))
    rows = []
    for place, law in enumerate(order, 1):
        cells = [_cell(scores[law].rms_of(name, look.stretch), law == best[name]) for name in shown]
        limit = (f"{saturated[law]:.0%}",) if any_saturated else ()
        rows.append((_first_cell(place, law, places_before.get(law)), *cells, *limit))
    units = " and ".join(dict.fromkeys(map(unit_of, shown)))
    title = (
        f"<b>RMS error of the tool</b> in {units}, {look.stretch.lower()}, in the order of {html.escape(look.quantity)}"
    )
    legend = f"{BEST} best of its column."
    if any_saturated:
        legend += " <b>limit</b>: share of the time in which a drive gives all it has."
    return small(title) + f'<div style="overflow-x:auto">{table(head, rows)}</div>' + notes + small(legend)


def verdict(comparison: Comparison, look: Look, changed: str, places_before: Mapping[str, int]) -> str:
    """HTML: who is first, and what the change of settings has done."""
    order = ranking(comparison.scores, look.quantity, look.stretch)
    if not order:
        return ""
    now = " &lt; ".join(map(law_mark, order))
    lines = [f"RMS error in <b>{html.escape(look.quantity)}</b>: {now}"]
    if changed and places_before:
        before = sorted(places_before, key=lambda law: places_before[law])
        same = before == order
        then = "the same order" if same else " &lt; ".join(map(law_mark, before))
        lines.append(f"Before ({html.escape(changed)}): {then}")
    return small("<br>".join(lines))


def shares_table(law: str, score: Score, joint_names: tuple[str, ...]) -> str:
    """HTML: which part of a law does how much of the work, joint by joint."""
    rows = [
        (f"{component_mark(name)}: {MEANING.get(name, name)}", *(f"{100.0 * share:.0f}" for share in shares))
        for name, shares in score.shares.items()
        if any(share > 0.0 for share in shares)
    ]
    title = small(f"<b>What the effort of {law_mark(law)} is made of</b>: RMS of each part over the sum of all")
    return title + table(("share, %", *joint_names), rows)


def law_notes(laws: tuple[str, ...]) -> str:
    """HTML: a sentence on each law."""
    return "".join(small(f"{law_mark(law)}: {html.escape(LAWS[law].note)}") for law in laws)


def _cell(value: float, best: bool) -> str:
    text = fine_figure(value)
    return f'<b>{text}<span style="font-size:.75em">{BEST}</span></b>' if best else text


def _first_cell(place: int, law: str, before: int | None) -> str:
    move = ""
    if before is not None and before != place:
        arrow = "▲" if before > place else "▼"
        move = f' <span title="Before: {before}." style="font-size:.8em">{arrow}{abs(before - place)}</span>'
    return f'<span style="white-space:nowrap">{place}. {law_mark(law)}{move}</span>'


def _refusal(law: str, reason: str) -> str:
    return small(f'<span style="color:{theme.css(theme.WARNING)}">▲</span> {law_mark(law)}: {html.escape(reason)}')
