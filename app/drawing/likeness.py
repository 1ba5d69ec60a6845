"""How like its picture a drawing looks from a little away, fast enough for every step of a slider."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.rasterise import similarity

PEN_PX = 1.6
"""Width of the pen in the pixels in which the two are compared; finer pixels cost time and change little."""

FINE_PEN = 4.0
"""Samples across the pen; after the blur, twice as many change nothing that one sees."""


def likeness(grey: NDArray[np.uint8], strokes: Sequence[NDArray[np.float64]], mm_per_px: float, pen_mm: float) -> float:
    """`similarity` (0..1) of PIXEL strokes with a picture (h, w), made smaller if that shows all there is to see."""
    shrink = PEN_PX * mm_per_px / pen_mm
    if shrink >= 1.0:
        return similarity(grey, strokes, mm_per_px, pen_mm, FINE_PEN)
    height, width = grey.shape
    size = max(round(shrink * width), 1), max(round(shrink * height), 1)
    small = np.asarray(cv2.resize(grey, size, interpolation=cv2.INTER_AREA), np.uint8)
    share = np.array([size[0] / width, size[1] / height])
    moved = [(stroke + 0.5) * share - 0.5 for stroke in strokes]
    return similarity(small, moved, mm_per_px / float(share.max()), pen_mm, FINE_PEN)
