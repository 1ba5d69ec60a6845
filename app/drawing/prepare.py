"""What is done to a grey picture before lines are sought in it, under the paper's names.

The paper has the sliders width, gamma, smooth, aperture, low threshold and high threshold, without their ranges.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError

MAX_WIDTH_PX = 4000
MAX_GAMMA = 10.0
MAX_SMOOTH = 51
APERTURES = {3: 1.0, 5: 1 / 16, 7: 1 / 256}
"""Size of the Sobel kernel -> what brings its answer to that of the smallest."""

AUTO_QUANTILE = 0.9
LEAST_HIGH = 30.0
LOW_SHARE = 0.4

Threshold = float | Literal["auto"]


@dataclass(frozen=True, eq=False)
class Gradients:
    """Slopes of a picture, as `cv2.Canny` takes them."""

    dx: NDArray[np.int16]
    """(h, w), in units of a 3 x 3 Sobel kernel: eight times the grey levels per pixel."""
    dy: NDArray[np.int16]

    @property
    def size(self) -> NDArray[np.float32]:
        """(h, w) length of the gradient."""
        return np.hypot(self.dx.astype(np.float32), self.dy.astype(np.float32))


def prepare(
    grey: NDArray[np.uint8], *, width: int | None = None, gamma: float = 1.0, smooth: int = 0
) -> NDArray[np.uint8]:
    """A grey picture (h, w), resized, brightened and blurred, in this order.

    width: of the result in pixels, keeping the aspect; None leaves it.
    gamma: 255 (v / 255)^gamma, so that more than 1 darkens and less brightens.
    smooth: size of a Gaussian kernel, odd; 0 or 1 for none. OpenCV's deviation for 7 is 1.4 pixels. Every mode but
    the paper's blurs as it needs by itself: this is to be rid of noise and of detail.
    """
    _check(width, gamma, smooth)
    if width is not None:
        grey = _resized(grey, round(width))
    if gamma != 1.0:
        grey = np.round(255.0 * np.linspace(0.0, 1.0, 256) ** gamma).astype(np.uint8)[grey]
    return np.asarray(cv2.GaussianBlur(grey, (int(smooth), int(smooth)), 0), np.uint8) if smooth > 1 else grey


def gradients(grey: NDArray[np.uint8], aperture: int = 3) -> Gradients:
    """Slopes of a picture (h, w). A larger aperture, 5 or 7, smooths more; the thresholds keep their meaning."""
    if aperture not in APERTURES:
        raise DrawingError(f"An aperture of {aperture} is not possible; choose 3, 5 or 7.")
    scale = APERTURES[aperture]
    dx, dy = (cv2.Sobel(grey, cv2.CV_32F, *along, ksize=int(aperture), scale=scale) for along in ((1, 0), (0, 1)))
    return Gradients(np.rint(dx).astype(np.int16), np.rint(dy).astype(np.int16))


def thresholds(size: NDArray[np.float32], low: Threshold = "auto", high: Threshold = "auto") -> tuple[float, float]:
    """Canny's (low, high): edges start where the gradient's `size` exceeds high, and end where it falls below low.

    "auto" takes for high what a tenth of the picture exceeds, at least 30, and for low two fifths of high.
    """
    for name, value in (("low", low), ("high", high)):
        if isinstance(value, str) and value != "auto":
            raise DrawingError(f'The {name} threshold cannot be "{value}"; give a number or "auto".')
    if isinstance(high, str):
        high = max(float(np.quantile(size, AUTO_QUANTILE)), LEAST_HIGH, 0.0 if isinstance(low, str) else low)
    if isinstance(low, str):
        low = LOW_SHARE * high
    if not 0.0 <= low <= high < np.inf:
        raise DrawingError(f"The low threshold, {low:g}, must be at least 0 and at most the high one, {high:g}.")
    return float(low), float(high)


def _check(width: int | None, gamma: float, smooth: int) -> None:
    if width is not None and not 1 <= width <= MAX_WIDTH_PX:
        raise DrawingError(f"A width of {width} pixels is not possible; choose 1 to {MAX_WIDTH_PX}.")
    if not 1.0 / MAX_GAMMA <= gamma <= MAX_GAMMA:
        raise DrawingError(f"A gamma of {gamma:g} is not possible; choose {1.0 / MAX_GAMMA:g} to {MAX_GAMMA:g}.")
    if not 0 <= smooth <= MAX_SMOOTH or (smooth and smooth % 2 != 1):
        raise DrawingError(f"A smooth of {smooth} is not possible; choose 0 for none or an odd number to {MAX_SMOOTH}.")


def _resized(grey: NDArray[np.uint8], width: int) -> NDArray[np.uint8]:
    height = max(round(grey.shape[0] * width / grey.shape[1]), 1)
    if height > MAX_WIDTH_PX:
        raise DrawingError(f"A width of {width} pixels makes this picture {height} high; choose a smaller one.")
    how = cv2.INTER_AREA if width < grey.shape[1] else cv2.INTER_CUBIC
    return np.asarray(cv2.resize(grey, (width, height), interpolation=how), np.uint8)
