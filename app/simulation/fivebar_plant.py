"""The analytic five-bar written out: at 4 kHz, loops over its four axes would cost more than the equations do."""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.dynamics.fivebar import FiveBarTerms
from app.simulation.plant import ExactPlant


class FiveBarPlant(ExactPlant):
    """The same step as `ExactPlant`'s, on plain numbers."""

    def _step(self, effort: Sequence[float], step: float) -> None:
        now = self.terms
        assert isinstance(now, FiveBarTerms)
        if self._drag is not None:
            effort = self._slowed(now, effort, step)
        before, half = self._before or now, 0.5 * step
        (x, y, z, t), (vx, vy, vz, vt) = now.pose, now.rate
        ax, ay, az, at = now.acceleration(effort)
        bx, by, bz, bt = ax, ay, az, at
        if before is not now:
            bx, by, bz, bt = before.acceleration(effort)
        gx, gy, gz, gt = half * (3.0 * ax - bx), half * (3.0 * ay - by), half * (3.0 * az - bz), half * (3.0 * at - bt)
        pose = (
            x + step * (vx + 0.5 * gx),
            y + step * (vy + 0.5 * gy),
            z + step * (vz + 0.5 * gz),
            t + step * (vt + 0.5 * gt),
        )
        self._before, self.terms = now, self._dynamics.at(pose, (vx + gx, vy + gy, vz + gz, vt + gt))

    def _slowed(self, now: FiveBarTerms, effort: Sequence[float], step: float) -> Sequence[float]:
        """`Drag.left_over`"""
        assert self._drag is not None
        (c1, b1, w1, s1, m1), (c2, b2, w2, s2, m2), (c3, b3, w3, s3, m3), (c4, b4, w4, s4, m4) = self._drag.rows
        tanh, half = math.tanh, 0.5 * step
        (f1, f2, f3, f4), (v1, v2, v3, v4), (h1, h2, _, _) = effort, now.joint_rates, now.joint_bias
        t1, t2, t3, t4 = tanh(w1 * v1), tanh(w2 * v2), tanh(w3 * v3), tanh(w4 * v4)
        f1, f2, f3, f4 = f1 - c1 * t1 - b1 * v1, f2 - c2 * t2 - b2 * v2, f3 - c3 * t3 - b3 * v3, f4 - c4 * t4 - b4 * v4
        a1, a2, a3, a4 = now.to_joints(now.acceleration((f1, f2, f3, f4)))
        k1, k2 = b1 + s1 * (1.0 - t1 * t1), b2 + s2 * (1.0 - t2 * t2)
        k3, k4 = b3 + s3 * (1.0 - t3 * t3), b4 + s4 * (1.0 - t4 * t4)
        return (
            f1 - half * k1 / (1.0 + step * k1 * m1) * (a1 + h1),
            f2 - half * k2 / (1.0 + step * k2 * m2) * (a2 + h2),
            f3 - half * k3 / (1.0 + step * k3 * m3) * a3,
            f4 - half * k4 / (1.0 + step * k4 * m4) * a4,
        )
