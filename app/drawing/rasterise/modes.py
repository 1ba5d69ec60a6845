"""All ways to rasterise by name, and the one function that checks and calls them."""

from __future__ import annotations

import numpy as np

from app.drawing.errors import DrawingError
from app.drawing.rasterise.hatch import HATCH
from app.drawing.rasterise.mode import Parameter, RasterMode
from app.drawing.rasterise.one_line import ONE_LINE
from app.drawing.rasterise.spiral import SPIRAL
from app.drawing.rasterise.squiggle import SQUIGGLE
from app.drawing.rasterise.stipple import STIPPLE
from app.drawing.rasterise.streamlines import STREAMLINES
from app.drawing.rasterise.threshold_rows import THRESHOLD_ROWS
from app.drawing.rasterise.tone import LEAST_TONE, pen_in_pixels, tone_of
from app.drawing.rasterise.types import Grey, Stroke

RASTER_MODES: dict[str, RasterMode] = {
    "squiggle": SQUIGGLE,
    "hatch": HATCH,
    "streamlines": STREAMLINES,
    "spiral": SPIRAL,
    "one_line": ONE_LINE,
    "threshold_rows": THRESHOLD_ROWS,
    "stipple": STIPPLE,
}
"""The first is the default."""

MAX_PIXELS = 4_000_000
MAX_PEN = 100
"""Pixels."""

MAX_PENS = 1_000_000
"""Area of the picture in squares of the pen's width; a sheet of A3 has 500 000 under a pen of 0.5 mm."""


def rasterise(grey: Grey, mode: str, mm_per_px: float, *, pen_mm: float = 0.5, **parameters: float) -> list[Stroke]:
    """PIXEL strokes that give the tones of a picture (h, w) with a pen; DrawingError for what cannot be drawn.

    `parameters` are those of RASTER_MODES[mode]; the same input always gives the same strokes.
    """
    if mode not in RASTER_MODES:
        raise DrawingError(f"There is no way to rasterise called {mode!r}; choose one of {', '.join(RASTER_MODES)}.")
    chosen = RASTER_MODES[mode]
    _check_picture(grey)
    _check_parameters(chosen, parameters)
    pen = pen_in_pixels(pen_mm, mm_per_px)
    if pen > MAX_PEN:
        raise DrawingError(f"The pen is more than {MAX_PEN} pixels wide; make the picture smaller or take a finer pen.")
    if grey.size / pen**2 > MAX_PENS:
        raise DrawingError("The pen is too fine for a drawing this large; take a wider pen or draw it smaller.")
    tone = tone_of(grey)
    if tone.max() < LEAST_TONE:
        return []
    return chosen.draw(tone, pen, **(chosen.defaults | parameters))


def _check_picture(grey: Grey) -> None:
    if not isinstance(grey, np.ndarray) or grey.ndim != 2 or grey.dtype != np.uint8 or not grey.size:
        raise DrawingError("The picture must be a grey one with at least one pixel; convert it to 8 bits of grey.")
    if grey.size > MAX_PIXELS:
        raise DrawingError(f"The picture has more than {MAX_PIXELS // 1_000_000} megapixels; make it smaller first.")


def _check_parameters(mode: RasterMode, given: dict[str, float]) -> None:
    known: dict[str, Parameter] = {parameter.name: parameter for parameter in mode.parameters}
    for name, value in given.items():
        if name not in known:
            raise DrawingError(f"{mode.title} has no setting {name!r}; its settings are {', '.join(known)}.")
        low, high = known[name].low, known[name].high
        if not low <= value <= high:
            raise DrawingError(f"{known[name].label} must lie between {low:g} and {high:g}, not at {value:g}.")
