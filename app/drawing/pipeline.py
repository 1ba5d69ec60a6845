"""The whole way from the bytes of an image to a path that a robot draws."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.load import load_image
from app.drawing.order import order_strokes, pen_up_mm
from app.drawing.prepare import prepare
from app.drawing.rasterise import RASTER_MODES, portrait, rasterise
from app.drawing.toolpath import PenSettings, Placement, Toolpath, default_placement, plan_toolpath
from app.drawing.vectorise import MODES as VECTOR_MODES
from app.drawing.vectorise import Settings, vectorise
from app.robots import ROBOTS, GeometryError, Robot, make_robot

Array = NDArray[np.float64]

PORTRAIT = "portrait"
PORTRAIT_LINES = "sketch"
MODES: tuple[str, ...] = ("auto", *VECTOR_MODES, *RASTER_MODES, PORTRAIT)
"""All ways to draw; `auto` chooses among the first."""

PREPARE = frozenset({"width", "gamma", "smooth"})
VECTOR = frozenset(field.name for field in fields(Settings))
PEN = frozenset(field.name for field in fields(PenSettings))
OTHERS = frozenset({"pen_mm", "margin_mm", "weight", "order_s", "seed"})

NO_INK = "There is nothing to draw in this picture: choose another mode, or lower its thresholds."


@dataclass(frozen=True, eq=False)
class Drawing:
    """Strokes on a sheet in the order in which they are drawn, and the robot's path along them."""

    strokes: list[Array]
    """(n, 2) each, mm; the origin in the middle of the sheet, y up."""
    sheet_mm: tuple[float, float]
    mode: str
    """How it was drawn; never `auto`."""
    reason: str
    """Why so, in one sentence."""
    toolpath: Toolpath
    notes: tuple[str, ...] = ()
    """What there is to say about the image, a sentence each."""

    @property
    def ink_mm(self) -> float:
        """Length of all strokes."""
        return sum(float(np.linalg.norm(np.diff(stroke, axis=0), axis=1).sum()) for stroke in self.strokes)

    @property
    def pen_up_mm(self) -> float:
        """Length of the ways between the strokes, from the first stroke's beginning on."""
        return pen_up_mm(self.strokes, tuple(self.strokes[0][0].tolist()))

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
    **parameters: Any,
) -> Drawing:
    """Draw an image on a sheet with a robot.

    Args:
        image_bytes: a JPG, PNG, or another common picture file.
        mode: one of `MODES`.
        sheet_mm: width and height of the sheet, in the middle of which the picture lies as large as it fits.
        robot: name in `ROBOTS`.
        placement: where the sheet lies; by default below the robot's home.
        parameters: of `prepare` (width, gamma, smooth), of the mode (`vectorise.Settings`, or those of
            `RASTER_MODES[mode]`), of the pen (`PenSettings`); and pen_mm (its width, 0.5), margin_mm (0), weight (of
            the tones in a portrait, 0.5), order_s (seconds spent on a better order, 0), seed (0).

    Raises:
        DrawingError: for an image that cannot be read or drawn, a setting that cannot be, or a sheet out of reach;
            its message is one sentence.
    """
    settings = _sorted_out(mode, parameters)
    machine = _robot(robot)
    picture = load_image(image_bytes)
    grey = prepare(picture.grey, **settings.prepare)
    mm_per_px = _scale(grey.shape, sheet_mm, settings.others.get("margin_mm", 0.0))
    pixels, used, reason = _strokes(grey, mode, mm_per_px, settings)
    if not pixels:
        raise DrawingError(NO_INK)
    strokes = on_sheet(pixels, grey.shape, mm_per_px)
    if used != "paper":
        strokes = order_strokes(
            strokes, budget_s=settings.others.get("order_s", 0.0), seed=settings.others.get("seed", 0)
        )
    toolpath = plan_toolpath(strokes, machine, placement or default_placement(machine), PenSettings(**settings.pen))
    return Drawing(strokes, sheet_mm, used, reason, toolpath, picture.notes)


def on_sheet(pixels: Sequence[Array], shape: tuple[int, ...], mm_per_px: float) -> list[Array]:
    """Pixel strokes of a picture (h, w) in sheet millimetres, the picture in the middle, y up."""
    middle = np.array([(shape[1] - 1) / 2, (shape[0] - 1) / 2])
    return [mm_per_px * (np.asarray(stroke, dtype=float) - middle) * np.array([1.0, -1.0]) for stroke in pixels]


@dataclass(frozen=True)
class _Sorted:
    """Parameters by whom they are for."""

    prepare: dict[str, Any]
    mode: dict[str, Any]
    pen: dict[str, Any]
    others: dict[str, Any]


def _sorted_out(mode: str, parameters: dict[str, Any]) -> _Sorted:
    if mode not in MODES:
        raise DrawingError(f"There is no mode called {mode}; choose one of {', '.join(MODES)}.")
    raster = frozenset(parameter.name for parameter in RASTER_MODES[mode].parameters) if mode in RASTER_MODES else None
    of_mode = VECTOR if raster is None else raster
    known = PREPARE | of_mode | PEN | OTHERS
    for name in parameters:
        if name not in known:
            raise DrawingError(f"The mode {mode} has no setting {name}; it has {', '.join(sorted(known))}.")
    groups = (PREPARE, of_mode, PEN, OTHERS)
    return _Sorted(*({name: value for name, value in parameters.items() if name in group} for group in groups))


def _robot(name: str) -> Robot:
    try:
        return make_robot(name)
    except GeometryError as error:
        raise DrawingError(f"There is no robot called {name}; choose one of {', '.join(ROBOTS)}.") from error


def _scale(shape: tuple[int, ...], sheet_mm: tuple[float, float], margin_mm: float) -> float:
    """mm per pixel with which a picture (h, w) fills the sheet inside its margins."""
    room = [side - 2.0 * margin_mm for side in sheet_mm]
    if not (margin_mm >= 0.0 and all(0.0 < side < 5000.0 for side in room)):
        raise DrawingError(
            f"A sheet of {sheet_mm[0]:g} x {sheet_mm[1]:g} mm with margins of {margin_mm:g} mm has no room to draw on."
        )
    return min(room[0] / shape[1], room[1] / shape[0])


def _strokes(grey: NDArray[np.uint8], mode: str, mm_per_px: float, settings: _Sorted) -> tuple[list[Array], str, str]:
    """Pixel strokes, the mode used, and why."""
    pen_mm = settings.others.get("pen_mm", 0.5)
    if mode in RASTER_MODES:
        strokes = rasterise(grey, mode, mm_per_px, pen_mm=pen_mm, **settings.mode)
        return strokes, mode, RASTER_MODES[mode].explanation
    found = vectorise(grey, PORTRAIT_LINES if mode == PORTRAIT else mode, mm_per_px, **settings.mode)
    if mode != PORTRAIT:
        return found.strokes, found.mode, found.reason
    weight = settings.others.get("weight", 0.5)
    strokes = portrait(found.strokes, grey, mm_per_px, pen_mm=pen_mm, weight=weight)
    return strokes, mode, "Lines tell who it is, light tones give the face its shape."
