"""Computed torque: the model turns each joint into a unit mass; an observer may take away what the model misses."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from app.control.laws.law import Array, Law, Seen, Setup, inertial_of_joints, joint_bias
from app.robots.dynamics import Terms


class ComputedTorque(Law):
    """f = M(q)(qdd_d + kd edot + kp e) + H(q, qdot), linear (50) with M and H at the actual joints."""

    def __init__(self, setup: Setup) -> None:
        super().__init__(setup)
        reference = setup.reference
        self._kp, self._kd, _ = setup.tuning.gains()
        goal = reference.joint_accelerations + reference.joint_rates * self._kd + reference.joints * self._kp
        self._goal = goal.tolist()

    def effort(self, k: int, state: Terms, applied: Sequence[float]) -> Sequence[float]:
        rows = zip(self._goal[k], self._kp, state.joints, self._kd, state.joint_rates, strict=True)
        return state.effort(state.pose_acceleration([goal - kp * q - kd * qd for goal, kp, q, kd, qd in rows]))

    def components(self, seen: Seen) -> dict[str, Array]:
        reference = self.setup.reference
        return {
            "p": inertial_of_joints(seen.terms, np.array(self._kp) * (reference.joints - seen.joints)),
            "d": inertial_of_joints(seen.terms, np.array(self._kd) * (reference.joint_rates - seen.joint_rates)),
            "M": inertial_of_joints(seen.terms, reference.joint_accelerations),
            "n": joint_bias(seen.terms, len(seen.joints)),
        }


class ObservedTorque(ComputedTorque):
    """Computed torque minus the estimated disturbance d, first order (linear spec A6):

    d += alpha (M (qdot_k - qdot_k-1) / T + H - f_k-1 - d), M and H of instant k-1, where f_k-1 began to act.
    """

    def __init__(self, setup: Setup) -> None:
        super().__init__(setup)
        self._share = 1.0 - math.exp(-2.0 * math.pi * setup.tuning.observer_hz * setup.period_s)
        self._disturbance = [0.0] * len(self._kp)
        self._before: Terms | None = None
        self._trace: list[list[float]] = []

    def effort(self, k: int, state: Terms, applied: Sequence[float]) -> Sequence[float]:
        if self._before is not None:
            self._observe(self._before, state, applied)
        self._before = state
        self._trace.append(self._disturbance)
        return [f - d for f, d in zip(super().effort(k, state, applied), self._disturbance, strict=True)]

    def _observe(self, before: Terms, now: Terms, applied: Sequence[float]) -> None:
        per_s, share = 1.0 / self.setup.period_s, self._share
        gained = [per_s * (new - old) for new, old in zip(now.joint_rates, before.joint_rates, strict=True)]
        needed = before.effort(before.pose_acceleration(gained))
        self._disturbance = [
            d + share * (f_model - f - d) for d, f_model, f in zip(self._disturbance, needed, applied, strict=True)
        ]

    def components(self, seen: Seen) -> dict[str, Array]:
        return {**super().components(seen), "dob": -np.array(self._trace)}
