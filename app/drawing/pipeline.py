"""The whole way from the bytes of an image to a path that a robot draws."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.drawing.compose import Look, OnStage, compose
from app.drawing.errors import DrawingError
from app.drawing.modes import DRAWING_MODES
from app.drawing.order import between_mm, ink_mm
from app.drawing.settings import checked_settings, is_number
from app.drawing.source import read_source
from app.drawing.toolpath import PenSettings, Placement, Toolpath, default_pen, default_placement, plan_toolpath
from app.robots import ROBOTS, GeometryError, Robot, make_robot

Array = NDArray[np.float64]

MODES: tuple[str, ...] = tuple(DRAWING_MODES)
"""All ways to draw; `auto` chooses among the first."""

STAGES = ("picture", "lines", "order", "likeness", "path")
"""What `on_stage` is told, in this order."""

PEN = frozenset(field.name for field in fields(PenSettings))
LOOK = frozenset({"pen_mm", "margin_mm", "scale", "weight"})
ORDER = frozenset({"order_s", "seed"})
LONGEST_ORDER_S = 600.0


@dataclass(frozen=True, eq=False)
class Drawing:
    """Strokes on a sheet in the order in which they are drawn, and the robot's path along them."""

    strokes: list[Array]
    """(n, 2) each, mm; the origin in the middle of the sheet, y up."""
    sheet_mm: tuple[float, float]
    mode: str
    """How it was drawn: never `auto`; `strokes` for an SVG or a file of points."""
    reason: str
    """Why so, in one sentence."""
    toolpath: Toolpath
    notes: tuple[str, ...] = ()
    """What there is to say about the image, a sentence each."""

    @property
    def ink_mm(self) -> float:
        """Length of all strokes."""
        return ink_mm(self.strokes)

    @property
    def pen_up_mm(self) -> float:
        """Length of the ways between the strokes, along the sheet.

        It is measured from the first stroke's beginning on: the toolpath begins above that point, and the robot's way
        there depends on where it happens to be.
        """
        return between_mm(self.strokes)

    @property
    def lifts(self) -> int:
        """How often the pen is lifted between strokes."""
        return len(self.strokes) - 1

    @property
    def time_s(self) -> float:
        """Duration of the toolpath: the estimate is the trajectory itself."""
        return self.toolpath.duration_s


def draw_image(
    image_bytes: bytes,
    mode: str = "auto",
    sheet_mm: tuple[float, float] = (160.0, 160.0),
    robot: str = "delta3",
    placement: Placement | None = None,
    on_stage: OnStage = lambda _stage: None,
    **parameters: Any,
) -> Drawing:
    """Draw an image on a sheet with a robot.

    Args:
        image_bytes: a JPG, PNG, or another common picture file; or an SVG or a Ptos_Dibujo.txt, whose strokes are
            drawn as they are.
        mode: one of `MODES`.
        sheet_mm: width and height of the sheet, in the middle of which the picture lies as large as it fits.
        robot: name in `ROBOTS`.
        placement: where the sheet lies; by default below the robot's home.
        on_stage: told when each of `STAGES` begins.
        parameters: of `prepare` (width, gamma, smooth), of the mode (`vectorise.Settings`, or those of
            `RASTER_MODES[mode]`, whose own smooth comes first), of the pen (`PenSettings`); and pen_mm (its width,
            0.5), margin_mm (0), scale (1), weight (of the tones in a portrait, 0.5), order_s (seconds spent on a
            better order, 0), seed (0).

    Raises:
        DrawingError: for an image that cannot be read or drawn, a setting that cannot be, or a sheet out of reach;
            its message is one sentence.
    """
    of_mode = checked_settings(mode, parameters, PEN | LOOK | ORDER)
    look = {"margin_mm": 0.0, **_numbers(parameters, LOOK)}
    order = _numbers(parameters, ORDER)
    if not 0.0 <= order.get("order_s", 0.0) <= LONGEST_ORDER_S:
        raise DrawingError(f"The setting order_s must lie between 0 and {LONGEST_ORDER_S:g} seconds.")
    machine = _robot(robot)
    pen = replace(default_pen(machine), **_numbers(parameters, PEN))
    on_stage("picture")
    source = read_source("picture", image_bytes)
    drawn = compose(source, Look(mode, sheet_mm, parameters=of_mode, **look), on_stage=on_stage, **order)
    on_stage("path")
    toolpath = plan_toolpath(drawn.strokes, machine, placement or default_placement(machine), pen)
    return Drawing(drawn.strokes, sheet_mm, drawn.mode, drawn.reason, toolpath, drawn.notes)


def _robot(name: str) -> Robot:
    try:
        return make_robot(name)
    except GeometryError as error:
        raise DrawingError(f"There is no robot called {name}; choose one of {', '.join(ROBOTS)}.") from error


def _numbers(parameters: dict[str, Any], names: frozenset[str]) -> dict[str, Any]:
    """Those of the parameters with such a name."""
    found = {name: value for name, value in parameters.items() if name in names}
    for name, value in found.items():
        if not (is_number(value) or isinstance(value, bool)):
            raise DrawingError(f"The setting {name} cannot be {value!r}; give it a number, or yes or no.")
    return found
