"""Strokes that follow one another without a gap become one, so that the pen stays down between them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from app.drawing.order.cost import DEFAULT_COST, Array


def join_touching(strokes: Sequence[Array], touch_mm: float = DEFAULT_COST.touch_mm) -> list[Array]:
    """The strokes in their order, (n, 2) mm each, those that begin within `touch_mm` of where the pen is as one."""
    runs: list[list[Array]] = []
    for stroke in strokes:
        if runs and math.dist(runs[-1][-1][-1], stroke[0]) <= touch_mm:
            runs[-1].append(stroke)
        else:
            runs.append([stroke])
    return [run[0] if len(run) == 1 else _joined(run) for run in runs]


def _joined(run: list[Array]) -> Array:
    """One stroke without repeated points; dots alone stay a dot."""
    points = np.concatenate(run)
    moves = np.r_[True, (np.diff(points, axis=0) != 0.0).any(axis=1)]
    return points[moves] if moves[1:].any() else points[:2]
