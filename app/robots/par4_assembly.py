"""Forward kinematics of the Par4: the valid assembly by Newton's method, and all others by a search in height.

Every assembly has |P_i - A_i| = l for the four legs. With V the tool point and W = V + h (-sin theta, cos theta)
the middle of the opposite bar, V lies on the spheres of legs 3 and 4, W on those of legs 1 and 2; at a given
height both are intersections of two circles, and the assembly is where |W - V| = h.
"""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from app.robots.robot import LIMIT_TOLERANCE, Array, Assembly

if TYPE_CHECKING:
    from app.robots.par4 import Par4

MAX_STEP = np.array([0.15, 0.15, 0.15, 0.5])
"""Longest Newton step: from a start inside the workspace it cannot jump to another assembly."""


def newton(robot: Par4, joints: Array) -> Array:
    """(rows, 4) valid poses of (rows, 4) joints, NaN where there is none."""
    elbows = robot._elbows(joints)
    poses = np.broadcast_to(robot.home, joints.shape).copy()
    active = np.asarray(np.isfinite(joints).all(axis=-1))
    poses[~active] = np.nan
    for _ in range(30):
        rows = np.flatnonzero(active)
        if not rows.size:
            break
        step, residual = _newton_step(robot, poses[rows], elbows[rows])
        poses[rows] += step
        active[rows] = residual > 1e-14
    poses[active | ~_valid(robot, poses, elbows)] = np.nan
    return poses


def _newton_step(robot: Par4, pose: Array, elbows: Array) -> tuple[Array, Array]:
    """Limited step (rows, 4) and largest residual (rows,) in multiples of l^2."""
    rods = robot._platform_joints(pose) - elbows
    residual = (rods**2).sum(-1) - robot._l**2
    rows = 2.0 * robot.loop_rows(rods, pose[:, 3])
    # The tiny diagonal keeps a singular Jacobian from raising; its row then fails to converge.
    step = -np.linalg.solve(rows + 1e-15 * np.eye(4), residual[..., None])[..., 0]
    step /= np.maximum(1.0, np.abs(step / MAX_STEP).max(axis=-1, keepdims=True))
    return step, np.abs(residual).max(axis=-1) / robot._l**2


def _valid(robot: Par4, poses: Array, elbows: Array) -> np.ndarray:
    """The real machine hangs below its elbows and its platform is not turned over."""
    below = (poses[:, 2] + robot.geometry.P_z)[:, None] < elbows[..., 2]
    turned = np.abs(poses[:, 3]) <= robot.geometry.theta_max + LIMIT_TOLERANCE
    return below.all(axis=-1) & turned


def every_mode(robot: Par4, joints: Array) -> list[Assembly]:
    """All real assemblies of one set of joints (4,), the valid one first."""
    elbows = robot._elbows(joints)
    shift = np.column_stack([robot._along, robot._across, np.full(4, robot.geometry.P_z)])
    centres = elbows - shift
    top, bottom = (centres[:, 2] + robot._l).min(), (centres[:, 2] - robot._l).max()
    if not top > bottom:
        return []
    found: list[Array] = []
    for far, near in product((1.0, -1.0), repeat=2):
        found += _roots(robot, centres, np.linspace(bottom, top, 801), far, near)
    poses = np.array(found).reshape(-1, 4)
    valid = _valid(robot, poses, np.broadcast_to(elbows, (len(poses), 4, 3)))
    return [Assembly(poses[i], bool(valid[i])) for i in np.argsort(~valid, kind="stable")]


def _roots(robot: Par4, centres: Array, heights: Array, far: float, near: float) -> list[Array]:
    """Assemblies of one pair of circle intersections: sign changes of |W - V| - h, narrowed by bisection."""

    def bars(z: Array) -> tuple[Array, Array]:
        return (
            _circle_point(centres[0], centres[1], z, robot._l, far),
            _circle_point(centres[2], centres[3], z, robot._l, near),
        )

    def excess(z: Array) -> Array:
        w, v = bars(z)
        return np.hypot(*(w - v).T) - robot.geometry.h

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
