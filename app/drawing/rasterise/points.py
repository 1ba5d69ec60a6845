"""Points as dense as wanted, evenly spread: along a curve that fills the plane, then moved apart."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from app.drawing.rasterise.tone import sample, sample_mask
from app.drawing.rasterise.types import Field, Mask

MAX_ORDER = 9
"""The curve fills a grid of at most 2^9 cells a side."""

RELAXATIONS = 4


def points_of(density: Field, inked: Mask, pen: float, most: int) -> NDArray[np.float64]:
    """(n, 2) pixels, in the order of the curve; `density` is points per square of the pen's width.

    If that would be more than `most` points, all places get equally fewer.
    """
    height, width = density.shape
    extent = max(height, width)
    order = min(MAX_ORDER, max(1, math.ceil(math.log2(max(extent / pen, 1.0))) + 1))
    cell = extent / 2**order
    curve = (hilbert(order) + 0.5) * cell - 0.5
    x, y = curve.T
    mass = np.where((x < width - 0.5) & (y < height - 0.5) & sample_mask(inked, x, y), sample(density, x, y), 0.0)
    curve, mass = curve[mass > 0], mass[mass > 0] * (cell / pen) ** 2
    count = min(most, round(mass.sum()))
    if count < 1:
        return np.zeros((0, 2))
    # equal shares of the mass along the curve, one point in the middle of each
    reached = np.cumsum(mass)
    at = np.interp((np.arange(count) + 0.5) / count * reached[-1], reached, np.arange(len(mass)))
    before = np.minimum(at.astype(np.int64), len(curve) - 1)
    ahead = curve[np.minimum(before + 1, len(curve) - 1)] - curve[before]
    ahead[np.abs(ahead).max(axis=1) > 1.5 * cell] = 0.0  # the curve leaps over white
    return _relaxed(curve[before] + (at - before)[:, None] * ahead, curve, mass, inked)


def hilbert(order: int) -> NDArray[np.int64]:
    """(4^order, 2) cells (x, y) of a square of 2^order a side, each a neighbour of the one before."""
    cells = np.zeros((1, 2), np.int64)
    for side in (2**level for level in range(order)):
        across = cells[:, ::-1]
        cells = np.concatenate([across, cells + (0, side), cells + (side, side), (2 * side - 1, side - 1) - across])
    return cells


def _relaxed(
    points: NDArray[np.float64], places: NDArray[np.float64], mass: NDArray[np.float64], inked: Mask
) -> NDArray[np.float64]:
    """Each point moved to the middle of the mass that is nearest to it (Lloyd), unless it is white there."""
    for _ in range(RELAXATIONS):
        owner = KDTree(points).query(places)[1]
        total = np.bincount(owner, mass, len(points))
        sums = np.column_stack([np.bincount(owner, mass * axis, len(points)) for axis in places.T])
        middle = sums / np.maximum(total, 1e-12)[:, None]
        stays = (total <= 0) | ~sample_mask(inked, *middle.T)
        points = np.where(stays[:, None], points, middle)
    return points
