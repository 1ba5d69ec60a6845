"""One leg of a rotary delta as it is felt at its platform joint B: a driven arm and two parallel rods.

With A the elbow, A' = dA/dq, A'' = d2A/dq2, l = B - A and w = l . A'

    j = l / w,   qdd = j . Bdd + h,   h = (|Bdot - A' qd|^2 - l . A'' qd^2) / w
    force at B:  M Bdd + n,   M = j s^T + s j^T + 2c 1,   s = k/2 j + 2b A'
    n = (k h + tau_g) j + 2b (A' h + A'' qd^2) + (0, 0, 2 g_far)

where a, b, c is the form of one rod and k = I_arm + 2a L^2 the inertia about the motor. This is the joint part
tau = k qdd + 2b A' . Bdd + tau_g, carried to B by j, and the rods' own part (spec of the linear delta, A5).
"""

from __future__ import annotations

import math

from app.robots.dynamics.elementwise import Functions, Value, Values
from app.robots.dynamics.inertia import GRAVITY, RotaryInertia
from app.robots.dynamics.rods import rigid_rod


class RotaryLeg:
    """Arm L at one azimuth, rods of length l; the motor axis is the origin."""

    def __init__(self, inertia: RotaryInertia, azimuth: float, L: float, l: float) -> None:
        rod = rigid_rod(inertia.rod_mass, inertia.rod_com, inertia.rod_inertia, l)
        centre = inertia.arm_com * L
        arm = inertia.arm_inertia + inertia.arm_mass * centre * centre + inertia.rotor_inertia
        self._ca, self._sa = math.cos(azimuth), math.sin(azimuth)
        self._L, self._l2 = L, l * l
        self._half_arm, self._shared = 0.5 * (arm + 2.0 * rod.a * L * L), 2.0 * rod.b
        self.carried = 2.0 * rod.c
        """kg that move with B: 2c."""
        self.weight = 2.0 * GRAVITY * rod.far
        """N that hang on B."""
        self.moment = GRAVITY * (inertia.arm_mass * centre + 2.0 * rod.near * L)
        """N m that hang on the level arm: tau_g = -moment cos q."""

    def felt(self, m: Functions, ux: Value, uy: Value, uz: Value, vx: Value, vy: Value, vz: Value) -> Values:
        """q, qd, h, then j (3), M without its 2c (xx, xy, xz, yy, yz, zz), the Coriolis part of n (3) and tau_g.

        Args:
            ux, uy, uz: B, m.
            vx, vy, vz: its velocity, m/s.
        """
        ca, sa, L = self._ca, self._sa, self._L
        ur = ux * ca + uy * sa
        # E sin q + F cos q + G = 0 without its factor 2 L
        G = (ux * ux + uy * uy + uz * uz + L * L - self._l2) / (2.0 * L)
        r2 = ur * ur + uz * uz
        root, k = m.sqrt(r2 - G * G), 1.0 / r2
        cos, sin = (ur * G - uz * root) * k, -(uz * G + ur * root) * k
        ar, az, br, bz = -L * sin, -L * cos, -L * cos, L * sin
        k = 1.0 / ((ur + br) * ar + (uz + bz) * az)
        jx, jy, jz = (ux + br * ca) * k, (uy + br * sa) * k, (uz + bz) * k
        ax, ay, bx, by = ar * ca, ar * sa, br * ca, br * sa
        qd = jx * vx + jy * vy + jz * vz
        wx, wy, wz, qd2 = vx - ax * qd, vy - ay * qd, vz - az * qd, qd * qd
        h = (wx * wx + wy * wy + wz * wz) * k - (jx * bx + jy * by + jz * bz) * qd2
        shared, half_arm = self._shared, self._half_arm
        fx, fy, fz = shared * ax, shared * ay, shared * az
        sx, sy, sz = half_arm * jx + fx, half_arm * jy + fy, half_arm * jz + fz
        pull, swing = 2.0 * half_arm * h, shared * qd2
        xx, xy, xz = 2.0 * jx * sx, jx * sy + jy * sx, jx * sz + jz * sx
        yy, yz, zz = 2.0 * jy * sy, jy * sz + jz * sy, 2.0 * jz * sz
        nx, ny = pull * jx + h * fx + swing * bx, pull * jy + h * fy + swing * by
        nz, torque = pull * jz + h * fz + swing * bz, -self.moment * cos
        return m.atan2(sin, cos), qd, h, jx, jy, jz, xx, xy, xz, yy, yz, zz, nx, ny, nz, torque
