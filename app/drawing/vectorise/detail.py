"""How coarse the detail of a picture is: a deviation that suits one size of picture, made to suit another."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

USUAL_PX = 512
GROWTH = 0.7
"""A picture twice as long shows its detail 2^0.7 times as long, and some more of it."""


def detail_scale(shape: tuple[int, ...]) -> float:
    """Factor for a deviation in pixels that was found on pictures 512 pixels long; shape: (h, w)."""
    return (max(shape) / USUAL_PX) ** GROWTH


def blurred(image: NDArray, sigma: float) -> NDArray:
    """Gaussian of a deviation in pixels; 0 for none."""
    return cv2.GaussianBlur(image, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE) if sigma > 0.0 else np.asarray(image)
