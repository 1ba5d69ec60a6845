"""What a closed loop acts on: efforts in, motion out. The analytic robot, and the friction of its drives."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from app.robots import Robot
from app.robots.dynamics import INERTIA, Inertia, Terms, dynamics_of

Values = tuple[float, ...]

STEP_S = 0.001
"""Longest step of the analytic plant."""


class Plant(Protocol):
    """A robot that can be driven; what it tells is the truth, no sensor stands between."""

    @property
    def joints(self) -> Values:
        """(n,) rad or m"""
        ...

    @property
    def joint_rates(self) -> Values:
        """(n,) rad/s or m/s"""
        ...

    @property
    def pose(self) -> Values:
        """(dof,) m and rad"""
        ...

    @property
    def rate(self) -> Values:
        """(dof,) m/s and rad/s"""
        ...

    def advance(self, effort: Sequence[float], duration_s: float) -> None:
        """Time passes while the drives hold their efforts (n,), N m or N."""
        ...

    def set_payload(self, kg: float) -> None:
        """From now on the tool carries this."""
        ...


@dataclass(frozen=True)
class Friction:
    """tau_c tanh(qd / width) + b qd in each drive, at the joint."""

    coulomb: Values
    """(n,) N m or N"""
    viscous: Values
    """(n,) N m s/rad or N s/m"""
    width: float
    """rad/s or m/s"""

    def scaled(self, factor: float) -> Friction:
        """Both kinds times a factor."""
        coulomb, viscous = (tuple([factor * value for value in values]) for values in (self.coulomb, self.viscous))
        return Friction(coulomb, viscous, self.width)

    def at(self, rates: Sequence[float]) -> tuple[list[float], list[float]]:
        """Per joint at rates (n,): friction, N m or N, and its slope by the rate, N m s or N s/m."""
        forces, slopes, w = [], [], self.width
        for c, b, v in zip(self.coulomb, self.viscous, rates, strict=True):
            bend = math.tanh(v / w)
            forces.append(c * bend + b * v)
            slopes.append(c * (1.0 - bend * bend) / w + b)
        return forces, slopes


FRICTION: dict[str, Friction] = {
    "par4": Friction((0.30,) * 4, (0.10,) * 4, 0.01),
    "delta3": Friction((0.12,) * 3, (0.04,) * 3, 0.01),
    "linear": Friction((2.0,) * 3, (8.0,) * 3, 0.001),
    "fivebar": Friction((8.0, 8.0, 3.0, 3.0), (2.0, 2.0, 0.1, 0.1), 0.01),
}
"""By robot. linear and fivebar as in the spec (A6, B7); par4 and delta3 are declared, 10 and 8 % of the peak effort."""


class ExactPlant:
    """The analytic equations of motion, in coordinates of the tool, with one evaluation of them a step.

    Over a step h the acceleration a under the held efforts is extrapolated from the states at its start and one step
    before (Adams-Bashforth): v += h (3/2 a - 1/2 a_before), p += h v + h^2/2 of the same. Efforts jump from step to
    step, the equations do not: both accelerations are taken under the new efforts. Friction is too stiff for that and
    is linearly implicit, joint by joint: its mean over the step is f + f'/2 dqd, dqd = h qdd / (1 + h f' / 2 M_j).
    """

    def __init__(
        self,
        robot: Robot,
        inertia: Inertia | None = None,
        *,
        pose: Sequence[float],
        rate: Sequence[float] | None = None,
        friction: Friction | None = None,
    ) -> None:
        """
        Args:
            pose: (dof,) where it stands, m and rad.
            rate: (dof,) how it moves; at rest unless given.
        """
        self._robot, self._inertia = robot, INERTIA[robot.name] if inertia is None else inertia
        self._dynamics = dynamics_of(robot, self._inertia)
        self.terms: Terms = self._dynamics.at(tuple(map(float, pose)), tuple(map(float, rate or (0.0,) * robot.dof)))
        """The equations at the present state."""
        self._before: Terms | None = None
        self._step_s = 0.0
        self._drag = None if friction is None else Drag(friction, self._joint_masses())

    @property
    def joints(self) -> Values:
        return self.terms.joints

    @property
    def joint_rates(self) -> Values:
        return self.terms.joint_rates

    @property
    def pose(self) -> Values:
        return self.terms.pose

    @property
    def rate(self) -> Values:
        return self.terms.rate

    def advance(self, effort: Sequence[float], duration_s: float) -> None:
        steps = math.ceil(duration_s / STEP_S - 1e-9)
        step = duration_s / steps
        if step != self._step_s:
            self._step_s, self._before = step, None
        for _ in range(steps):
            self._step(effort, step)

    def set_payload(self, kg: float) -> None:
        self._inertia = self._inertia.changed(payload=kg)
        self._dynamics = dynamics_of(self._robot, self._inertia)
        self.terms, self._before = self._dynamics.at(self.terms.pose, self.terms.rate), None

    def _step(self, effort: Sequence[float], step: float) -> None:
        now, half = self.terms, 0.5 * step
        if self._drag is not None:
            effort = self._drag.left_over(now, effort, step)
        before = self._before or now
        pose, rate = [], []
        rows = zip(now.pose, now.rate, now.acceleration(effort), before.acceleration(effort), strict=True)
        for p, v, new, old in rows:
            gain = half * (3.0 * new - old)
            pose.append(p + step * (v + 0.5 * gain))
            rate.append(v + gain)
        self._before, self.terms = now, self._dynamics.at(pose, rate)

    def _joint_masses(self) -> list[float]:
        """(n,) what each joint feels where the run starts; the step's friction only needs the order of magnitude."""
        return self._dynamics.mass_matrix(self.pose, "joint").diagonal().tolist()


class Drag:
    """Friction within a step. `rows`: Coulomb, viscous, 1 / width, steepest slope and 1 / 2 M_j of each joint."""

    def __init__(self, friction: Friction, masses: Sequence[float]) -> None:
        self._friction = friction
        self._half_1_m = [0.5 / m for m in masses]
        per_width = 1.0 / friction.width
        columns = friction.coulomb, friction.viscous, self._half_1_m
        self.rows = [(c, b, per_width, c * per_width, half_1_m) for c, b, half_1_m in zip(*columns, strict=True)]

    def left_over(self, now: Terms, effort: Sequence[float], step: float) -> list[float]:
        """Efforts (n,) minus the friction's mean over the step."""
        forces, slopes = self._friction.at(now.joint_rates)
        start = [f - force for f, force in zip(effort, forces, strict=True)]
        moved, half = now.to_joints(now.acceleration(start)), 0.5 * step
        rows = zip(start, slopes, self._half_1_m, moved, now.joint_bias, strict=True)
        return [f - half * slope / (1.0 + step * slope * k) * (qdd + h) for f, slope, k, qdd, h in rows]
