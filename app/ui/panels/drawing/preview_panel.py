"""The drawing beside the picture it comes from, and its numbers."""

from __future__ import annotations

import base64
import html

import viser

from app.drawing.modes import DRAWING_MODES
from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.jobs import Plan, Sketch, TooDense
from app.ui.panels.text import problem, small
from app.ui.refusal import Refusal

LEGEND = "Strokes run from blue (first) to orange (last); thin grey lines are ways with the pen up."
STRAY = "Strokes run from blue (first) to orange (last); orange lines are ways that the pen draws for want of a lift."


class PreviewPanel:
    """Pictures, and a table unless there is only room for the pictures."""

    def __init__(self, gui: viser.GuiApi, desk: DrawingDesk, *, height: str = "44vh", table: bool = True) -> None:
        self._desk = desk
        self._height = height
        self._pictures = gui.add_html(small("The drawing is being made …"))
        self._table = gui.add_html("", visible=table)
        self._problem = gui.add_html("", visible=False)
        desk.sketched.connect(self._show)
        desk.planned.connect(lambda _: self._tabulate())
        desk.refused.connect(self._tell)

    def _show(self, sketch: Sketch) -> None:
        shown = _figure("Drawing", 3, "png", sketch.preview, self._height)
        if sketch.original is not None:
            shown = _figure("Picture", 2, "jpeg", sketch.original, self._height) + shown
        legend = small(STRAY if sketch.setup.pen.marks_hops else LEGEND)
        self._pictures.content = (
            f'<div style="display:flex;gap:8px;padding:8px 12px 2px;align-items:flex-start">{shown}</div>{legend}'
        )
        self._tabulate()

    def _tabulate(self) -> None:
        desk = self._desk
        if desk.sketch is not None and self._table.visible:
            self._table.content = numbers_table(desk.sketch, desk.plan, waiting=desk.no_way is None)

    def _tell(self, refusal: Refusal | TooDense | None) -> None:
        self._problem.visible = refusal is not None
        self._tabulate()
        if refusal is not None:
            if self._desk.sketch is None:
                self._pictures.content = ""
            kept = small("The last drawing stays.") if self._desk.plan is not None else ""
            self._problem.content = problem(refusal.reason) + kept


def _figure(caption: str, share: int, kind: str, data: bytes, height: str) -> str:
    """HTML of a picture that takes its share of the width."""
    source = f"data:image/{kind};base64,{base64.b64encode(data).decode()}"
    return (
        f'<figure style="margin:0;flex:{share} 1 0;min-width:0;text-align:center">'
        f'<img alt="{caption}" src="{source}" style="max-width:100%;max-height:{height};object-fit:contain">'
        f'<figcaption style="font-size:0.78em;opacity:0.8">{caption}</figcaption></figure>'
    )


def numbers_table(sketch: Sketch, plan: Plan | None, *, waiting: bool) -> str:
    """HTML: what the drawing costs, and what comes of it; `waiting` for the plan."""
    strokes = sketch.strokes
    lifts = len(strokes) - 1 if sketch.setup.pen.rises else 0
    unplanned = "out of reach" if not sketch.is_reachable else "…" if waiting else "none"
    rows = [
        ("Mode", html.escape(mode_title(sketch.mode))),
        ("Strokes", f"{len(strokes)}"),
        ("Ink", _length(sketch.ink_mm)),
        ("Pen up" if lifts or sketch.setup.pen.laser else "Between strokes", _length(sketch.between_mm)),
        ("Lifts", f"{lifts}"),
        ("Drawing time", duration(plan.time_s) if plan else unplanned),
    ]
    if plan is not None and plan.stray_ink_mm:
        rows.append(("Stray ink", _length(plan.stray_ink_mm)))
    if plan is not None:
        rows.append(("Joint speed", f"{plan.peak_speed:.0%} of limit"))
    if sketch.similarity is not None:
        rows.append(("Similar tones", f"{sketch.similarity:.0%}"))
    right = "text-align:right;white-space:nowrap"
    cells = [f'<td>{name}</td><td style="{right}"><b>{value}</b></td>' for name, value in rows]
    pairs = [
        f'<tr>{cells[k]}<td style="width:14px"></td>{cells[k + 1] if k + 1 < len(cells) else "<td></td><td></td>"}</tr>'
        for k in range(0, len(cells), 2)
    ]
    notes = "".join(small(html.escape(note)) for note in sketch.notes)
    return (
        '<table style="width:calc(100% - 24px);margin:2px 12px 4px;font-size:0.82em;line-height:1.6;'
        f'border-collapse:collapse;font-variant-numeric:tabular-nums">{"".join(pairs)}</table>{notes}'
    )


def mode_title(mode: str) -> str:
    """For students."""
    return DRAWING_MODES[mode].title if mode in DRAWING_MODES else "Strokes as they are"


def duration(seconds: float) -> str:
    """Minutes and seconds."""
    if seconds < 10.0:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest:02d} s" if minutes else f"{rest} s"


def _length(mm: float) -> str:
    return f"{mm:.0f} mm" if mm < 1000 else f"{mm / 1e3:.2f} m"
