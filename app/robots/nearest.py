"""The feasible position closest to a target: what the robot does while its gizmo is dragged out of reach.

A sequence of projections: around the current point each limit c(x) >= 0 becomes a half-space, and the target
is projected onto their intersection. The curvature of the active limits (spheres of rod length) scales the
step, so that the sequence converges like Newton's method, also for targets far away:

    x+ = argmin |x - (x_k + (t - x_k) / s)|^2   with   c_k + grad c_k . (x - x_k) >= 0,
    s  = 1 + sum_k lambda_k kappa_k             (Hessian of the Lagrangian for spheres)

It starts where the straight way from a feasible point to the target leaves the feasible set, and whatever
happens it ends feasible: the last resort is the way back to that point. Plain floats, since one drag event
asks for one point.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from app.robots.half_spaces import HalfSpace, project

Point = list[float]

INSET = 1e-7
"""Answers stay this far inside each limit (metres), so that rounding cannot put them outside."""

FARTHEST = 1e3
"""A target farther away than this (metres) is brought closer in its direction."""

LONGEST_STEP = 0.1


class Boundary(NamedTuple):
    """One limit near a point: feasible where its value is positive."""

    value: float
    """Signed distance to the limit to first order, positive inside (metres)."""
    gradient: tuple[float, float, float]
    curvature: float
    """1 / radius where the feasible side is inside a sphere, -1 / radius outside of one, 0 for a plane."""

    def half_space(self, around: Point) -> HalfSpace:
        g, x = self.gradient, around
        return HalfSpace(g, self.value - INSET - g[0] * x[0] - g[1] * x[1] - g[2] * x[2])


def nearest_feasible(
    target: Point,
    inside: Point,
    boundaries: Callable[[Point], list[Boundary]],
    feasible: Callable[[Point], bool],
) -> Point:
    """The feasible point closest to `target`, found from the feasible point `inside`; both (3,)."""
    target = _brought_closer(target)
    start = point = last_feasible(inside, target, feasible, precision=1e-3)
    scale, damping, previous = 1.0, 1.0, math.inf
    for _ in range(60):
        limits = boundaries(point)
        wish = [p + (t - p) / (scale * damping) for p, t in zip(point, target, strict=True)]
        found, multipliers = project(wish, [limit.half_space(point) for limit in limits])
        moved = math.dist(found, point)
        shorten = min(1.0, LONGEST_STEP / moved) if moved > 0.0 else 1.0
        point = [p + (f - p) * shorten for p, f in zip(point, found, strict=True)]
        if moved < 1e-8:
            break
        if moved > 0.8 * previous:
            damping *= 2.0
        previous = moved
        curvature = sum(m * limit.curvature for m, limit in zip(multipliers, limits, strict=True))
        scale = max(0.2, 1.0 + scale * damping * curvature)
    return point if feasible(point) else last_feasible(start, point, feasible, precision=1e-7)


def last_feasible(inside: Point, outside: Point, feasible: Callable[[Point], bool], precision: float) -> Point:
    """Where the straight way from a feasible point leaves the feasible set, to a fraction of its length."""
    low, high, best = 0.0, 1.0, inside
    while high - low > precision:
        middle = 0.5 * (low + high)
        point = [i + (o - i) * middle for i, o in zip(inside, outside, strict=True)]
        if feasible(point):
            low, best = middle, point
        else:
            high = middle
    return best


def _brought_closer(target: Point) -> Point:
    distance = math.hypot(*target)
    return target if distance <= FARTHEST else [t * (FARTHEST / distance) for t in target]
