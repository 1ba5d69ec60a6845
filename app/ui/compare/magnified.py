"""A simulated robot with its tool's error drawn larger, as a ghost that a student can see."""

from __future__ import annotations

import math

import numpy as np

from app.robots import Robot
from app.simulation.controlled_run import ControlledRun
from app.ui.ghost_nodes import Configuration

FACTORS = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
LONGEST_ERROR_M = 0.1
LARGEST_TURN_RAD = 1.0
"""A magnified error is drawn no larger than these, or what it really is."""
PLEASANT_M = 0.03
"""About so far the worst ghost is drawn from the path at first."""
APART_M = 1e-3
"""Ghosts nearer to the path than this cannot be told from the robot."""


def ghost(robot: Robot, run: ControlledRun, k: int, factor: float) -> Configuration:
    """Pose and joints at sample k with the error times the factor; as it was where that is out of reach."""
    wanted, pose = run.pose_ref[k].tolist(), run.pose[k].tolist()
    error = [a - w for a, w in zip(pose, wanted, strict=True)]
    larger = [
        *_scaled(error[:3], factor, LONGEST_ERROR_M),
        *_scaled(error[3:], factor, LARGEST_TURN_RAD),
    ]
    drawn = tuple(w + e for w, e in zip(wanted, larger, strict=True))
    joints = robot.solve(*drawn)
    if any(math.isnan(value) for value in joints):
        return pose, run.q[k].tolist()
    return drawn, joints


def worst_error_m(run: ControlledRun) -> float:
    """Largest distance of the tool from where it should have been."""
    return float(np.linalg.norm((run.pose - run.pose_ref)[:, :3], axis=1).max())


def pleasant_factor(worst_m: float) -> int:
    """At which an error of this size is well seen."""
    return max((factor for factor in FACTORS if factor * worst_m <= PLEASANT_M), default=1)


def _scaled(error: list[float], factor: float, most: float) -> list[float]:
    size = math.hypot(*error) if error else 0.0
    if size * factor > most:
        factor = max(1.0, most / size)
    return [factor * value for value in error]
