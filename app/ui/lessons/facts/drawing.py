"""The tab Draw as lessons read and set it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from app.classroom.lessons.lesson import Value
from app.drawing.errors import DrawingError
from app.drawing.modes import DRAWING_MODES
from app.drawing.samples import SAMPLES
from app.drawing.toolpath import Placement
from app.errors import UserMistake
from app.ui.desks import Desks
from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.jobs import Plan, Sketch
from app.ui.lessons.facts.field import Field, Read, deg

PEN: Mapping[str, str] = {
    "lift": "lift",
    "lift_height": "lift_mm",
    "speed": "speed_mm_s",
    "up_speed": "up_speed_mm_s",
    "laser": "laser",
}
LOOK: Mapping[str, tuple[str, float]] = {"margin": ("margin_mm", 1.0), "scale": ("scale", 0.01), "pen": ("pen_mm", 1.0)}
"""Field, and the factor from what is read."""

OF_SKETCH: Mapping[str, Callable[[Sketch], Value]] = {
    "used_mode": lambda sketch: sketch.mode,
    "strokes": lambda sketch: len(sketch.strokes),
    "lifts": lambda sketch: len(sketch.strokes) - 1 if sketch.setup.pen.rises else 0,
    "ink": lambda sketch: sketch.ink_mm,
    "pen_up": lambda sketch: sketch.between_mm,
    "retraced": lambda sketch: 100.0 * sketch.retraced,
    "similarity": lambda sketch: math.nan if sketch.similarity is None else 100.0 * sketch.similarity,
    "out_of_reach": lambda sketch: _share_outside(sketch),
}
OF_PLAN: Mapping[str, Callable[[Plan], Value]] = {
    "time": lambda plan: plan.time_s,
    "stray_ink": lambda plan: plan.stray_ink_mm,
    "joint_speed": lambda plan: 100.0 * plan.peak_speed,
}


class DrawingFacts:
    """`drawing.*`."""

    def __init__(self, desks: Desks) -> None:
        self._desks = desks

    def field(self) -> Field:
        return Field(
            {**self._settings(), **self._results()},
            {**self._source_writers(), **self._sheet_writers(), **self._pen_writers()},
            read_each={"drawing.knob.": self._knob},
            write_each={"drawing.knob.": self._turn},
        )

    def _settings(self) -> dict[str, Read]:
        desk, placement = self._get, lambda: self._get().placement
        read: dict[str, Read] = {f"drawing.{name}": partial(self._pen, field) for name, field in PEN.items()}
        read |= {f"drawing.{name}": partial(self._look, field, factor) for name, (field, factor) in LOOK.items()}
        return {
            **read,
            "drawing.sample": lambda: name if (name := desk().source_name) in SAMPLES else "",
            "drawing.text": lambda: desk().text,
            "drawing.source": lambda: desk().source_name,
            "drawing.own": lambda: desk().source is not None and desk().source_name not in SAMPLES,
            "drawing.mode": lambda: desk().settings.look.mode,
            "drawing.sheet": lambda: desk().settings.sheet,
            "drawing.landscape": lambda: desk().settings.landscape,
            "drawing.sheet_x": lambda: 1e3 * placement().centre_m[0],
            "drawing.sheet_y": lambda: 1e3 * placement().centre_m[1],
            "drawing.sheet_z": lambda: 1e3 * placement().height_m,
            "drawing.sheet_turn": lambda: deg(placement().rotation_rad),
        }

    def _results(self) -> dict[str, Read]:
        desk = self._get
        sketch = {f"drawing.{name}": partial(self._of_sketch, get) for name, get in OF_SKETCH.items()}
        plan = {f"drawing.{name}": partial(self._of_plan, get) for name, get in OF_PLAN.items()}
        return {
            **sketch,
            **plan,
            "drawing.ready": lambda: self._sketch() is not None,
            "drawing.planned": lambda: self._plan() is not None,
            "drawing.refused": lambda: bool(self._refusal()),
            "drawing.refusal": self._refusal,
            "drawing.improved": lambda: desk().is_improved,
            "drawing.drawn": lambda: 100.0 * self._desks.player.progress,
            "drawing.exported": lambda: desk().is_saved and self._sketch() is not None,
        }

    def _source_writers(self) -> dict[str, Callable[[Any], None]]:
        desk = self._get
        return {
            "drawing.sample": lambda name: desk().take_sample(name),
            "drawing.text": lambda text: desk().take_text(text),
            "drawing.mode": lambda mode: desk().choose_mode(mode),
            "drawing.preset": lambda name: desk().choose_preset(name),
            **{f"drawing.{name}": partial(self._set_look, field, factor) for name, (field, factor) in LOOK.items()},
        }

    def _sheet_writers(self) -> dict[str, Callable[[Any], None]]:
        desk = self._get
        return {
            "drawing.sheet": lambda sheet: desk().choose_sheet(sheet, desk().settings.landscape),
            "drawing.landscape": lambda across: desk().choose_sheet(desk().settings.sheet, across),
            "drawing.sheet_x": lambda mm: self._move(lambda p: replace(p, centre_m=(1e-3 * mm, p.centre_m[1]))),
            "drawing.sheet_y": lambda mm: self._move(lambda p: replace(p, centre_m=(p.centre_m[0], 1e-3 * mm))),
            "drawing.sheet_z": lambda mm: self._move(lambda p: replace(p, height_m=1e-3 * mm)),
            "drawing.sheet_turn": lambda angle: self._move(lambda p: replace(p, rotation_rad=math.radians(angle))),
        }

    def _pen_writers(self) -> dict[str, Callable[[Any], None]]:
        return {f"drawing.{name}": partial(self._set_pen, field) for name, field in PEN.items()}

    def _get(self) -> DrawingDesk:
        return self._desks.drawing

    def _pen(self, field: str) -> Value:
        return getattr(self._get().settings.pen, field)

    def _set_pen(self, field: str, value: Any) -> None:
        try:
            self._get().set_pen(**{field: value})
        except DrawingError as mistake:
            raise UserMistake(str(mistake)) from mistake

    def _look(self, field: str, factor: float) -> Value:
        return getattr(self._get().settings.look, field) / factor

    def _set_look(self, field: str, factor: float, value: float) -> None:
        self._get().turn(**{field: value * factor})

    def _move(self, change: Callable[[Placement], Placement]) -> None:
        self._get().move_sheet(change(self._get().placement))

    def _knob(self, name: str) -> Value | None:
        """As set, or the mode's own; NaN for one that the mode finds by itself."""
        look = self._get().settings.look
        parameters = {each.name: each for each in DRAWING_MODES[look.mode].parameters}
        if name not in parameters:
            return None
        value = look.parameters.get(name, DRAWING_MODES[look.mode].defaults[name])
        return float(value) if isinstance(value, float | int) else math.nan

    def _turn(self, name: str, value: float) -> None:
        mode = DRAWING_MODES[self._get().settings.look.mode]
        names = [each.name for each in mode.parameters]
        if name not in names:
            raise UserMistake(f"The mode {mode.title} has no {name}: it has {', '.join(names)}.")
        self._get().turn(**{name: float(value)})

    def _sketch(self) -> Sketch | None:
        """Of what is set; None while it is not there."""
        desk = self._get()
        desk.look()
        return desk.sketch if desk.up_to_date else None

    def _plan(self) -> Plan | None:
        return self._get().plan if self._sketch() is not None else None

    def _refusal(self) -> str:
        desk = self._get()
        desk.look()
        return desk.refusal.reason if desk.refusal is not None else ""

    def _of_sketch(self, get: Callable[[Sketch], Value]) -> Value | None:
        sketch = self._sketch()
        return None if sketch is None else get(sketch)

    def _of_plan(self, get: Callable[[Plan], Value]) -> Value | None:
        plan = self._plan()
        return None if plan is None else get(plan)


def _share_outside(sketch: Sketch) -> float:
    points = sum(len(mask) for mask in sketch.outside)
    return 100.0 * sum(int(mask.sum()) for mask in sketch.outside) / points if points else 0.0
