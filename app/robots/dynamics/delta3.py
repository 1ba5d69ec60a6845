"""Dynamics of the rotary delta with a platform that only translates: three legs felt at one point."""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.delta3 import ARM_AZIMUTHS, Delta3
from app.robots.dynamics.dynamics import Dynamics
from app.robots.dynamics.elementwise import Functions, Value
from app.robots.dynamics.inertia import GRAVITY, Delta3Inertia
from app.robots.dynamics.rotary_leg import RotaryLeg
from app.robots.dynamics.terms import Terms, ThreeLegTerms
from app.robots.dynamics.trilateration import lower_point


class Delta3Dynamics(Dynamics[Delta3, Delta3Inertia]):
    """See `rotary_leg`; pose (x, y, z), joints (q_1, q_2, q_3). The platform is a point mass."""

    def _bind(self) -> None:
        g, m = self.robot.geometry, self.inertia
        self._outward = (g.f - g.e) / (2.0 * math.sqrt(3.0))
        self._L, self._l = g.rf, g.re
        self._arms = [(math.cos(a), math.sin(a)) for a in ARM_AZIMUTHS]
        self._legs = [RotaryLeg(m, a, g.rf, g.re) for a in ARM_AZIMUTHS]
        self._shift = [(-self._outward * ca, -self._outward * sa) for ca, sa in self._arms]
        lifted = m.platform_mass + m.payload
        self._mass = lifted + sum(leg.carried for leg in self._legs)
        self._weight = GRAVITY * lifted + sum(leg.weight for leg in self._legs)

    def _terms(self, m: Functions, pose: Sequence[Value], rate: Sequence[Value]) -> ThreeLegTerms:
        x, y, z = pose
        vx, vy, vz = rate
        (s1x, s1y), (s2x, s2y), (s3x, s3y) = self._shift
        first, second, third = self._legs
        q1, w1, h1, ax, ay, az, *M1, nx1, ny1, nz1, g1 = first.felt(m, x + s1x, y + s1y, z, vx, vy, vz)
        q2, w2, h2, bx, by, bz, *M2, nx2, ny2, nz2, g2 = second.felt(m, x + s2x, y + s2y, z, vx, vy, vz)
        q3, w3, h3, cx, cy, cz, *M3, nx3, ny3, nz3, g3 = third.felt(m, x + s3x, y + s3y, z, vx, vy, vz)
        xx, xy, xz, yy, yz, zz = [a + b + c for a, b, c in zip(M1, M2, M3, strict=True)]
        mass = self._mass
        gx, gy = ax * g1 + bx * g2 + cx * g3, ay * g1 + by * g2 + cy * g3
        gz = az * g1 + bz * g2 + cz * g3 + self._weight
        return ThreeLegTerms(
            (x, y, z),
            (vx, vy, vz),
            (q1, q2, q3),
            (w1, w2, w3),
            (ax, ay, az, bx, by, bz, cx, cy, cz),
            (h1, h2, h3),
            (mass + xx, xy, xz, mass + yy, yz, mass + zz),
            (nx1 + nx2 + nx3 + gx, ny1 + ny2 + ny3 + gy, nz1 + nz2 + nz3 + gz),
            (gx, gy, gz),
        )

    def _potential(self, m: Functions, terms: Terms) -> Value:
        arms = sum(leg.moment * m.sin(q) for leg, q in zip(self._legs, terms.joints, strict=True))
        return self._weight * terms.pose[2] - arms

    def _pose_of(self, joints: Sequence[float], guess: Sequence[float]) -> tuple[float, ...]:
        """The spheres of the rods' far ends, moved inwards by the platform's radius."""
        centres = []
        for q, (ca, sa) in zip(joints, self._arms, strict=True):
            reach = self._outward + self._L * math.cos(q)
            centres.append((reach * ca, reach * sa, -self._L * math.sin(q)))
        return lower_point(centres[0], centres[1], centres[2], self._l)
