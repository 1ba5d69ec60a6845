"""Where to measure next: the poses that shrink the uncertainty most (D-optimal), one after another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.link.calibration.problem import Problem
from app.link.calibration.solve import scaled_jacobian
from app.robots import Robot

Array = NDArray[np.float64]

INSIDE = 0.05
"""Part of each range that is kept free at its ends: the machine is not quite the one that is assumed."""


@dataclass(frozen=True, eq=False)
class NextPoses:
    """m poses, in the order in which they help."""

    pose: Array
    """(m, dof) in the robot's frame, by the machine as it is known now."""
    joints: Array
    """(m, n) that the board will report there."""
    deviations: Array
    """(p,) standard deviations of the unknowns once all are measured, rad and m."""


def next_poses(
    problem: Problem,
    values: Array | None = None,
    information: Array | None = None,
    *,
    count: int = 4,
    candidates: int = 200,
    with_angle: bool = False,
    seed: int = 0,
) -> NextPoses:
    """The best of some random poses inside reach, each chosen with those before it in mind.

    `values` and `information` are those of a `Solution`; without them the first poses of a calibration are chosen.
    `with_angle`: the rotation will be measured too.
    """
    known = problem.assumed if values is None else values
    p = len(problem.unknowns)
    reported, pose = _candidates(problem, known, candidates, seed)
    noise = np.full((len(pose), 4), problem.noise_m)
    noise[:, 3] = problem.angle_noise if with_angle and pose.shape[1] == 4 else np.inf
    A = scaled_jacobian(problem, known, reported, noise)
    C = np.linalg.inv(np.eye(p) + (np.zeros((p, p)) if information is None else information))
    chosen: list[int] = []
    for _ in range(min(count, len(pose))):
        gains = np.linalg.slogdet(np.eye(4) + np.einsum("kip,pq,kjq->kij", A, C, A))[1]
        gains[chosen] = -np.inf  # a second look at the same place is no look from another side
        chosen.append(int(np.argmax(gains)))
        a = A[chosen[-1]]
        C = C - C @ a.T @ np.linalg.inv(np.eye(4) + a @ C @ a.T) @ a @ C
    return NextPoses(pose[chosen], reported[chosen], problem.tolerances * np.sqrt(np.diag(C)))


def _candidates(problem: Problem, values: Array, count: int, seed: int) -> tuple[Array, Array]:
    """Reported joints and poses within reach."""
    robot: Robot = problem.build(values)
    low, high = robot.joint_limits.T
    low, high = low + INSIDE * (high - low), high - INSIDE * (high - low)
    drawn = np.random.default_rng(seed).uniform(low, high, (20 * count, len(low)))
    pose = robot.forward(drawn)
    known = ~np.isnan(pose).any(axis=1)
    if pose.shape[1] == 4:
        known &= np.abs(pose[:, 3]) <= (1.0 - 2.0 * INSIDE) * robot.rotation_limit
    drawn, pose = drawn[known], pose[known]
    inside = robot.reachable(pose) & np.isclose(robot.inverse(pose), drawn, atol=1e-6).all(axis=1)
    joints, pose = drawn[inside][:count], pose[inside][:count]
    if not len(pose):
        pose = robot.home[None]
        joints = robot.inverse(pose)
    return joints - problem.offsets(values), pose
