"""States to test dynamics at: reachable poses with random rates and accelerations, and a smooth motion."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from app.robots import ROBOTS, Robot, make_robot
from app.robots.dynamics import dynamics_of
from app.robots.limits import drive_limits
from app.robots.robot import Array
from app.robots.workspace import bounding_box

EVERY = {name: make_robot(name) for name in ROBOTS}
every_dynamics = pytest.mark.parametrize("dynamics", [dynamics_of(robot) for robot in EVERY.values()], ids=EVERY)


@functools.cache
def _boxes(robot: Robot) -> tuple[Array, Array]:
    return bounding_box(robot)


def states(robot: Robot, count: int, seed: int) -> tuple[Array, Array, Array]:
    """Poses, rates and accelerations (count, dof): up to 1 m/s and 10 m/s^2, 4 rad/s and 40 rad/s^2."""
    rng = np.random.default_rng(seed)
    low, high = _boxes(robot)
    positions = rng.uniform(low, high, (60 * count, 3))
    turns = rng.uniform(-robot.rotation_limit, robot.rotation_limit, (60 * count, robot.dof - 3))
    poses = np.hstack([positions, turns])
    poses = poses[robot.reachable(poses)][:count]
    assert len(poses) == count
    scale = np.array([1.0, 1.0, 1.0, 4.0])[: robot.dof]
    return poses, scale * rng.uniform(-1, 1, poses.shape), 10.0 * scale * rng.uniform(-1, 1, poses.shape)


def motion(robot: Robot, t: Array, seed: int) -> tuple[Array, Array, Array]:
    """Pose, rate and acceleration (k, dof) of a random smooth motion about home at times t (k,)."""
    rng = np.random.default_rng(seed)
    size = np.array([0.03, 0.03, 0.03, 0.3])[: robot.dof] * rng.uniform(0.5, 1.0, robot.dof)
    omega, start = rng.uniform(4.0, 12.0, robot.dof), rng.uniform(0, 6, robot.dof)
    turn = omega * np.asarray(t)[:, None] + start
    return robot.home + size * np.sin(turn), size * omega * np.cos(turn), -size * omega**2 * np.sin(turn)


def random_efforts(robot: Robot, count: int, seed: int) -> Array:
    """(count, n) within the drives' limits."""
    return drive_limits(robot).effort * np.random.default_rng(seed).uniform(-1, 1, (count, len(robot.joint_names)))
