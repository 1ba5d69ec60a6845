"""From one pose to another the quick way: straight in joint space, with limited speed, acceleration and jerk."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.motion.pieces import Pieces
from app.motion.placed import check_reach
from app.motion.trajectory import Array, MotionError, Sample
from app.robots import Robot
from app.robots.dynamics import Dynamics
from app.robots.limits import DriveLimits

RISE_S = 0.03
"""An acceleration builds up to its limit in this time: jerk limit = acceleration limit / 0.03 s."""

CHECKED = 400
"""Instants at which reach and efforts are tried."""


@dataclass(frozen=True, eq=False)
class JointMove:
    """A trajectory given by its joints."""

    title: str
    robot: Robot
    joints: Pieces
    """(k, n) over time, s."""

    @property
    def duration_s(self) -> float:
        return float(self.joints.knots[-1])

    def sample(self, t: ArrayLike) -> Sample:
        """See `Trajectory`. v = J^-1 qd, a = J^-1 (qdd - Jdot v)."""
        q, rates, accelerations = self.joints.at(t)
        pose = self.robot.forward(q)
        J = self.robot.jacobian(pose)
        rate = _solved(J, rates)
        drift = self.robot.dynamics.joint_accelerations(pose, rate, np.zeros_like(rate))
        return Sample(pose, rate, _solved(J, accelerations - drift))


def point_to_point(robot: Robot, start_pose: ArrayLike, end_pose: ArrayLike, limits: DriveLimits) -> JointMove:
    """From rest at one pose (dof,) to rest at the other, within the limits.

    Raises:
        MotionError: if one of them, or the way between, is out of reach, or a drive cannot hold the robot there.
    """
    ends = np.array([start_pose, end_pose], dtype=float)
    check_reach(robot, ends, "choose a pose inside the workspace")
    joints = robot.inverse(ends)
    move = JointMove("Point to point", robot, _jerk_limited(joints[0], joints[1], limits))
    t = np.linspace(0.0, move.duration_s, CHECKED)
    if not robot.reachable(robot.forward(move.joints.at(t)[0])).all():
        raise MotionError("The straight way between these joints leaves the workspace; go by way of another pose.")
    factor = _slower(robot.dynamics, move.sample(t), limits.effort)
    return JointMove(move.title, robot, move.joints.stretched(factor))


def _solved(J: Array, values: Array) -> Array:
    """(k, dof) J^-1 values, of values (k, n)."""
    return np.linalg.solve(J, values[..., None])[..., 0].astype(float)


def _jerk_limited(start: Array, end: Array, limits: DriveLimits) -> Pieces:
    """Piecewise cubics: between the instants at which a jerk changes, the acceleration is linear."""
    from ruckig import InputParameter, Ruckig, Synchronization, Trajectory

    n = len(start)
    wanted, found = InputParameter(n), Trajectory(n)
    wanted.current_position, wanted.target_position = start.tolist(), end.tolist()
    wanted.max_velocity, wanted.max_acceleration = limits.speed.tolist(), limits.acceleration.tolist()
    wanted.max_jerk = (limits.acceleration / RISE_S).tolist()
    wanted.synchronization = Synchronization.Phase
    Ruckig(n).calculate(wanted, found)
    changes = [np.cumsum(profile.t) for profile in found.profiles[0]]
    knots = np.unique(np.concatenate([[0.0, found.duration], *changes]).round(12))
    if found.duration < 1e-9:
        return Pieces(np.array([0.0, 1e-3]), start[None, None])
    states = np.array([found.at_time(float(t)) for t in knots])
    lengths = np.diff(knots)[:, None]
    q, rates, accelerations = states.transpose(1, 0, 2)
    jerks = np.diff(accelerations, axis=0) / lengths
    return Pieces(knots, np.stack([q[:-1], rates[:-1], accelerations[:-1] / 2.0, jerks / 6.0]))


def _slower(dynamics: Dynamics, sample: Sample, effort: Array) -> float:
    """The factor, at least 1, by which the move must take longer for its efforts' sake."""
    gravity = dynamics.gravity(sample.pose, "joint")
    if (np.abs(gravity) >= effort).any():
        raise MotionError("The drives cannot even hold the robot on the way there; allow them more effort.")
    moving = dynamics.inverse(*sample) - gravity
    return max(1.0, float(np.sqrt(np.abs(moving) / (effort - np.sign(moving) * gravity)).max()))
