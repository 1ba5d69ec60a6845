"""Lines and tones together: the contours tell who it is, light hatching gives the face its shape."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.drawing.errors import DrawingError
from app.drawing.rasterise.modes import rasterise
from app.drawing.rasterise.types import Grey, Stroke


def portrait(
    lines: Sequence[Stroke],
    grey: Grey,
    mm_per_px: float,
    *,
    pen_mm: float = 0.5,
    weight: float = 0.5,
    mode: str = "hatch",
    **parameters: float,
) -> list[Stroke]:
    """`lines` (PIXEL strokes) followed by the tones of `grey` in `mode`, lightened to the share `weight` (0..1)."""
    if not 0.0 <= weight <= 1.0:
        raise DrawingError("The weight of the tones must lie between 0 (lines only) and 1 (full tones).")
    light = np.rint(255 - weight * (255.0 - np.asarray(grey))).astype(np.uint8)
    return [*lines, *rasterise(light, mode, mm_per_px, pen_mm=pen_mm, **parameters)]
