"""Points as dense as wanted, evenly spread: along a curve that fills the plane, then moved apart."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.rasterise.tone import sample, sample_mask
from app.drawing.rasterise.types import Field, Mask

MAX_ORDER = 10
"""The curve fills a grid of at most 2^10 cells a side."""

CELLS_A_POINT = 16

RELAXATIONS = 4

Array = NDArray[np.float64]


class _Grid(NamedTuple):
    """The picture in nearly square cells."""

    mass: Array
    """(rows, columns) points that are wanted in each."""
    cell: Array
    """(2,) width and height in pixels."""
    order: int
    """The curve that visits all of them has 2^order cells a side."""

    def cells_at(self, points: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Row and column (n,) of (n, 2) pixels."""
        column, row = np.floor((points + 0.5) / self.cell).astype(np.int64).T
        rows, columns = self.mass.shape
        return np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)


def points_of(density: Field, inked: Mask, pen: float, most: int) -> Array:
    """(n, 2) pixels, in the order of the curve; `density` is points per square of the pen's width.

    If that would be more than `most` points, all places get equally fewer.
    """
    grid = _grid(density, inked, pen, most)
    count = min(most, round(grid.mass.sum()))
    if count < 1:
        return np.zeros((0, 2))
    return _relaxed(_along_curve(grid, count), grid, inked)


@lru_cache(maxsize=4)
def hilbert(order: int) -> NDArray[np.int16]:
    """(4^order, 2) cells (x, y) of a square of 2^order a side, each a neighbour of the one before; read only."""
    cells = np.zeros((1, 2), np.int16)
    for side in (2**level for level in range(order)):
        across = cells[:, ::-1]
        moves = np.array([(0, side), (side, side), (2 * side - 1, side - 1)], np.int16)
        cells = np.concatenate([across, cells + moves[0], cells + moves[1], moves[2] - across])
    cells.flags.writeable = False
    return cells


def _grid(density: Field, inked: Mask, pen: float, most: int) -> _Grid:
    """As fine as so many points need."""
    height, width = density.shape
    extent = max(height, width)
    points = min(most, float(density.sum(where=inked)) / pen**2)
    cells = CELLS_A_POINT * max(points, 1.0) * extent**2 / (width * height)
    order = min(MAX_ORDER, max(1, math.ceil(math.log2(cells) / 2)))
    counts = [max(1, round(side / extent * 2**order)) for side in (width, height)]
    cell = np.array([width, height]) / counts
    x, y = ((np.arange(count) + 0.5) * side - 0.5 for count, side in zip(counts, cell, strict=True))
    mass = np.where(sample_mask(inked, x, y[:, None]), sample(density, x, y[:, None]), 0.0) * cell.prod() / pen**2
    return _Grid(mass, cell, order)


def _along_curve(grid: _Grid, count: int) -> Array:
    """(count, 2) pixels: equal shares of the mass along the curve, one point in the middle of each."""
    rows, columns = grid.mass.shape
    column, row = hilbert(grid.order).T
    inside = (column < columns) & (row < rows)
    column, row = column[inside], row[inside]
    mass = grid.mass[row, column]
    column, row, mass = column[mass > 0], row[mass > 0], mass[mass > 0]
    reached = np.cumsum(mass)
    at = np.interp((np.arange(count) + 0.5) / count * reached[-1], reached, np.arange(len(mass)))
    before = np.minimum(at.astype(np.int64), len(mass) - 1)
    after = np.minimum(before + 1, len(mass) - 1)
    here, there = (np.column_stack([column[k], row[k]]).astype(np.float64) for k in (before, after))
    ahead = there - here
    ahead[np.abs(ahead).max(axis=1) > 1.5] = 0.0  # the curve leaps over white
    return (here + (at - before)[:, None] * ahead + 0.5) * grid.cell - 0.5


def _relaxed(points: Array, grid: _Grid, inked: Mask) -> Array:
    """Each point moved to the middle of the mass that is nearest to it (Lloyd), unless it is white there."""
    rows, columns = grid.mass.shape
    mass = grid.mass.ravel()
    mass_x = (grid.mass * np.arange(columns)).ravel()
    mass_y = (grid.mass * np.arange(rows)[:, None]).ravel()
    for _ in range(RELAXATIONS):
        owner = _owners(points, grid)
        total, sum_x, sum_y = (np.bincount(owner, weights, len(points)) for weights in (mass, mass_x, mass_y))
        middle = (np.column_stack([sum_x, sum_y]) / np.maximum(total, 1e-12)[:, None] + 0.5) * grid.cell - 0.5
        stays = (total <= 0) | ~sample_mask(inked, *middle.T)
        points = np.where(stays[:, None], points, middle)
    return points


def _owners(points: Array, grid: _Grid) -> NDArray[np.int64]:
    """(rows * columns,) the nearest point of each cell; of points in one cell the first."""
    row, column = grid.cells_at(points)
    empty = np.ones(grid.mass.shape, np.uint8)
    empty[row, column] = 0
    found = cv2.distanceTransformWithLabels(empty, cv2.DIST_L2, cv2.DIST_MASK_5, labelType=cv2.DIST_LABEL_PIXEL)
    labels = np.asarray(found[1], np.int32)
    owner = np.zeros(labels.max() + 1, np.int64)
    owner[labels[row, column][::-1]] = np.arange(len(points))[::-1]
    return owner[labels.ravel()]
