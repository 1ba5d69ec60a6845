"""Sliding mode, the robust example: whatever the model misses is overpowered, not estimated."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from app.control.laws.law import Array, Law, Seen, Setup, inertial_of_joints, joint_bias
from app.robots.dynamics import Terms

EFFORT_SHARE = 0.05
"""Change of a disturbance that is met, in shares of the joint's peak effort per 1 / w."""


class SlidingMode(Law):
    """Super-twisting (Levant 1993) around computed torque, smoothed near s = 0 so that it does not chatter.

    s = edot + w e,   f = M(qdd_d + w edot + k1 s / sqrt(|s| + eps) + z) + H,   zdot = k2 sat(s / eps)

    k1 = 1.5 sqrt(L) and k2 = 1.1 L resist disturbances that change by L (rad/s^3 or m/s^3); eps is where the slope
    of the first term is 2 w.
    """

    def __init__(self, setup: Setup) -> None:
        super().__init__(setup)
        reference, tuning = setup.reference, setup.tuning
        self._joints, self._rates = reference.joints.tolist(), reference.joint_rates.tolist()
        self._accelerations = reference.joint_accelerations.tolist()
        self._omega = [math.tau * hertz for hertz in tuning.bandwidth_hz]
        effort = zip(self._omega, setup.effort_limit.tolist(), tuning.inertia, strict=True)
        strength = [tuning.reaching * EFFORT_SHARE * w * peak / mass for w, peak, mass in effort]
        self._k1 = [1.5 * math.sqrt(L) for L in strength]
        self._k2 = [1.1 * L for L in strength]
        self._eps = [(k1 / (2.0 * w)) ** 2 for k1, w in zip(self._k1, self._omega, strict=True)]
        self._twist = [0.0] * len(self._omega)
        self._trace: list[list[float]] = []

    def effort(self, k: int, state: Terms, applied: Sequence[float]) -> Sequence[float]:
        errors = [wanted - is_ for wanted, is_ in zip(self._joints[k], state.joints, strict=True)]
        rates = [wanted - is_ for wanted, is_ in zip(self._rates[k], state.joint_rates, strict=True)]
        pull = self._pull([ed + w * e for ed, w, e in zip(rates, self._omega, errors, strict=True)])
        self._trace.append(pull)
        parts = zip(self._accelerations[k], self._omega, rates, pull, strict=True)
        return state.effort(state.pose_acceleration([a + w * ed + s for a, w, ed, s in parts]))

    def _pull(self, sliding: Sequence[float]) -> list[float]:
        """Accelerations towards s = 0, and a step of z."""
        period, before = self.setup.period_s, self._twist
        gains = zip(before, self._k2, self._eps, sliding, strict=True)
        self._twist = [z + period * k2 * max(-1.0, min(1.0, s / eps)) for z, k2, eps, s in gains]
        now = zip(before, self._k1, self._eps, sliding, strict=True)
        return [z + k1 * s / math.sqrt(abs(s) + eps) for z, k1, eps, s in now]

    def components(self, seen: Seen) -> dict[str, Array]:
        reference, terms = self.setup.reference, seen.terms
        return {
            "d": inertial_of_joints(terms, np.array(self._omega) * (reference.joint_rates - seen.joint_rates)),
            "s": inertial_of_joints(terms, np.array(self._trace)),
            "M": inertial_of_joints(terms, reference.joint_accelerations),
            "n": joint_bias(terms, len(seen.joints)),
        }
