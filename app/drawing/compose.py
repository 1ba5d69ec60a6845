"""From a source to strokes on a sheet in the order in which they are drawn: what every preview and file shows."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.modes import AUTO, DRAWING_MODES, PAPER, PORTRAIT, PORTRAIT_LINES
from app.drawing.order import join_touching, order_strokes
from app.drawing.prepare import prepare
from app.drawing.rasterise import RASTER_MODES, portrait, rasterise, similarity
from app.drawing.source import Source
from app.drawing.toolpath.placement import Sheet, fit_to_sheet
from app.drawing.vectorise import vectorise

Array = NDArray[np.float64]
Grey = NDArray[np.uint8]
OnStage = Callable[[str], None]

STROKES = "strokes"
"""The mode of a composition of a source without a picture."""

STAGES = ("lines", "order", "likeness")
NO_INK = "There is nothing to draw in this picture: choose another mode, or lower its thresholds."
PICTURE = frozenset({"width", "gamma", "smooth"})
LARGEST_SCALE = 10.0


@dataclass(frozen=True)
class Look:
    """How a source is to look on its sheet."""

    mode: str = AUTO
    """One of `DRAWING_MODES`."""
    sheet_mm: tuple[float, float] = (148.0, 210.0)
    """Width and height."""
    margin_mm: float = 10.0
    scale: float = 1.0
    """Of what fits inside the margins."""
    pen_mm: float = 0.5
    """Width of the pen's line."""
    weight: float = 0.5
    """Of the tones of a portrait, 0 to 1; a parameter of this name comes first."""
    parameters: Mapping[str, Any] = field(default_factory=dict)
    """Of the mode, by the names in `DRAWING_MODES`; "auto" leaves one to the mode."""


@dataclass(frozen=True, eq=False)
class Composition:
    """A drawing on its sheet."""

    strokes: list[Array]
    """(n, 2) each, sheet millimetres, in the order in which they are drawn; those that touch are one."""
    mode: str
    """How it was drawn: never `auto`; `strokes` for a source without a picture."""
    reason: str
    """Why so, in one sentence."""
    notes: tuple[str, ...]
    """What there is to say about the source and the drawing, a sentence each."""
    similarity: float | None
    """0 to 1, how like the picture the ink looks from a little away; None without a picture."""
    prepared: Grey | None
    """(h, w) the picture as the mode saw it."""
    mm_per_px: float
    """Of the prepared picture on the sheet; 1 without one."""


class _Lines(NamedTuple):
    """Strokes in pixels, and how they came about."""

    strokes: list[Array]
    mode: str
    reason: str


def compose(
    source: Source, look: Look, *, order_s: float = 0.0, seed: int = 0, on_stage: OnStage = lambda _stage: None
) -> Composition:
    """Draw a source on a sheet.

    order_s: seconds to spend on a still better order; on_stage: is told when one of `STAGES` begins.
    DrawingError for what cannot be drawn.
    """
    if look.mode not in DRAWING_MODES:
        raise DrawingError(f"There is no mode called {look.mode}; choose one of {', '.join(DRAWING_MODES)}.")
    on_stage("lines")
    if source.grey is None:
        strokes = _fitted(source.strokes or [], look)
        lines, grey, mm_per_px = _Lines(strokes, STROKES, "The source is strokes already."), None, 1.0
    else:
        settings = _settings(look)
        grey = prepare(source.grey, **{name: settings.pop(name) for name in PICTURE & settings.keys()})
        mm_per_px = look.scale * min(side / pixels for side, pixels in zip(_room(look), grey.shape[::-1], strict=True))
        lines = _traced(grey, mm_per_px, look, settings)
        strokes = on_sheet(lines.strokes, grey.shape, mm_per_px)
    if not strokes:
        raise DrawingError(NO_INK)
    on_stage("order")
    if lines.mode != PAPER:
        strokes = join_touching(order_strokes(strokes, budget_s=order_s, seed=seed))
    on_stage("likeness")
    like = None if grey is None else similarity(grey, lines.strokes, mm_per_px, look.pen_mm)
    return Composition(strokes, lines.mode, lines.reason, source.notes, like, grey, mm_per_px)


def on_sheet(pixels: Sequence[Array], shape: tuple[int, ...], mm_per_px: float) -> list[Array]:
    """Pixel strokes of a picture (h, w) in sheet millimetres, the picture in the middle, y up."""
    middle = np.array([(shape[1] - 1) / 2, (shape[0] - 1) / 2])
    return [mm_per_px * (np.asarray(stroke, dtype=float) - middle) * np.array([1.0, -1.0]) for stroke in pixels]


def _room(look: Look) -> tuple[float, float]:
    """Width and height inside the margins, mm."""
    width, height = (side - 2.0 * look.margin_mm for side in look.sheet_mm)
    if not (look.margin_mm >= 0.0 and 0.0 < width < 5000.0 and 0.0 < height < 5000.0):
        raise DrawingError(
            f"A sheet of {look.sheet_mm[0]:g} x {look.sheet_mm[1]:g} mm with margins of {look.margin_mm:g} mm has no "
            "room to draw on; choose a larger sheet or smaller margins."
        )
    if not 0.0 < look.scale <= LARGEST_SCALE:
        raise DrawingError(f"A scale of {look.scale:g} is not possible; choose one above 0, up to {LARGEST_SCALE:g}.")
    return width, height


def _fitted(strokes: Sequence[Array], look: Look) -> list[Array]:
    _room(look)
    return [look.scale * stroke for stroke in fit_to_sheet(strokes, Sheet("chosen", *look.sheet_mm), look.margin_mm)]


def _settings(look: Look) -> dict[str, Any]:
    """The parameters that are set; a mode that has its own `smooth` keeps it."""
    return {name: value for name, value in look.parameters.items() if value != AUTO}


def _traced(grey: Grey, mm_per_px: float, look: Look, settings: dict[str, Any]) -> _Lines:
    """Strokes in the pixels of a prepared picture (h, w)."""
    if look.mode in RASTER_MODES:
        strokes = rasterise(grey, look.mode, mm_per_px, pen_mm=look.pen_mm, **settings)
        return _Lines(strokes, look.mode, RASTER_MODES[look.mode].explanation)
    weight = settings.pop("weight", look.weight)
    found = vectorise(grey, PORTRAIT_LINES if look.mode == PORTRAIT else look.mode, mm_per_px, **settings)
    if look.mode != PORTRAIT:
        return _Lines(found.strokes, found.mode, found.reason)
    strokes = portrait(found.strokes, grey, mm_per_px, pen_mm=look.pen_mm, weight=weight)
    return _Lines(strokes, PORTRAIT, "Lines tell who it is, light tones give the face its shape.")
