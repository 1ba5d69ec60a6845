"""How like the wanted picture the ink looks from a little away."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.rasterise.ink import FINE_PEN, ink_cover
from app.drawing.rasterise.tone import pen_in_pixels, tone_of, wanted_cover
from app.drawing.rasterise.types import Grey, Stroke

BLUR_MM = 1.5
"""Standard deviation of the blur that stands for looking from a little away."""

SSIM_K1, SSIM_K2 = 0.01, 0.03


def similarity(
    grey: Grey, strokes: Sequence[Stroke], mm_per_px: float, pen_mm: float, fine_pen: float = FINE_PEN
) -> float:
    """Structural similarity (0..1) of the blurred ink with the blurred wanted cover; PIXEL strokes.

    `fine_pen`: see `ink_cover`.
    """
    wanted, inked = _from_away(grey, strokes, mm_per_px, pen_mm, fine_pen)
    return float(np.clip(_ssim(wanted, inked).mean(), 0.0, 1.0))


def affine_error(grey: Grey, strokes: Sequence[Stroke], mm_per_px: float, pen_mm: float) -> float:
    """Root mean square error of the blurred cover, after the best brightness and contrast; PIXEL strokes."""
    wanted, inked = (field.ravel() for field in _from_away(grey, strokes, mm_per_px, pen_mm))
    model = np.column_stack([inked, np.ones_like(inked)])
    solution = np.linalg.lstsq(model, wanted, rcond=None)[0]
    return float(np.sqrt(np.mean((model @ solution - wanted) ** 2)))


def _from_away(
    grey: Grey, strokes: Sequence[Stroke], mm_per_px: float, pen_mm: float, fine_pen: float = FINE_PEN
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Wanted and inked cover (h, w), both blurred."""
    pen = pen_in_pixels(pen_mm, mm_per_px)
    sigma = BLUR_MM / mm_per_px
    wanted = wanted_cover(tone_of(grey))
    inked = ink_cover(strokes, wanted.shape, pen, fine_pen)
    return _blurred(wanted.astype(np.float64), sigma), _blurred(inked.astype(np.float64), sigma)


def _blurred(field: NDArray[np.float64], sigma: float) -> NDArray[np.float64]:
    return np.asarray(cv2.GaussianBlur(field, (0, 0), sigma, borderType=cv2.BORDER_REFLECT), np.float64)


def _ssim(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Wang et al. 2004 for values in 0..1, in uniform windows of 7 pixels as scikit-image's default."""

    def mean(field: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(cv2.blur(field, (7, 7), borderType=cv2.BORDER_REFLECT), np.float64)

    mean_a, mean_b = mean(a), mean(b)
    var_a, var_b = mean(a * a) - mean_a**2, mean(b * b) - mean_b**2
    together = mean(a * b) - mean_a * mean_b
    c1, c2 = SSIM_K1**2, SSIM_K2**2
    return (2 * mean_a * mean_b + c1) * (2 * together + c2) / ((mean_a**2 + mean_b**2 + c1) * (var_a + var_b + c2))
