"""A planned motion with everything that people want to see of it: joints, efforts, and what touches a limit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from app.motion.demands import KINDS
from app.motion.settings import MotionSettings
from app.motion.trajectory import Array, Trajectory
from app.motion.work_cycle import WorkCycle
from app.robots import Robot
from app.robots.dynamics import Dynamics
from app.robots.dynamics.elementwise import stacked
from app.robots.limits import DriveLimits

STEP_S, FEWEST, MOST = 0.002, 400, 4000
"""Spacing of the instants of a motion, and how many there are at least and at most."""

BESIDE_S = 1e-6
"""So long before and after a jump."""

TOUCHED = 0.99
"""A limit counts as touched from this share on."""

EXCEEDED = 1.002
"""And as exceeded from this: a planner may miss the very top of a peak by less."""


@dataclass(frozen=True, eq=False)
class Motion:
    """k instants of a robot with n joints; SI units and radians."""

    settings: MotionSettings | WorkCycle
    trajectory: Trajectory
    t: Array
    """(k,) from 0 to the end; evenly, but for the instants at which an acceleration jumps."""
    pose: Array
    """(k, dof)"""
    rate: Array
    acceleration: Array
    q: Array
    """(k, n)"""
    joint_rates: Array
    joint_accelerations: Array
    efforts: Array
    """(k, n) joint torques or forces by the rigid-body model, friction left out."""
    limits: DriveLimits
    """What may be used of the drives."""
    limiting: str
    """One sentence: which joint is nearest to which of its limits, and when."""
    binding: tuple[str, ...] = KINDS
    """The kinds of limits that this motion keeps to."""

    @property
    def title(self) -> str:
        return self.trajectory.title

    @property
    def duration_s(self) -> float:
        return self.trajectory.duration_s

    @cached_property
    def shares(self) -> Array:
        """(k, 3, n) speed, acceleration and effort of each joint over its limit."""
        return shares_of(self.joint_rates, self.joint_accelerations, self.efforts, self.limits)

    @cached_property
    def usage(self) -> Array:
        """(k,) the largest share of a binding limit: above 1 it is exceeded."""
        return self.shares[:, _rows(self.binding)].max(axis=(1, 2))

    @property
    def touched(self) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
        """(k,) where some limit is touched."""
        return self.usage >= TOUCHED


def instants(duration_s: float, corners: ArrayLike = ()) -> Array:
    """(k,) at which a motion is recorded: evenly, and right before and after each corner."""
    steps = int(np.clip(duration_s / STEP_S, FEWEST, MOST))
    times = np.asarray(corners, dtype=float)
    beside = np.concatenate([times - BESIDE_S, times + BESIDE_S])
    inside = beside[(beside > 0.0) & (beside < duration_s)]
    return np.union1d(np.linspace(0.0, duration_s, steps + 1), inside)


def record(
    settings: MotionSettings | WorkCycle,
    dynamics: Dynamics,
    trajectory: Trajectory,
    limits: DriveLimits,
    *,
    corners: ArrayLike = (),
    binding: tuple[str, ...] = KINDS,
    effort: Callable[[Array, Array, Array, Array], Array] | None = None,
) -> Motion:
    """The motion of a trajectory.

    Args:
        corners: times (s) at which the acceleration may jump.
        effort: (t, pose, rate, acceleration) -> (k, n), where it is more than `dynamics` knows.
    """
    t = instants(trajectory.duration_s, corners)
    state = pose, rate, acceleration = trajectory.sample(t)
    terms, push = dynamics.columns(pose, rate), tuple(acceleration.T)
    efforts = stacked(terms.effort(push)) if effort is None else effort(t, *state)
    joint_rates, joint_accelerations = stacked(terms.joint_rates), stacked(terms.joint_acceleration(push))
    shares = shares_of(joint_rates, joint_accelerations, efforts, limits)
    return Motion(
        settings=settings,
        trajectory=trajectory,
        t=t,
        pose=pose,
        rate=rate,
        acceleration=acceleration,
        q=stacked(terms.joints),
        joint_rates=joint_rates,
        joint_accelerations=joint_accelerations,
        efforts=efforts,
        limits=limits,
        limiting=_limiting(dynamics.robot, t, shares, binding),
        binding=binding,
    )


def shares_of(rates: Array, accelerations: Array, efforts: Array, limits: DriveLimits) -> Array:
    """(k, 3, n) of the limits, from (k, n) each."""
    return np.abs(np.stack([rates, accelerations, efforts], axis=1)) / np.stack(limits)


def drive_name(robot: Robot, joint: int, kind: str) -> tuple[str, str]:
    """How a sentence names a joint (from 0) and a kind of demand: ("Joint q1", "torque")."""
    if kind == "effort":
        kind = "force" if robot.joint_units[joint] == "m" else "torque"
    return f"Joint {robot.joint_names[joint]}", kind


def _rows(kinds: tuple[str, ...]) -> list[int]:
    return [KINDS.index(kind) for kind in kinds]


def _limiting(robot: Robot, t: Array, shares: Array, binding: tuple[str, ...]) -> str:
    shares = shares[:, _rows(binding)]
    instant, row, joint = np.unravel_index(int(np.argmax(shares)), shares.shape)
    share, when = float(shares[instant, row, joint]), float(t[instant])
    name, kind = drive_name(robot, int(joint), binding[row])
    if share > EXCEEDED:
        return f"{name} exceeds its {kind} limit: {100 * share:.0f} % at {when:.2f} s."
    if share >= TOUCHED:
        return f"{name} limits this motion by its {kind}, at {when:.2f} s."
    return f"Nothing is at its limit; {name.lower()} comes closest, with {100 * share:.0f} % of its {kind}."
