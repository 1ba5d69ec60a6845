"""Strokes in the robot's frame, end to end in flat arrays: what follows treats all of them at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.toolpath.placement import Placement
from app.robots.robot import Array

SPACING_M = 0.002
"""A robot's Jacobian changes along a line: longer segments are divided."""

SAME_M = 1e-9
"""Vertices closer than this are one."""


@dataclass(frozen=True, eq=False)
class Polylines:
    """k strokes of m vertices in all. Vertex i begins segment i, which is empty for the last one of a stroke."""

    points: Array
    """(m, 2) m"""
    first: NDArray[np.int64]
    """(k + 1,) where each stroke begins in `points`, and the end of the last one."""

    @cached_property
    def last(self) -> NDArray[np.int64]:
        """(k,) last vertex of each stroke; its first one for a dot."""
        return self.first[1:] - 1

    @cached_property
    def step(self) -> Array:
        """(m, 2) from each vertex to the next of its stroke, m; 0 at the last."""
        return _steps(self.points, self.last)

    @cached_property
    def length(self) -> Array:
        """(m,) m"""
        return np.hypot(*self.step.T)

    @cached_property
    def direction(self) -> Array:
        """(m, 2) unit vectors; 0 for an empty segment."""
        return self.step / np.maximum(self.length, SAME_M)[:, None]

    @cached_property
    def stroke(self) -> NDArray[np.int64]:
        """(m,) stroke of each vertex."""
        return np.repeat(np.arange(len(self.last)), np.diff(self.first))

    @cached_property
    def inner(self) -> NDArray[np.int64]:
        """Vertices with a segment on either side."""
        between = np.ones(len(self.points), dtype=bool)
        between[self.first[:-1]] = between[self.last] = False
        return np.flatnonzero(between)


def lay_out(strokes: Sequence[Array], placement: Placement) -> Polylines:
    """The strokes on the table, without repeated vertices and with long segments divided."""
    check_strokes(strokes)
    first = np.concatenate([[0], np.cumsum([len(stroke) for stroke in strokes])])
    points = placement.on_table(np.concatenate(strokes))
    step = _steps(points, first[1:] - 1)
    length = np.hypot(*step.T)
    parts = np.where(length > SAME_M, np.ceil(length / SPACING_M), 0).astype(int)
    parts[first[1:] - 1] = 1
    source = np.repeat(np.arange(len(points)), parts)
    begin = np.cumsum(parts) - parts
    share = (np.arange(len(source)) - begin[source]) / parts[source]
    sizes = np.add.reduceat(parts, first[:-1])
    return Polylines(points[source] + share[:, None] * step[source], np.concatenate([[0], np.cumsum(sizes)]))


def check_strokes(strokes: Sequence[Array]) -> None:
    """DrawingError for no strokes at all, and for any that is not a list of finite points."""
    if not len(strokes):
        raise DrawingError("There is nothing to draw; choose a picture with more contrast or keep shorter strokes.")
    for number, stroke in enumerate(strokes, 1):
        shape = np.shape(stroke)
        if len(shape) != 2 or shape[0] < 1 or shape[1] != 2 or not np.isfinite(stroke).all():
            raise DrawingError(f"Stroke {number} is not a list of points x, y; import the drawing again.")


def _steps(points: Array, last: NDArray[np.int64]) -> Array:
    step = np.zeros_like(points)
    step[:-1] = points[1:] - points[:-1]
    step[last] = 0.0
    return step
