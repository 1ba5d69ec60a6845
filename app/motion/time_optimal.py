"""The fastest course along a curve: at every point some drive is at a limit.

Reachability analysis after Pham & Pham (TOPP-RA, 2018), over x = s'^2 and u = s'' between neighbouring points:
backwards, the greatest x at each point from which the end can still be reached at rest; then forwards, always the
greatest u. Every demand allows u between two parallel lines over x, so that

    max_j (bottom_j + slope_j x) <= u <= min_j (top_j + slope_j x)

and the largest x for which some u is left is the root of a concave function, found by Newton's steps from above.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from app.motion.demands import Demands
from app.motion.pieces import Pieces
from app.motion.trajectory import Array

FLAT = 1e-12
"""Of the greatest, coefficients of u so small count as none."""

NEWTON_STEPS = 30

MOST = 1e12
"""Of x, where nothing else limits it."""


class Strips(NamedTuple):
    """What the demands leave of u, for each stretch between two points and each demand at either end."""

    slope: Array
    """(k - 1, 2 m)"""
    bottom: Array
    top: Array
    highest: Array
    """(k - 1,) limit on x from the demands on which u has no influence."""


def time_optimal(demands: Demands, s: Array) -> Pieces:
    """The law s(t), from 0 to 1 over [0, 1], of the fastest course that starts and ends at rest.

    Its acceleration is constant between the points s (k,), evenly spaced from 0 to 1, at which the demands are
    given; they hold at both ends of each stretch. The drives must be able to hold the robot at every point.
    """
    doubled = 2.0 * float(s[1] - s[0])
    strips = _strips(demands, doubled)
    most = _controllable(strips, doubled)
    x = np.zeros(len(s))
    for i, (slope, _, top, _) in enumerate(zip(*strips, strict=True)):
        push = float((top + slope * x[i]).min())
        x[i + 1] = min(max(x[i] + doubled * push, 0.0), most[i + 1])
    return _from_speeds(s, np.sqrt(x))


def _strips(demands: Demands, doubled: float) -> Strips:
    """At the start of a stretch a demand is a u + b x + c; at its end, where x has grown by `doubled` u, it is
    (a + doubled b) u + b x + c."""
    a, b, c, limit = demands
    u = np.hstack([a[:-1], a[1:] + doubled * b[1:]])
    x, c = np.hstack([b[:-1], b[1:]]), np.hstack([c[:-1], c[1:]])
    sign, limit = np.where(u < 0.0, -1.0, 1.0), np.tile(limit, 2)
    u, x, c = sign * u, sign * x, sign * c
    free = u > FLAT * u.max()
    steep = np.where(free, u, 1.0)
    bottom, top = np.where(free, (-limit - c) / steep, -np.inf), np.where(free, (limit - c) / steep, np.inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        highest = np.where(~free & (x != 0.0), (limit - np.sign(x) * c) / np.abs(x), np.inf)
    return Strips(np.where(free, -x / steep, 0.0), bottom, top, highest.min(axis=1))


def _controllable(strips: Strips, doubled: float) -> Array:
    """(k,) the greatest x at each point from which the end can be reached at rest."""
    # one more strip: the next x lies between 0 and the most that is allowed there
    slope, bottom, top = (
        np.pad(part, ((0, 0), (0, 1)), constant_values=edge)
        for part, edge in zip(strips[:3], (-1.0 / doubled, 0.0, 0.0), strict=True)
    )
    most = np.zeros(len(top) + 1)
    for i in range(len(top) - 1, -1, -1):
        top[i, -1] = most[i + 1] / doubled
        most[i] = _greatest(slope[i], bottom[i], top[i], min(float(strips.highest[i]), MOST))
    return most


def _greatest(slope: Array, bottom: Array, top: Array, x: float) -> float:
    """The largest x, at most the given one, for which the strips have a u in common; x = 0 has one."""
    for _ in range(NEWTON_STEPS):
        lines = slope * x
        above, below = top + lines, bottom + lines
        j, k = int(above.argmin()), int(below.argmax())
        gap = above[j] - below[k]
        if gap >= -1e-12 * abs(above[j]):
            break
        x = max(float(x - gap / (slope[j] - slope[k])), 0.0)
    return x


def _from_speeds(s: Array, speed: Array) -> Pieces:
    """The law with these speeds (k,) at s (k,) and constant acceleration in between, brought to one unit of time."""
    lengths = 2.0 * np.diff(s) / (speed[1:] + speed[:-1])
    knots = np.concatenate([[0.0], np.cumsum(lengths)])
    pushes = np.diff(speed) / lengths
    return Pieces(knots, np.stack([s[:-1], speed[:-1], 0.5 * pushes])).stretched(1.0 / knots[-1])
