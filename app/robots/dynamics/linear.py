"""Dynamics of the linear delta (spec A5): carriages, rods as rigid bodies and a platform that only translates.

With m_i = (x, y) - zeta_i, h_i = sqrt(l^2 - |m_i|^2) and J_i = (m_i / h_i, -1), s_i = m_i . v / h_i

    Jdot_i v = (v_x^2 + v_y^2 + s_i^2) / h_i
    M = (m_p + 6c) 1 + (m_s + 2a) J^T J + 2b (u Js^T + Js u^T),   u = (0, 0, -1), Js the sum of the rows J_i
    n = sum_i ((m_s + 2a) J_i + 2b u) Jdot_i v - g_s Js + (0, 0, g_p)

a, b, c is the form of one rod, g_s and g_p are the weights of a carriage and of the platform with their rod ends.
"""

from __future__ import annotations

from collections.abc import Sequence

from app.robots.dynamics.dynamics import Dynamics
from app.robots.dynamics.elementwise import Functions, Value
from app.robots.dynamics.inertia import GRAVITY, LinearInertia
from app.robots.dynamics.rods import rigid_rod, two_points
from app.robots.dynamics.terms import Terms, ThreeLegTerms
from app.robots.dynamics.trilateration import lower_point
from app.robots.linear import LinearDelta


class LinearDynamics(Dynamics[LinearDelta, LinearInertia]):
    """See the module; pose (x, y, z), joints (d_1, d_2, d_3)."""

    def _bind(self) -> None:
        g, m = self.robot.geometry, self.inertia
        if m.lumped is None:
            rod = rigid_rod(m.rod_mass, m.rod_com, m.rod_inertia, g.l)
        else:
            rod = two_points(m.rod_mass, m.lumped)
        side, front = 0.5 * (g.S_A - g.s_p), g.W_A - g.w_p
        self._l, self._zeta = g.l, ((-side, -front), (side, -front), (0.0, g.U_A - g.u_b))
        (self._x1, self._y1), (self._x2, self._y2), (self._x3, self._y3) = self._zeta
        self._carriage, self._shared = m.carriage_mass + 2.0 * rod.a, 2.0 * rod.b
        self._platform = m.platform_mass + m.payload + 6.0 * rod.c
        self._weights = (
            GRAVITY * (m.carriage_mass + 2.0 * rod.near),
            GRAVITY * (m.platform_mass + m.payload + 6.0 * rod.far),
        )

    def _terms(self, m: Functions, pose: Sequence[Value], rate: Sequence[Value]) -> ThreeLegTerms:
        x, y, z = pose
        vx, vy, vz = rate
        sqrt, l2, v2 = m.sqrt, self._l * self._l, vx * vx + vy * vy
        ax, ay, bx, by, cx, cy = x - self._x1, y - self._y1, x - self._x2, y - self._y2, x - self._x3, y - self._y3
        h1, h2, h3 = sqrt(l2 - ax * ax - ay * ay), sqrt(l2 - bx * bx - by * by), sqrt(l2 - cx * cx - cy * cy)
        k1, k2, k3 = 1.0 / h1, 1.0 / h2, 1.0 / h3
        ax, ay, bx, by, cx, cy = ax * k1, ay * k1, bx * k2, by * k2, cx * k3, cy * k3
        s1, s2, s3 = ax * vx + ay * vy, bx * vx + by * vy, cx * vx + cy * vy
        r1, r2, r3 = (v2 + s1 * s1) * k1, (v2 + s2 * s2) * k2, (v2 + s3 * s3) * k3
        carriage, shared, platform = self._carriage, self._shared, self._platform
        g_s, g_p = self._weights
        sx, sy, r = ax + bx + cx, ay + by + cy, r1 + r2 + r3
        xx = platform + carriage * (ax * ax + bx * bx + cx * cx)
        xy = carriage * (ax * ay + bx * by + cx * cy)
        yy = platform + carriage * (ay * ay + by * by + cy * cy)
        nx, ny = carriage * (ax * r1 + bx * r2 + cx * r3), carriage * (ay * r1 + by * r2 + cy * r3)
        tilt, gx, gy, gz = carriage + shared, -g_s * sx, -g_s * sy, g_p + 3.0 * g_s
        return ThreeLegTerms(
            (x, y, z),
            (vx, vy, vz),
            (-z - h1, -z - h2, -z - h3),
            (s1 - vz, s2 - vz, s3 - vz),
            (ax, ay, -1.0, bx, by, -1.0, cx, cy, -1.0),
            (r1, r2, r3),
            (xx, xy, -tilt * sx, yy, -tilt * sy, platform + 3.0 * carriage + 6.0 * shared),
            (nx + gx, ny + gy, gz - tilt * r),
            (gx, gy, gz),
        )

    def _potential(self, m: Functions, terms: Terms) -> Value:
        g_s, g_p = self._weights
        d1, d2, d3 = terms.joints
        return g_p * terms.pose[2] - g_s * (d1 + d2 + d3)

    def _pose_of(self, joints: Sequence[float], guess: Sequence[float]) -> tuple[float, ...]:
        centres = [(x, y, -d) for (x, y), d in zip(self._zeta, joints, strict=True)]
        return lower_point(centres[0], centres[1], centres[2], self._l)
