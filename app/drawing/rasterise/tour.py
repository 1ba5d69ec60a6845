"""A short way through points (2-opt among near neighbours), all moves of a round judged at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

NEIGHBOURS = 8
MAX_ROUNDS = 60
LEAST_GAIN = 1e-9

Points = NDArray[np.float64]
Ints = NDArray[np.int64]


class _Near(NamedTuple):
    """What never changes: (n, k) neighbours of each point, the nearest first, and how far they are."""

    point: Ints
    apart: Points


def shortened(points: Points) -> Points:
    """The (n, 2) points, given in a sensible order, as an open way that hardly crosses itself."""
    count = len(points)
    if count < 5:
        return points
    near = _near(points)
    order = np.arange(count)
    touched = active = order
    for _ in range(MAX_ROUNDS):
        before, touched = touched, _improve(points, order, near, active)
        # moves look only forwards along the way: next time the other way round
        order = order[::-1].copy()
        active = np.union1d(before, touched)
        if not len(active):
            break
    around = points[order]
    longest = int(np.argmax(np.linalg.norm(np.roll(around, -1, axis=0) - around, axis=1)))
    return np.roll(around, -longest - 1, axis=0)


def _near(points: Points) -> _Near:
    apart, point = KDTree(points).query(points, min(NEIGHBOURS + 1, len(points)))
    return _Near(np.asarray(point, np.int64)[:, 1:], np.asarray(apart)[:, 1:])


def _improve(points: Points, order: Ints, near: _Near, active: Ints) -> Ints:
    """Reverse stretches of `order`, a closed way, in place, where that gains at active points; all points concerned."""
    after, place = np.empty_like(order), np.empty_like(order)
    after[order] = np.roll(order, -1)
    place[order] = np.arange(len(order))
    # instead of a -> after(a) and b -> after(b): a -> b and after(a) -> after(b), of which one is a shorter hop than
    # before; this is for the first, the second is a first the other way round
    row, column = np.nonzero(near.apart[active] < _far(points, active, after[active])[:, None])
    a = active[row]
    b = near.point[a, column]
    gain = _far(points, a, after[a]) + _far(points, b, after[b])
    gain -= near.apart[a, column] + _far(points, after[a], after[b])
    best = np.argsort(-gain, kind="stable")[: np.count_nonzero(gain > LEAST_GAIN)]
    moves = np.column_stack([a, after[a], b, after[b]])[best]
    for move in moves.tolist():
        _exchange(order, place, *move)
    return moves.ravel()


def _exchange(order: Ints, place: Ints, a: int, after_a: int, b: int, after_b: int) -> None:
    """Give up the two hops for a -> b and after_a -> after_b, unless an earlier move has touched them."""
    count = len(order)
    i, j = int(place[a]), int(place[b])
    if order[(i + 1) % count] != after_a or order[(j + 1) % count] != after_b:
        return
    if i > j:
        i, j = j, i
    # either of the two stretches may be reversed
    stretch = np.arange(i + 1, j + 1) if 2 * (j - i) <= count else np.arange(j + 1, i + 1 + count) % count
    order[stretch] = order[stretch[::-1]]
    place[order[stretch]] = stretch


def _far(points: Points, a: Ints, b: Ints) -> Points:
    return np.hypot(*(points[a] - points[b]).T)
