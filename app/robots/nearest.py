"""The feasible point closest to a target: what the robot does while its gizmo is dragged out of reach.

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

Point = list[float]

INSET = 1e-7
"""Answers stay this far inside each limit (metres), so that rounding cannot put them outside."""


class Boundary(NamedTuple):
    """One limit near a point: feasible where its value is positive."""

    value: float
    """Signed distance to the limit to first order, positive inside (metres)."""
    gradient: tuple[float, ...]
    curvature: float
    """1 / radius where the feasible side is inside a sphere, -1 / radius outside of one, 0 for a plane."""


def nearest_feasible(
    target: Point,
    inside: Point,
    boundaries: Callable[[Point], list[Boundary]],
    feasible: Callable[[Point], bool],
) -> Point:
    """The feasible point closest to `target`, found from the feasible point `inside`."""
    point = last_feasible(inside, target, feasible, precision=1e-3)
    start, scale, damping, previous = point, 1.0, 1.0, math.inf
    for _ in range(60):
        limits = boundaries(point)
        wish = [p + (t - p) / (scale * damping) for p, t in zip(point, target, strict=True)]
        found, multipliers = _project(wish, point, limits, tolerance=min(1e-4, 1e-3 * previous))
        moved = _length(found, point)
        point = found if moved < 0.1 else [p + (f - p) * 0.1 / moved for p, f in zip(point, found, strict=True)]
        if moved < 1e-8:
            break
        if moved > 0.8 * previous:
            damping *= 2.0
        previous = moved
        curvature = sum(m * limit.curvature for m, limit in zip(multipliers, limits, strict=True))
        scale = max(0.2, 1.0 + scale * damping * curvature)
    if feasible(point):
        return point
    return last_feasible(start, point, feasible, precision=1e-7)


def _project(
    wish: Point, around: Point, limits: list[Boundary], tolerance: float
) -> tuple[Point, list[float]]:
    """Project onto the half-spaces of the limits by Hildreth's method; returns the point and multipliers."""
    point = list(wish)
    multipliers = [0.0] * len(limits)
    rows = [
        (k, limit.gradient, limit.value - INSET - _dot(limit.gradient, around), _dot(limit.gradient, limit.gradient))
        for k, limit in enumerate(limits)
    ]
    for _ in range(200):
        change = 0.0
        for k, gradient, offset, norm in rows:
            slack = offset
            for g, p in zip(gradient, point, strict=True):
                slack += g * p
            if slack >= 0.0 and multipliers[k] == 0.0:
                continue
            step = max(-multipliers[k], -slack / norm)
            multipliers[k] += step
            for axis, g in enumerate(gradient):
                point[axis] += step * g
            change = max(change, abs(step))
        if change <= max(tolerance, 1e-11):
            break
    return point, multipliers


def last_feasible(
    inside: Point, outside: Point, feasible: Callable[[Point], bool], precision: float
) -> Point:
    """Where the straight way from a feasible point leaves the feasible set, found by bisection."""
    low, high = 0.0, 1.0
    best = inside
    while high - low > precision:
        middle = 0.5 * (low + high)
        point = [i + (o - i) * middle for i, o in zip(inside, outside, strict=True)]
        if feasible(point):
            low, best = middle, point
        else:
            high = middle
    return best


def _dot(a: tuple[float, ...], b: tuple[float, ...] | Point) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


def _length(a: Point, b: Point) -> float:
    return sum((x - y) ** 2 for x, y in zip(a, b, strict=True)) ** 0.5
