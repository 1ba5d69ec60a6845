"""What a pen of exact width leaves on the paper."""

from __future__ import annotations

import math
from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.rasterise.types import Field, Stroke

FINE_PEN = 8.0
"""The pen's width in the pixels of the simulation, at least, while the simulation stays affordable."""

STAIRCASE = 0.08
"""By how much of those pixels a line of pixels is wider to each side: 0 along rows and diagonals, 0.2 at most."""

MAX_FINE_PIXELS = 20_000_000


def render_ink(
    strokes: Sequence[Stroke], size_mm: tuple[float, float], pen_mm: float, px_per_mm: float = 4.0
) -> NDArray[np.uint8]:
    """A grey picture (h, w) of a sheet of `size_mm` (width, height): 255 is paper, 0 is ink.

    `strokes` are SHEET strokes: millimetres from the middle of the sheet, y up.
    """
    width, height = (max(1, round(side * px_per_mm)) for side in size_mm)
    middle = np.array([width - 1, height - 1]) / 2
    pixels = [stroke * (px_per_mm, -px_per_mm) + middle for stroke in strokes]
    return np.rint(255 * (1 - ink_cover(pixels, (height, width), pen_mm * px_per_mm))).astype(np.uint8)


def ink_cover(strokes: Sequence[Stroke], shape: tuple[int, int], pen: float, fine_pen: float = FINE_PEN) -> Field:
    """The inked share (h, w) of every pixel, under a round pen `pen` pixels wide; PIXEL strokes.

    The pen is at least `fine_pen` samples wide if the picture is not too large. With 8, lines are right to 4 % of
    their width and dots to 7 % of their area.
    """
    height, width = shape
    if not strokes:
        return np.zeros(shape, np.float32)
    # an odd number, so that the middle of a pixel stays the middle of one
    most = math.isqrt(MAX_FINE_PIXELS // (height * width))
    fine = max(1, min(math.ceil(fine_pen / pen) | 1, (most - 1) | 1))
    off_line = np.full((height * fine, width * fine), 255, np.uint8)
    # cv2 counts 1/16 pixels here, and cuts off what lies beyond the picture
    points = np.rint(((np.concatenate(strokes) + 0.5) * fine - 0.5) * 16).astype(np.int32)
    points = np.split(points, np.cumsum([len(stroke) for stroke in strokes[:-1]]))
    cv2.polylines(off_line, points, False, 0, 1, cv2.LINE_8, 4)
    distance = cv2.distanceTransform(off_line, cv2.DIST_L2, cv2.DIST_MASK_5)
    ink = np.clip(pen * fine / 2 + 0.5 - STAIRCASE - distance, 0.0, 1.0)
    return np.asarray(cv2.resize(ink, (width, height), interpolation=cv2.INTER_AREA), np.float32)
