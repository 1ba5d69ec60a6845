"""The direction in which a picture runs: along its edges, and smoothly in between."""

from __future__ import annotations

import cv2
import numpy as np

from app.drawing.rasterise.types import Field

COARSER = 5.0
"""Where the picture is flat, what this many times as far around says."""

FAR = 0.1
"""Weight of that."""

EVERYWHERE = 1e-6
"""Weight of the direction of a picture without any edge: diagonal."""


def flow_of(tone: Field, sigma: float, size: tuple[int, int]) -> tuple[Field, Field]:
    """(cos, sin) of the direction of least change within `sigma` pixels; the sign means nothing.

    Both are enlarged to `size` (width, height), which has the proportions of the picture.
    """
    calm = cv2.GaussianBlur(tone, (0, 0), max(sigma / 3, 0.5), borderType=cv2.BORDER_REFLECT)
    along_x = cv2.Sobel(calm, cv2.CV_32F, 1, 0, scale=1 / 8, borderType=cv2.BORDER_REFLECT)
    along_y = cv2.Sobel(calm, cv2.CV_32F, 0, 1, scale=1 / 8, borderType=cv2.BORDER_REFLECT)
    # doubled angles, in which opposite gradients agree
    double = np.dstack([along_x**2 - along_y**2, 2 * along_x * along_y])
    near = cv2.GaussianBlur(double, (0, 0), sigma, borderType=cv2.BORDER_REFLECT)
    far = cv2.GaussianBlur(near, (0, 0), COARSER * sigma, borderType=cv2.BORDER_REFLECT)
    mixed = near + FAR * far + np.array([0.0, -EVERYWHERE], np.float32)
    mixed = cv2.resize(mixed, size, interpolation=cv2.INTER_LINEAR)
    angle = np.arctan2(mixed[..., 1], mixed[..., 0]) / 2 + np.float32(np.pi / 2)
    return np.asarray(np.cos(angle), np.float32), np.asarray(np.sin(angle), np.float32)
