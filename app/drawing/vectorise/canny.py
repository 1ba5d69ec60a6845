"""Edges where the tone changes, by Canny, each traced once."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.prepare import Threshold, gradients, thresholds
from app.drawing.vectorise.detail import blurred, detail_scale

BLUR = 1.4
"""Deviation in pixels, on a picture 512 pixels long, of the Gaussian with which Canny begins. OpenCV leaves it out."""


def canny_edges(
    grey: NDArray[np.uint8],
    aperture: int = 3,
    low: Threshold = "auto",
    high: Threshold = "auto",
    blur: float = BLUR,
) -> tuple[NDArray[np.bool_], NDArray[np.float32]]:
    """(Canny's edge mask, size of the gradient), both (h, w), of a picture (h, w)."""
    slopes = gradients(blurred(grey, blur * detail_scale(grey.shape)), aperture)
    size = slopes.size
    edges = cv2.Canny(slopes.dx, slopes.dy, *thresholds(size, low, high), L2gradient=True)
    return edges > 0, size
