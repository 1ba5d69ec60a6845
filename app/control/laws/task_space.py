"""Inverse dynamics in task space, the 5R paper's centralised laws."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.control.laws.integral import integral_of
from app.control.laws.law import Array, Law, Seen, Setup, inertial_of_pose
from app.robots.dynamics import Terms
from app.robots.dynamics.elementwise import stacked


class TaskSpace(Law):
    """f = M_p (pdd_sp + Kd edot + Kp e [+ Ki E]) + n_p with e = p_sp - p (fivebar B7)."""

    def __init__(self, setup: Setup, integral: bool = False) -> None:
        super().__init__(setup)
        reference, tuning = setup.reference, setup.tuning
        self._kp, self._kd, self._ki = tuning.gains()
        self._pose = reference.pose.tolist()
        goal = reference.acceleration + reference.rate * self._kd + reference.pose * self._kp
        self._goal = goal.tolist()
        self._no_sums = [0.0] * len(self._kp)
        self._integral = integral_of(setup, self._ki) if integral else None

    def effort(self, k: int, state: Terms, applied: Sequence[float]) -> Sequence[float]:
        p, v, sums = state.pose, state.rate, self._no_sums
        if self._integral is not None:
            sums = self._integral.after(self._pose[k], p)
        rows = zip(self._goal[k], self._kp, p, self._kd, v, self._ki, sums, strict=True)
        return state.effort([goal - kp * p - kd * v + ki * total for goal, kp, p, kd, v, ki, total in rows])

    def components(self, seen: Seen) -> dict[str, Array]:
        reference = self.setup.reference
        parts = {
            "p": np.array(self._kp) * (reference.pose - seen.pose),
            "d": np.array(self._kd) * (reference.rate - seen.rate),
            "M": reference.acceleration,
        }
        if self._integral is not None:
            parts["i"] = np.array(self._ki) * np.array(self._integral.trace)
        efforts = {name: inertial_of_pose(seen.terms, acceleration) for name, acceleration in parts.items()}
        return {**efforts, "n": stacked(seen.terms.bias(), seen.pose.shape[:1])}
