"""Ink on paper computed the slow way, and pictures to draw, for tests of what rasterises."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

Stroke = NDArray[np.float64]
Grey = NDArray[np.uint8]


def ink(strokes: Sequence[Stroke], shape: tuple[int, int], pen: float, fine: int = 6) -> NDArray[np.float64]:
    """The inked share (h, w) of each pixel: `fine`^2 samples in it, each inked if within half a pen of a stroke."""
    height, width = shape
    if not strokes:
        return np.zeros(shape)
    along = np.concatenate([_dense(stroke, pen / 12) for stroke in strokes])
    x, y = ((np.arange(side * fine) + 0.5) / fine - 0.5 for side in (width, height))
    samples = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    near = KDTree(along).query(samples, distance_upper_bound=pen / 2)[0] <= pen / 2
    return near.reshape(height, fine, width, fine).mean(axis=(1, 3))


def flat(darkness: float, side: int) -> Grey:
    return np.full((side, side), round(255 * (1 - darkness)), np.uint8)


def face(side: int) -> Grey:
    """Shaded ellipses, about as dark as a portrait."""
    y, x = np.mgrid[:side, :side] / side
    grey = 0.75 + 0.2 * y - 0.1 * x

    def paint(centre: tuple[float, float], radii: tuple[float, float], value: float | NDArray, soft: float) -> None:
        nonlocal grey
        distance = np.hypot((x - centre[0]) / radii[0], (y - centre[1]) / radii[1])
        share = 1 / (1 + np.exp(np.clip((distance - 1) / soft, -50, 50)))
        grey = grey * (1 - share) + share * value

    paint((0.5, 1.05), (0.42, 0.30), 0.35 + 0.15 * x, 0.03)
    paint((0.5, 0.36), (0.27, 0.33), 0.18, 0.03)
    paint((0.5, 0.45), (0.20, 0.28), 0.85 - 0.45 * np.clip((x - 0.45) * 2, 0, 1) - 0.1 * y, 0.03)
    for eye in (0.42, 0.58):
        paint((eye, 0.40), (0.045, 0.020), 0.20, 0.1)
        paint((eye, 0.35), (0.060, 0.012), 0.25, 0.1)
    paint((0.5, 0.60), (0.070, 0.018), 0.35, 0.1)
    paint((0.5, 0.50), (0.025, 0.050), 0.45, 0.3)
    return np.clip(255 * grey, 0, 255).astype(np.uint8)


def _dense(stroke: Stroke, spacing: float) -> Stroke:
    pieces = [stroke[:1]]
    for start, end in pairwise(stroke):
        count = max(1, int(np.ceil(np.linalg.norm(end - start) / spacing)))
        pieces.append(start + (end - start) * np.arange(1, count + 1)[:, None] / count)
    return np.concatenate(pieces)
