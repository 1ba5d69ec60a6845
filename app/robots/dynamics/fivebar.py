"""Dynamics of the 5R (spec B2, B3): the planar linkage, and the screw that lifts and turns the tool.

Each distal link is a rod between its elbow and the tool, so that with A' = dE_k/dq_k, w = P - E_k and b = w . A'

    j = w / b,   qdd_k = j . a + h,   h = (|v - A' qd|^2 - w . A'' qd^2) / b
    leg k felt at P:   M = j s^T + s j^T + c 1,  s = k/2 j + b A';   n = k h j + b (A' h + A'' qd^2)

where a, b, c is the rod's form and k the inertia of arm, drive and near rod end about the motor. This is
M_5R = sum of m D^T D of the paper, summed by hand. The screw is the constant M_bss, in z and phi.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.dynamics.dynamics import Dynamics
from app.robots.dynamics.elementwise import Functions, Value, Values, reciprocal
from app.robots.dynamics.inertia import GRAVITY, FiveBarInertia
from app.robots.dynamics.rods import rigid_rod
from app.robots.dynamics.terms import Terms
from app.robots.fivebar import FiveBar


class FiveBarTerms(Terms):
    """2 x 2 in the plane, 2 x 2 for the screw."""

    __slots__ = ("mass", "rows", "screw")

    rows: Values
    """j_1 and j_2."""
    mass: Values
    """xx, xy, yy in the plane."""
    screw: tuple[float, float, float, float]
    """zz, z phi and phi phi of the mass matrix, and 2 pi / p."""

    def acceleration(self, effort: Sequence[Value]) -> Values:
        f1, f2, f3, f4 = effort
        ax, ay, bx, by = self.rows
        xx, xy, yy = self.mass
        zz, zt, tt, turn = self.screw
        nx, ny, nz, _ = self.bias_force
        x, y = ax * f1 + bx * f2 - nx, ay * f1 + by * f2 - ny
        z, t = -turn * f3 - nz, f3 + f4
        k, ks = reciprocal(xx * yy - xy * xy), 1.0 / (zz * tt - zt * zt)
        return (yy * x - xy * y) * k, (xx * y - xy * x) * k, (tt * z - zt * t) * ks, (zz * t - zt * z) * ks

    def effort(self, pose_acceleration: Sequence[Value]) -> Values:
        x, y, z, t = self.mass_times(pose_acceleration)
        nx, ny, nz, _ = self.bias_force
        return self.to_effort((x + nx, y + ny, z + nz, t))

    def inertial(self, pose_acceleration: Sequence[Value]) -> Values:
        return self.to_effort(self.mass_times(pose_acceleration))

    def mass_times(self, a: Sequence[Value]) -> Values:
        x, y, z, t = a
        xx, xy, yy = self.mass
        zz, zt, tt, _ = self.screw
        return xx * x + xy * y, xy * x + yy * y, zz * z + zt * t, zt * z + tt * t

    def to_effort(self, force: Sequence[Value]) -> Values:
        x, y, z, t = force
        ax, ay, bx, by = self.rows
        k = reciprocal(ax * by - ay * bx)
        f3 = z / -self.screw[3]
        return (by * x - bx * y) * k, (ax * y - ay * x) * k, f3, t - f3

    def to_joints(self, rate: Sequence[Value]) -> Values:
        x, y, z, t = rate
        ax, ay, bx, by = self.rows
        return ax * x + ay * y, bx * x + by * y, t - self.screw[3] * z, t

    def to_pose(self, joint_rate: Sequence[Value]) -> Values:
        q1, q2, q3, q4 = joint_rate
        ax, ay, bx, by = self.rows
        k = reciprocal(ax * by - ay * bx)
        return (by * q1 - ay * q2) * k, (ax * q2 - bx * q1) * k, (q4 - q3) / self.screw[3], q4


class FiveBarDynamics(Dynamics[FiveBar, FiveBarInertia]):
    """See the module; pose (x, y, z, phi), joints (q_1, q_2, q_3, q_4)."""

    def _bind(self) -> None:
        g, m = self.robot.geometry, self.inertia
        self._motor, self._l_p, self._l_d = 0.5 * g.l_f, g.l_p, g.l_d
        self._turn = math.tau / g.p
        rod = rigid_rod(m.distal_mass, m.distal_com, m.distal_inertia, g.l_d)
        arm = m.proximal_inertia + m.proximal_mass * (m.proximal_com * g.l_p) ** 2 + m.arm_drive
        self._half_arm, self._rod_b = 0.5 * (arm + rod.a * g.l_p**2), rod.b
        lifted = m.tool_mass + m.payload
        self._planar_mass, self._weight = lifted + 2.0 * rod.c, GRAVITY * lifted
        nut = m.nut_inertia + m.nut_drive
        self._screw = (lifted + nut * self._turn**2, -nut * self._turn, 2.0 * nut + m.tool_inertia, self._turn)

    def _terms(self, m: Functions, pose: Sequence[Value], rate: Sequence[Value]) -> FiveBarTerms:
        x, y, z, phi = pose
        vx, vy, vz, vphi = rate
        q1, qd1, h1, ax, ay, xx1, xy1, yy1, nx1, ny1 = self._leg(m, x + self._motor, y, vx, vy, 1.0)
        q2, qd2, h2, bx, by, xx2, xy2, yy2, nx2, ny2 = self._leg(m, x - self._motor, y, vx, vy, -1.0)
        turn, mass, weight = self._turn, self._planar_mass, self._weight
        terms = FiveBarTerms()
        terms.pose, terms.rate = (x, y, z, phi), (vx, vy, vz, vphi)
        terms.joints, terms.joint_rates = (q1, q2, phi - turn * z, phi), (qd1, qd2, vphi - turn * vz, vphi)
        terms.rows, terms.joint_bias = (ax, ay, bx, by), (h1, h2, 0.0, 0.0)
        terms.mass, terms.screw = (mass + xx1 + xx2, xy1 + xy2, mass + yy1 + yy2), self._screw
        terms.bias_force, terms.gravity_force = (nx1 + nx2, ny1 + ny2, weight, 0.0), (0.0, 0.0, weight, 0.0)
        return terms

    def _leg(self, m: Functions, dx: Value, y: Value, vx: Value, vy: Value, side: float) -> Values:
        """q, qd, h, j (2), M (xx, xy, yy without the rod's c) and n (2) of the leg whose motor is (dx, y) from P."""
        l_p, l_d, half_arm, rod_b = self._l_p, self._l_d, self._half_arm, self._rod_b
        r2 = dx * dx + y * y
        along = r2 + (l_p * l_p - l_d * l_d)
        across = side * m.sqrt(4.0 * l_p * l_p * r2 - along * along)
        k = 0.5 / r2
        ex, ey = (along * dx - across * y) * k, (along * y + across * dx) * k
        wx, wy = dx - ex, y - ey
        k = 1.0 / (wy * ex - wx * ey)
        jx, jy = wx * k, wy * k
        qd = jx * vx + jy * vy
        ux, uy, qd2 = vx + ey * qd, vy - ex * qd, qd * qd
        h = (ux * ux + uy * uy) * k + (jx * ex + jy * ey) * qd2
        bx, by = -rod_b * ey, rod_b * ex
        sx, sy = half_arm * jx + bx, half_arm * jy + by
        pull, swing = 2.0 * half_arm * h, rod_b * qd2
        xx, xy, yy = 2.0 * jx * sx, jx * sy + jy * sx, 2.0 * jy * sy
        nx, ny = pull * jx + bx * h - swing * ex, pull * jy + by * h - swing * ey
        return 0.5 * math.pi - m.atan2(ex, ey), qd, h, jx, jy, xx, xy, yy, nx, ny

    def _potential(self, m: Functions, terms: Terms) -> Value:
        return self._weight * terms.pose[2]

    def _pose_of(self, joints: Sequence[float], guess: Sequence[float]) -> tuple[float, ...]:
        """(E_1 + E_2) / 2 + sqrt(l_d^2 / |e|^2 - 1/4) perp(e), e = E_2 - E_1 (B1)"""
        q1, q2, q3, q4 = joints
        x1, y1 = self._l_p * math.cos(q1) - self._motor, self._l_p * math.sin(q1)
        x2, y2 = self._l_p * math.cos(q2) + self._motor, self._l_p * math.sin(q2)
        ex, ey = x2 - x1, y2 - y1
        side = math.sqrt(self._l_d * self._l_d / (ex * ex + ey * ey) - 0.25)
        return 0.5 * (x1 + x2) - side * ey, 0.5 * (y1 + y2) + side * ex, (q4 - q3) / self._turn, q4
