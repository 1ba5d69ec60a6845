"""Dark lines as a portraitist sees them: a difference of Gaussians, smoothed along the flow of the picture.

After Kang, Lee and Chui, Coherent line drawing (2007), with round Gaussians before the smoothing along the flow: by
eye the same drawing. It draws a dark line once, where Canny draws its two sides.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.vectorise.detail import blurred, detail_scale

Image = NDArray[np.float32]

TENSOR_SIGMA, FLOW_SIGMA = 2.5, 3.0
NARROW_SIGMA, WIDE_SIGMA = 1.2, 1.92
"""Pixels, as the two above, on a picture 512 pixels long."""

WIDE_SHARE = 0.99
FLOW_STEPS = 6
"""To either side along the flow, three to a deviation."""

STRONG_FLOOR, WEAK_FLOOR = 0.008, 0.004
"""Of white: so faint a line is none, however empty the picture."""


def sketch_lines(grey: NDArray[np.uint8], strong: float = 0.06, weak: float = 0.12) -> tuple[NDArray[np.bool_], Image]:
    """(mask of dark lines, how dark each is against its surroundings), both (h, w), of a picture (h, w).

    strong, weak: the shares of the picture's pixels that start a line, and that may continue one.
    """
    if not 0.0 < strong <= weak < 1.0:
        raise DrawingError(f"The shares of a sketch must rise: 0 < strong, {strong:g}, <= weak, {weak:g}, < 1.")
    tone = grey.astype(np.float32) / 255.0
    scale = detail_scale(grey.shape)
    narrow, wide = (blurred(tone, sigma * scale) for sigma in (NARROW_SIGMA, WIDE_SIGMA))
    darkness = np.float32(WIDE_SHARE) * wide - narrow
    response = along_flow(darkness, *_flow(tone, TENSOR_SIGMA * scale), FLOW_SIGMA * scale)
    return _continued(response, strong, weak), response


def _flow(tone: Image, sigma: float) -> tuple[Image, Image]:
    """(x, y) of a unit vector along the lines around each pixel, either way, from the blurred structure tensor."""
    dx, dy = cv2.Sobel(tone, cv2.CV_32F, 1, 0), cv2.Sobel(tone, cv2.CV_32F, 0, 1)
    xx, xy, yy = (blurred(product, sigma) for product in (dx * dx, dx * dy, dy * dy))
    along = 0.5 * np.arctan2(2.0 * xy, xx - yy) + np.float32(np.pi / 2.0)
    return np.cos(along), np.sin(along)


def along_flow(values: Image, flow_x: Image, flow_y: Image, sigma: float) -> Image:
    """Gaussian mean of `values` along the curve that follows the flow through each pixel."""
    start_y, start_x = np.indices(values.shape, np.float32)
    total, weights = values.copy(), np.float32(1.0)
    pace = np.float32(2.0 * sigma / FLOW_STEPS)
    for way in (1.0, -1.0):
        x, y, way_x, way_y = start_x, start_y, way * flow_x, way * flow_y
        for step in range(1, FLOW_STEPS + 1):
            x, y = x + pace * way_x, y + pace * way_y
            weight = np.exp(-0.5 * (step * pace / sigma) ** 2, dtype=np.float32)
            total += weight * _sampled(values, x, y, cv2.INTER_LINEAR)
            weights += weight
            next_x, next_y = (_sampled(part, x, y, cv2.INTER_NEAREST) for part in (flow_x, flow_y))
            same_way = np.copysign(np.float32(1.0), next_x * way_x + next_y * way_y)
            way_x, way_y = same_way * next_x, same_way * next_y
    return total / weights


def _sampled(image: Image, x: Image, y: Image, how: int) -> Image:
    return np.asarray(cv2.remap(image, x, y, how, borderMode=cv2.BORDER_REPLICATE), np.float32)


def _continued(response: Image, strong: float, weak: float) -> NDArray[np.bool_]:
    """Pixels above the weak level that hang together with one above the strong level."""
    high, low = np.quantile(response, (1.0 - strong, 1.0 - weak))
    count, patch = cv2.connectedComponents((response > max(low, WEAK_FLOOR)).astype(np.uint8))
    starts = np.zeros(count, bool)
    starts[patch[response > max(high, STRONG_FLOOR)]] = True
    starts[0] = False
    return starts[patch]
