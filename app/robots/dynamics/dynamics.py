"""What every robot's dynamics can do, with one source of formulas for one state and for many.

A subclass writes its equations of motion once, elementwise (`_terms`). `at` evaluates them on plain floats: a few
microseconds, for control steps. The methods on arrays evaluate the same lines on columns.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Generic, Literal, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from app.robots.dynamics.elementwise import COLUMNS, FLOATS, Functions, Value, Values, stacked
from app.robots.dynamics.inertia import Inertia
from app.robots.dynamics.terms import Terms
from app.robots.robot import Array, Robot

Space = Literal["pose", "joint"]
RobotT = TypeVar("RobotT", bound=Robot)
InertiaT = TypeVar("InertiaT", bound=Inertia)
State = tuple[tuple[float, ...], tuple[float, ...]]


class Dynamics(ABC, Generic[RobotT, InertiaT]):
    """Equations of motion of one robot with fixed masses:  M(p) a + n(p, v) = J^T f.

    Poses p, rates v and accelerations a are (..., dof), joint efforts f (..., n), in SI units; leading axes
    broadcast. An unreachable pose gives NaN.
    """

    def __init__(self, robot: RobotT, inertia: InertiaT) -> None:
        self.robot, self.inertia = robot, inertia
        self._nowhere = (math.nan,) * robot.dof
        self._bind()

    def at(self, pose: Sequence[float], rate: Sequence[float]) -> Terms:
        """The equations at one state, on plain floats."""
        try:
            return self._terms(FLOATS, pose, rate)
        except (ValueError, ZeroDivisionError):  # the root of a negative number, or a rod in line with its arm
            terms = self._terms(FLOATS, self._nowhere, self._nowhere)
            terms.pose, terms.rate = tuple(pose), tuple(rate)
            return terms

    def columns(self, pose: ArrayLike, rate: ArrayLike) -> Terms:
        """The equations at k states (k, dof), on columns (k,): every method of `Terms` answers with columns too."""
        poses, rates = (np.ascontiguousarray(np.asarray(values, dtype=float).T) for values in (pose, rate))
        with np.errstate(all="ignore"):
            return self._terms(COLUMNS, tuple(poses), tuple(rates))

    def locate(self, joints: Sequence[float], joint_rates: Sequence[float], guess: Sequence[float]) -> State:
        """Pose (dof,) and its rate from joints (n,), on plain floats; NaN where the loops cannot close.

        Args:
            guess: a pose nearby, such as the last one.
        """
        try:
            pose = self._pose_of(joints, guess)
            return pose, self._terms(FLOATS, pose, pose).to_pose(joint_rates)
        except (ValueError, ZeroDivisionError):
            return self._nowhere, self._nowhere

    def inverse(self, pose: ArrayLike, rate: ArrayLike, acceleration: ArrayLike) -> Array:
        """(..., n) joint efforts that give the pose acceleration (..., dof)."""
        return self._evaluate(lambda terms, a: terms.effort(a), pose, rate, acceleration)

    def forward(self, pose: ArrayLike, rate: ArrayLike, effort: ArrayLike) -> Array:
        """(..., dof) pose acceleration under joint efforts (..., n)."""
        return self._evaluate(lambda terms, f: terms.acceleration(f), pose, rate, effort)

    def joint_rates(self, pose: ArrayLike, rate: ArrayLike) -> Array:
        """(..., n) J v"""
        return self._evaluate(lambda terms: terms.joint_rates, pose, rate)

    def joint_accelerations(self, pose: ArrayLike, rate: ArrayLike, acceleration: ArrayLike) -> Array:
        """(..., n) J a + Jdot v"""
        return self._evaluate(lambda terms, a: terms.joint_acceleration(a), pose, rate, acceleration)

    def gravity(self, pose: ArrayLike, space: Space = "pose") -> Array:
        """(..., n) what holds the robot at rest: along the pose coordinates, or the joint efforts."""
        still = np.zeros(self.robot.dof)
        if space == "joint":
            return self._evaluate(lambda terms: terms.gravity(), pose, still)
        return self._evaluate(lambda terms: terms.gravity_force, pose, still)

    def bias(self, pose: ArrayLike, rate: ArrayLike, space: Space = "pose") -> Array:
        """(..., n) Coriolis, centrifugal and gravity: the pose force n at a = 0, or the effort at qdd = 0."""
        if space == "joint":
            return self._evaluate(_effort_at_constant_joint_rates, pose, rate)
        return self._evaluate(lambda terms: terms.bias_force, pose, rate)

    def mass_matrix(self, pose: ArrayLike, space: Space = "pose") -> Array:
        """(..., n, n) M of the pose coordinates, or J^-T M J^-1 of the joints."""
        poses = np.asarray(pose, dtype=float)[..., None, :]
        still, units = np.zeros(self.robot.dof), np.eye(self.robot.dof)
        if space == "joint":
            columns = self._evaluate(lambda terms, u: terms.inertial(terms.to_pose(u)), poses, still, units)
        else:
            columns = self._evaluate(lambda terms, u: terms.mass_times(u), poses, still, units)
        return np.swapaxes(columns, -1, -2)

    def coriolis(self, pose: ArrayLike, rate: ArrayLike, space: Space = "pose") -> Array:
        """(..., n, n) C with C v + g = n (or C qd + g in joint space) and Mdot - 2 C skew-symmetric.

        The one of the Christoffel symbols, C = 1/2 d(n - g)/dv. As n - g is quadratic in the rates, a central
        difference is exact, over any step.
        """
        poses, rates = np.broadcast_arrays(np.asarray(pose, dtype=float), np.asarray(rate, dtype=float))
        poses, rates = poses[..., None, :], rates[..., None, :]
        units = np.eye(self.robot.dof)
        if space == "joint":
            units = self._evaluate(lambda terms, u: terms.to_pose(u), poses, np.zeros(self.robot.dof), units)
        columns = 0.25 * (self.bias(poses, rates + units, space) - self.bias(poses, rates - units, space))
        return np.swapaxes(columns, -1, -2)

    def kinetic_energy(self, pose: ArrayLike, rate: ArrayLike) -> Array:
        """(...,) 1/2 v^T M v, J"""
        energy = self._evaluate(lambda terms: (0.5 * _dot(terms.rate, terms.mass_times(terms.rate)),), pose, rate)
        return energy[..., 0]

    def potential_energy(self, pose: ArrayLike) -> Array:
        """(...,) J, from a height of the robot's own: only differences mean something."""
        still = np.zeros(self.robot.dof)
        return self._evaluate(lambda terms: (self._potential(COLUMNS, terms),), pose, still)[..., 0]

    def _evaluate(self, formula: Callable[..., Values], pose: ArrayLike, rate: ArrayLike, *more: ArrayLike) -> Array:
        """`formula` of the terms and the columns of `more`, its values stacked along the last axis."""
        arrays = np.broadcast_arrays(*(np.asarray(values, dtype=float) for values in (pose, rate, *more)))
        if arrays[0].shape[-1:] != (self.robot.dof,):
            raise ValueError(f"The dynamics of {self.robot.name} expect arrays of shape (..., {self.robot.dof}).")
        p, v, *rest = (tuple(np.ascontiguousarray(np.moveaxis(values, -1, 0))) for values in arrays)
        with np.errstate(all="ignore"):
            values = formula(self._terms(COLUMNS, p, v), *rest)
        return stacked(values, arrays[0].shape[:-1])

    @abstractmethod
    def _bind(self) -> None:
        """Take the constants of the formulas from geometry and masses."""

    @abstractmethod
    def _terms(self, m: Functions, pose: Sequence[Value], rate: Sequence[Value]) -> Terms:
        """The equations of motion, elementwise."""

    @abstractmethod
    def _potential(self, m: Functions, terms: Terms) -> Value:
        """Potential energy, elementwise."""

    @abstractmethod
    def _pose_of(self, joints: Sequence[float], guess: Sequence[float]) -> tuple[float, ...]:
        """Forward kinematics on plain floats; ValueError where there is none."""


def _effort_at_constant_joint_rates(terms: Terms) -> Values:
    return terms.effort(terms.to_pose([-h for h in terms.joint_bias]))


def _dot(a: Values, b: Values) -> Value:
    return sum(x * y for x, y in zip(a, b, strict=True))
