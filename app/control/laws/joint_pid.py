"""Decentralised laws: each joint has a controller of its own, the model helps at most from outside."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.control.laws.integral import integral_of
from app.control.laws.law import Array, Law, Seen, Setup
from app.robots.dynamics import Terms
from app.robots.dynamics.elementwise import stacked


class JointPid(Law):
    """f = Kp e + Kd edot + Ki int(e), and on demand gravity at the actual joints or what the reference needs.

    linear (39), (40); fivebar B7: Kp = M_j w^2, Kd = 2 zeta w M_j.
    """

    def __init__(self, setup: Setup, integral: bool = False, gravity: bool = False, forward: bool = False) -> None:
        super().__init__(setup)
        tuning, reference = setup.tuning, setup.reference
        self._kp, self._kd, self._ki = tuning.joint_gains()
        self._joints = reference.joints.tolist()
        goal = reference.joint_rates * self._kd + reference.joints * self._kp
        self._forward = setup.model.inverse(reference.pose, reference.rate, reference.acceleration) if forward else None
        self._goal = (goal if self._forward is None else goal + self._forward).tolist()
        self._no_sums = [0.0] * len(self._kp)
        self._integral = integral_of(setup, self._ki) if integral else None
        self._gravity = gravity

    def effort(self, k: int, state: Terms, applied: Sequence[float]) -> Sequence[float]:
        q, qd, sums = state.joints, state.joint_rates, self._no_sums
        if self._integral is not None:
            sums = self._integral.after(self._joints[k], q)
        rows = zip(self._goal[k], self._kp, q, self._kd, qd, self._ki, sums, strict=True)
        effort = [goal - kp * q - kd * qd + ki * total for goal, kp, q, kd, qd, ki, total in rows]
        if self._gravity:
            effort = [f + g for f, g in zip(effort, state.gravity(), strict=True)]
        return effort

    def components(self, seen: Seen) -> dict[str, Array]:
        reference = self.setup.reference
        parts = {
            "p": np.array(self._kp) * (reference.joints - seen.joints),
            "d": np.array(self._kd) * (reference.joint_rates - seen.joint_rates),
        }
        if self._integral is not None:
            parts["i"] = np.array(self._ki) * np.array(self._integral.trace)
        if self._gravity:
            parts["n"] = stacked(seen.terms.gravity(), seen.joints.shape[:1])
        if self._forward is not None:
            parts["ff"] = self._forward
        return parts
