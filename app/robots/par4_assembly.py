"""Forward kinematics of the Par4: the valid assembly by Newton's method, and all others by a search in height.

Every assembly has |P_i - A_i| = l for the four legs. With V the tool point and W = V + h (-sin theta, cos theta)
the middle of the opposite bar, V lies on the spheres of legs 3 and 4, W on those of legs 1 and 2; at a given
height both are intersections of two circles, and the assembly is where |W - V| = h.
"""

from __future__ import annotations

from itertools import product

import numpy as np

from app.robots.par4_platform import Par4Platform
from app.robots.robot import LIMIT_TOLERANCE, Array, Assembly

MAX_STEP = np.array([0.15, 0.15, 0.15, 0.5])
"""Longest Newton step: from a start inside the workspace it cannot jump to another assembly."""


def newton(platform: Par4Platform, elbows: Array, rod: float, start: Array) -> Array:
    """(rows, 4) valid poses for elbows (rows, 4, 3), NaN where there is none; `start` (4,) lies well inside."""
    poses = np.broadcast_to(start, (len(elbows), 4)).copy()
    active = np.asarray(np.isfinite(elbows).all(axis=(-1, -2)))
    poses[~active] = np.nan
    for _ in range(30):
        rows = np.flatnonzero(active)
        if not rows.size:
            break
        step, residual = _newton_step(platform, poses[rows], elbows[rows], rod)
        poses[rows] += step
        active[rows] = residual > 1e-14
    poses[active | ~_valid(platform, poses, elbows)] = np.nan
    return poses


def _newton_step(platform: Par4Platform, pose: Array, elbows: Array, rod: float) -> tuple[Array, Array]:
    """Limited step (rows, 4) and largest residual (rows,) in multiples of l^2."""
    rods = platform.joints(pose) - elbows
    residual = (rods**2).sum(-1) - rod**2
    rows = 2.0 * platform.loop_rows(rods, pose[:, 3])
    # The tiny diagonal keeps a singular Jacobian from raising; its row then fails to converge.
    step = -np.linalg.solve(rows + 1e-15 * np.eye(4), residual[..., None])[..., 0]
    step /= np.maximum(1.0, np.abs(step / MAX_STEP).max(axis=-1, keepdims=True))
    return step, np.abs(residual).max(axis=-1) / rod**2


def _valid(platform: Par4Platform, poses: Array, elbows: Array) -> np.ndarray:
    """The real machine hangs below its elbows and its platform is not turned over."""
    below = (poses[:, 2] + platform.height)[:, None] < elbows[..., 2]
    turned = np.abs(poses[:, 3]) <= platform.theta_max + LIMIT_TOLERANCE
    return below.all(axis=-1) & turned


def every_mode(platform: Par4Platform, elbows: Array, rod: float) -> list[Assembly]:
    """All real assemblies for one set of elbows (4, 3), the valid one first."""
    centres = elbows - np.column_stack([platform.along, platform.across, np.full(4, platform.height)])
    top, bottom = (centres[:, 2] + rod).min(), (centres[:, 2] - rod).max()
    if not top > bottom:
        return []
    heights = np.linspace(bottom, top, 801)
    found: list[Array] = []
    for far, near in product((1.0, -1.0), repeat=2):
        found += _roots(centres, heights, rod, platform.h, (far, near))
    poses = np.array(found).reshape(-1, 4)
    valid = _valid(platform, poses, np.broadcast_to(elbows, (len(poses), 4, 3)))
    return [Assembly(poses[i], bool(valid[i])) for i in np.argsort(~valid, kind="stable")]


def _roots(centres: Array, heights: Array, rod: float, h: float, sides: tuple[float, float]) -> list[Array]:
    """Assemblies of one pair of circle intersections: sign changes of |W - V| - h, narrowed by bisection."""

    def bars(z: Array) -> tuple[Array, Array]:
        return (
            _circle_point(centres[0], centres[1], z, rod, sides[0]),
            _circle_point(centres[2], centres[3], z, rod, sides[1]),
        )

    def excess(z: Array) -> Array:
        w, v = bars(z)
        return np.hypot(*(w - v).T) - h

    values = excess(heights)
    starts = np.flatnonzero(values[:-1] * values[1:] < 0.0)
    low, high = heights[starts], heights[starts + 1]
    sign = np.sign(values[starts])
    for _ in range(60):
        middle = 0.5 * (low + high)
        same = np.sign(excess(middle)) == sign
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    w, v = bars(low)
    theta = np.arctan2(*(-(w - v)[:, 0], (w - v)[:, 1]))
    return list(np.column_stack([v, low, theta]))


def _circle_point(first: Array, second: Array, z: Array, radius: float, side: float) -> Array:
    """(k, 2) intersection of two spheres' circles at heights z, on one side of the line between them."""
    r1 = radius**2 - (z - first[2]) ** 2
    r2 = radius**2 - (z - second[2]) ** 2
    between = (second - first)[:2]
    distance = np.hypot(*between)
    along = (r1 - r2 + distance**2) / (2.0 * distance)
    with np.errstate(invalid="ignore"):
        across = side * np.sqrt(r1 - along**2)
    unit = between / distance
    return first[:2] + along[:, None] * unit + across[:, None] * np.array([-unit[1], unit[0]])
