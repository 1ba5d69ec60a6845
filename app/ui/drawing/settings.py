"""What a student has set for a drawing. Immutable: a change makes a new one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from app.drawing.compose import Look
from app.drawing.modes import PRESETS
from app.drawing.source import Source
from app.drawing.toolpath import PenSettings, Placement, Sheet, default_pen, default_placement, sheet_fits
from app.drawing.toolpath.placement import SHEETS
from app.robots import Robot

LARGER_THAN_ANY_REACH = "A3"
SHEETS_MM: dict[str, tuple[float, float]] = {
    sheet.name: (float(sheet.width_mm), float(sheet.height_mm))
    for sheet in reversed(SHEETS)
    if sheet.name != LARGER_THAN_ANY_REACH
}
"""From the smallest to the largest, upright."""

FLAT = 1.1
"""A picture whose sides differ by less is as good on either sheet."""

OF_LOOK = frozenset(one.name for one in fields(Look)) - {"mode", "sheet_mm", "parameters", "weight"}


@dataclass(frozen=True)
class DrawingSettings:
    """How a picture becomes strokes, on which sheet, and how the pen is moved."""

    look: Look = field(default_factory=Look)
    sheet: str = "A5"
    landscape: bool = False
    placement: Placement | None = None
    """None: where the robot has room around it."""
    pen: PenSettings = field(default_factory=PenSettings)

    @property
    def sheet_mm(self) -> tuple[float, float]:
        """Width and height as it lies."""
        width, height = SHEETS_MM[self.sheet]
        return (height, width) if self.landscape else (width, height)


def default_settings(robot: Robot) -> DrawingSettings:
    """A5 and a photo's lines."""
    return turned_to_fit(DrawingSettings(pen=default_pen(robot)), robot, False)


def resized(settings: DrawingSettings, sheet: str, landscape: bool) -> DrawingSettings:
    """On another sheet."""
    settings = replace(settings, sheet=sheet, landscape=landscape)
    return replace(settings, look=replace(settings.look, sheet_mm=settings.sheet_mm))


def turned_to_fit(settings: DrawingSettings, robot: Robot, landscape: bool | None) -> DrawingSettings:
    """The sheet as the picture wants it (None: as it lies), unless only the other way is in the robot's reach."""
    wanted = resized(settings, settings.sheet, settings.landscape if landscape is None else landscape)
    other = resized(wanted, wanted.sheet, not wanted.landscape)
    placement = settings.placement or default_placement(robot)
    for one in (wanted, other):
        if sheet_fits(Sheet(one.sheet, *one.sheet_mm), robot, placement, one.pen.lift_mm):
            return one
    return wanted


def lies_flat(source: Source) -> bool | None:
    """Whether a picture wants its sheet in landscape; None where it does not matter."""
    if source.grey is None or max(source.grey.shape) < FLAT * min(source.grey.shape):
        return None
    return source.grey.shape[1] > source.grey.shape[0]


def moved_to(settings: DrawingSettings, robot: Robot) -> DrawingSettings:
    """Before another robot: the sheet lies where that has room, and the pen is lifted as suits it."""
    return replace(settings, placement=None, pen=replace(settings.pen, lift_mm=default_pen(robot).lift_mm))


def with_mode(settings: DrawingSettings, mode: str, parameters: Mapping[str, Any] | None = None) -> DrawingSettings:
    """Another mode, with its own values but for `parameters`."""
    return turned(replace(settings, look=replace(settings.look, mode=mode, parameters={})), **(parameters or {}))


def with_preset(settings: DrawingSettings, name: str) -> DrawingSettings:
    """One of `PRESETS`."""
    preset = PRESETS[name]
    return with_mode(settings, preset.mode, preset.parameters)


def turned(settings: DrawingSettings, **knobs: Any) -> DrawingSettings:
    """With other values of the mode's parameters, or of the picture on the sheet (`margin_mm`, `scale`, ...)."""
    own = {name: knobs.pop(name) for name in list(knobs) if name in OF_LOOK}
    look = replace(settings.look, **own, parameters={**settings.look.parameters, **knobs})
    return replace(settings, look=look)
