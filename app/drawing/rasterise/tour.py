"""A short way through points (2-opt among near neighbours), all moves of a round judged at once."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

NEIGHBOURS = 8
MAX_ROUNDS = 60
LEAST_GAIN = 1e-9

Points = NDArray[np.float64]
Ints = NDArray[np.int64]


def shortened(points: Points) -> Points:
    """The (n, 2) points, given in a sensible order, as an open way that hardly crosses itself."""
    count = len(points)
    if count < 5:
        return points
    near = np.asarray(KDTree(points).query(points, min(NEIGHBOURS + 1, count))[1], np.int64)[:, 1:]
    order = np.arange(count)
    idle = 0
    for _ in range(MAX_ROUNDS):
        idle = 0 if _improve(points, order, near) else idle + 1
        if idle == 2:
            break
        # moves look only forwards along the way: next time the other way round
        order = order[::-1].copy()
    around = points[order]
    longest = int(np.argmax(np.linalg.norm(np.roll(around, -1, axis=0) - around, axis=1)))
    return np.roll(around, -longest - 1, axis=0)


def _improve(points: Points, order: Ints, near: Ints) -> int:
    """Reverse stretches of `order`, a closed way, in place; how many."""
    place = np.argsort(order)
    after = order[(place + 1) % len(order)]
    here = np.arange(len(order))
    # instead of a -> after(a) and b -> after(b): a -> b and after(a) -> after(b)
    gain = _far(points, here, after)[:, None] + _far(points, near, after[near])
    gain -= _far(points, here[:, None], near) + _far(points, after[:, None], after[near])
    best = np.argmax(gain, axis=1)
    a = np.flatnonzero(gain[here, best] > LEAST_GAIN)
    a = a[np.argsort(-gain[a, best[a]], kind="stable")]
    return sum(
        _reverse(points, order, place, *pair) for pair in zip(a.tolist(), near[a, best[a]].tolist(), strict=True)
    )


def _reverse(points: Points, order: Ints, place: Ints, a: int, b: int) -> bool:
    """Exchange the edges that now follow a and b, if that still gains."""
    i, j = sorted((int(place[a]), int(place[b])))
    if i == j:
        return False
    start, after_start, end, after_end = points[order[[i, i + 1, j, (j + 1) % len(order)]]].tolist()
    old = math.dist(start, after_start) + math.dist(end, after_end)
    if old - math.dist(start, end) - math.dist(after_start, after_end) <= LEAST_GAIN:
        return False
    order[i + 1 : j + 1] = order[i + 1 : j + 1][::-1].copy()
    place[order[i + 1 : j + 1]] = np.arange(i + 1, j + 1)
    return True


def _far(points: Points, a: Ints, b: Ints) -> NDArray[np.float64]:
    return np.hypot(points[a, 0] - points[b, 0], points[a, 1] - points[b, 1])
