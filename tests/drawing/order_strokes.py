"""Strokes to be ordered, and whether two sets of them are the same."""

from __future__ import annotations

import numpy as np

from app.drawing.order import HopCost

PLAIN = HopCost(lift_s=0.0, speed_mm_s=1.0, touch_mm=0.0)


def random_strokes(count, seed=0, size=160.0):
    rng = np.random.default_rng(seed)
    starts = rng.uniform(-size / 2, size / 2, (count, 1, 2))
    return list(starts + np.cumsum(rng.normal(0.0, 2.0, (count, 3, 2)), axis=1))


def circle(x, y, radius, points=60, begin=0.0):
    angle = np.linspace(0.0, 2.0 * np.pi, points + 1) + begin
    ring = np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)])
    ring[-1] = ring[0]
    return ring


def canonical(stroke):
    """Equal for strokes that are the same up to direction and, if closed, the point where they begin."""
    points = [tuple(point) for point in stroke.tolist()]
    ways = [points, points[::-1]]
    if points[0] == points[-1]:
        ways = [way[k:-1] + way[: k + 1] for way in ways for k in range(len(way) - 1)]
    return min(ways)


def same_strokes(one, other):
    return sorted(map(canonical, one)) == sorted(map(canonical, other))
