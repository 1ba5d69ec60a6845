"""Tones: how much ink a grey wants, and how hard a mode must be driven to give it.

Darkness is 0 for white and 1 for black. Paper cannot be blacker than neighbouring lines make it without tearing, so
black wants MAX_COVER of ink; tones under LEAST_TONE count as white and get none.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from app.drawing.errors import DrawingError
from app.drawing.rasterise.ink import ink_cover
from app.drawing.rasterise.types import Field, Grey, Mask, Stroke

MAX_COVER = 0.8
LEAST_TONE = 0.05

MAX_BRUSH = 30
"""Pixels; what is white and wider is kept free even of a wider pen, for the sake of time."""

Lay = Callable[..., list[Stroke]]
"""(drive (h, w) in 0..1, inked (h, w), pen in pixels, **parameters) -> PIXEL strokes; uncalibrated."""

CALIBRATION_STEPS = 17
"""Hatching has as many levels, and each is met in its middle."""

CALIBRATION_PEN = 2.0
"""Width of the pen in the pixels of the calibration picture."""

CALIBRATION_SIDE = 40
"""Side of one flat patch, in pen widths."""

CALIBRATION_FINE_PEN = 12.0
"""Samples across the pen; see `ink_cover`."""


def tone_of(grey: Grey) -> Field:
    """Darkness (h, w) in 0..1."""
    return (1.0 - grey / 255.0).astype(np.float32)


def pen_in_pixels(pen_mm: float, mm_per_px: float) -> float:
    """The pen's width."""
    if not (0 < mm_per_px < math.inf and 0 < pen_mm < math.inf):
        raise DrawingError("The scale and the pen's width must be positive; give both in millimetres.")
    return pen_mm / mm_per_px


def inked_where(tone: Field, pen: float) -> Mask:
    """Where there may be ink at all, (h, w): not over white, unless that is narrower than the pen of `pen` pixels."""
    inked = tone >= LEAST_TONE
    size = 2 * int(min(pen, MAX_BRUSH) / 2) + 1
    if size == 1 or inked.all():
        return inked
    brush = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size))
    return cv2.morphologyEx(inked.astype(np.uint8), cv2.MORPH_CLOSE, brush) > 0


def wanted_cover(tone: Field) -> Field:
    """The share of the paper that ink should cover, (h, w)."""
    return np.where(tone >= LEAST_TONE, np.float32(MAX_COVER) * tone, np.float32(0.0))


def softened(field: Field, sigma: float) -> Field:
    """What a line sees of a picture whose details are finer than the lines; `sigma` in pixels."""
    if sigma <= 0.3:
        return field
    return np.asarray(cv2.GaussianBlur(field, (0, 0), sigma, borderType=cv2.BORDER_REFLECT), np.float32)


def drive_for(lay: Lay, cover: Field, **parameters: float) -> Field:
    """How hard to drive `lay` for the wanted cover, (h, w) in 0..1."""
    drives, covers = _calibration(lay, tuple(sorted(parameters.items())))
    return np.interp(cover, covers, drives).astype(np.float32)


@lru_cache(maxsize=64)
def _calibration(
    lay: Lay, parameters: tuple[tuple[str, float], ...]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(drive, cover) pairs, both increasing: lines laid over flat patches, and their ink measured."""
    side = round(CALIBRATION_SIDE * CALIBRATION_PEN)
    drives = np.linspace(0.0, 1.0, CALIBRATION_STEPS)
    # fades out towards the border, so that it matters little how many rows fit in
    window = np.hanning(side) ** 2
    window /= window.sum()
    covers = []
    for drive in drives:
        flat = np.full((side, side), drive, np.float32)
        strokes = lay(flat, np.ones_like(flat, bool), CALIBRATION_PEN, **dict(parameters))
        cover = ink_cover(strokes, flat.shape, CALIBRATION_PEN, CALIBRATION_FINE_PEN)
        covers.append(window @ cover @ window)
    return drives, np.maximum.accumulate(covers)


def sample(field: Field, x: NDArray[np.float64], y: NDArray[np.float64]) -> Field:
    """Values between the pixels, bilinear; x and y in pixels, of shapes that broadcast."""
    where = np.stack(np.broadcast_arrays(y, x))
    return np.asarray(map_coordinates(field, where, order=1, mode="nearest", prefilter=False), np.float32)


def sample_mask(mask: Mask, x: NDArray[np.float64], y: NDArray[np.float64]) -> Mask:
    """The nearest pixel's value; x and y as in `sample`."""
    height, width = mask.shape
    column, row = (np.clip(np.rint(at), 0, side - 1).astype(np.int64) for at, side in ((x, width), (y, height)))
    return mask[row, column]
