"""Inverse dynamics by MuJoCo alone: its mass matrix, its bias and the Jacobians of its loops.

The model is built in the pose asked for. Rates and accelerations of all its coordinates follow from those of the
tool and from the loops, whose Jacobians and their rates are MuJoCo's; efforts then solve
M qacc + bias = S^T f + Jc^T lambda. No formula of `app.robots.dynamics` is used.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from app.robots import Robot
from app.robots.dynamics.inertia import Inertia
from app.simulation.prototype import mjcf
from app.simulation.prototype.engine import Data, Model, mujoco


class Answer(NamedTuple):
    """What MuJoCo says about one state."""

    effort: np.ndarray
    """(n,) N m or N."""
    joint_rate: np.ndarray
    """(n,)"""
    joint_acceleration: np.ndarray
    """(n,)"""
    mismatch: float
    """Largest relative residual of the three least-squares problems: 0 where the mechanism is consistent."""


def solve(
    robot: Robot, inertia: Inertia | None, pose: np.ndarray, rate: np.ndarray, acceleration: np.ndarray
) -> Answer:
    """The efforts that give the tool an acceleration (dof,) in a state."""
    mj = mujoco()
    m = mj.MjModel.from_xml_string(mjcf(robot, inertia, pose=pose))
    d = mj.MjData(m)
    mj.mj_forward(m, d)
    loops = d.efc_J.reshape(-1, m.nv)[: d.ne].copy()
    rows = np.vstack([loops, np.eye(m.nv)[dofs(m, robot.pose_names)]])
    d.qvel[:], first = least(rows, np.concatenate([np.zeros(len(loops)), rate]))
    mj.mj_forward(m, d)
    qacc, second = least(rows, np.concatenate([-loop_bias(m, d, len(loops)), acceleration]))
    mass = np.zeros((m.nv, m.nv))
    mj.mj_fullM(m, d, mass)
    driven = dofs(m, robot.joint_names)
    solution, third = least(np.hstack([np.eye(m.nv)[:, driven], loops.T]), mass @ qacc + d.qfrc_bias)
    return Answer(solution[: len(driven)], d.qvel[driven].copy(), qacc[driven], max(first, second, third))


def loop_bias(m: Model, d: Data, rows: int) -> np.ndarray:
    """(rows,) the part of the loops' acceleration that the coordinates' rates cause: Jc-dot qvel."""
    bias = np.zeros(rows)
    for k in np.flatnonzero(m.eq_type == mujoco().mjtEq.mjEQ_CONNECT):
        first, second = m.eq_obj1id[k], m.eq_obj2id[k]
        point = d.xpos[first] + d.xmat[first].reshape(3, 3) @ m.eq_data[k, :3]
        ends = np.zeros((2, 3, m.nv))
        mujoco().mj_jacDot(m, d, ends[0], None, point, first)
        mujoco().mj_jacDot(m, d, ends[1], None, point, second)
        bias[d.efc_id[:rows] == k] = (ends[0] - ends[1]) @ d.qvel
    return bias


def dofs(m: Model, names: tuple[str, ...]) -> list[int]:
    """Where the coordinates of joints are in `qvel`."""
    return [int(m.joint(name).dofadr[0]) for name in names]


def least(rows: np.ndarray, wanted: np.ndarray) -> tuple[np.ndarray, float]:
    """The shortest solution and how far it misses, relative to what is wanted."""
    solution = np.linalg.lstsq(rows, wanted, rcond=1e-9)[0]
    return solution, float(np.abs(rows @ solution - wanted).max() / (np.abs(wanted).max() + 1e-12))
