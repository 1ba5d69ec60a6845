"""Trilateration: where three spheres of one radius meet. Forward kinematics of both three-legged deltas."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def intersect_three_spheres(centres: Array, radius: float, *, upper: bool) -> Array:
    """The upper or lower of the two common points.

    Args:
        centres: (..., 3, 3) one centre a row.
        radius: of all three spheres, metres.
    Returns:
        (..., 3); NaN where the spheres do not meet.
    """
    first, second, third = np.moveaxis(np.asarray(centres, dtype=float), -2, 0)
    a, b = second - first, third - first
    normal = np.cross(a, b)
    area = (normal * normal).sum(-1, keepdims=True)
    a2, b2 = (a * a).sum(-1, keepdims=True), (b * b).sum(-1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        middle = np.cross(a2 * b - b2 * a, normal) / (2.0 * area)
        height = np.sqrt(radius**2 - (middle * middle).sum(-1, keepdims=True)) / np.sqrt(area)
    side = np.sign(normal[..., 2:]) * (1.0 if upper else -1.0)
    return first + middle + side * height * normal
