"""The borders of flat shapes: Canny's edges again, but only clear ones, and blurred little."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from app.drawing.prepare import LEAST_HIGH, Threshold, gradients
from app.drawing.vectorise.canny import canny_edges
from app.drawing.vectorise.detail import blurred, detail_scale

BLUR = 0.8
"""Deviation in pixels, on a picture 512 pixels long: shapes keep their corners."""

CLEAR_SHARE = 0.2
"""Of the steepest slope: what shapes of several tones have, and noise and JPEG's ripples have not."""


def outline_edges(
    grey: NDArray[np.uint8], aperture: int = 3, low: Threshold = "auto", high: Threshold = "auto"
) -> tuple[NDArray[np.bool_], NDArray[np.float32]]:
    """(mask of the borders of shapes, size of the gradient), both (h, w), of a picture (h, w)."""
    if high == "auto":
        size = gradients(blurred(grey, BLUR * detail_scale(grey.shape)), aperture).size
        high = max(CLEAR_SHARE * float(size.max()), LEAST_HIGH, 0.0 if isinstance(low, str) else low)
    return canny_edges(grey, aperture, low, high, BLUR)
