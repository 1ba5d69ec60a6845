"""Dynamics of the Par4: four legs and an articulated platform.

D = (x, y, z) is the bar of legs 3 and 4, W = D + h (-sin theta, cos theta, 0) that of legs 1 and 2. With
t = dW/dtheta and b = d2W/dtheta2 thetad^2, legs 1 and 2, felt at W with M and n, add  M, M t and t . M t  to the
mass matrix and  n + M b  and  t . (n + M b)  to the bias. Two links turn by theta, the tool by 2 theta:

    T = 1/2 (m |Ddot|^2 + 2 s Ddot . Wdot_D + I thetad^2),   Wdot_D = t thetad
    s = m_bar + 2 eta m_link,   I = (m_bar + 2 eta^2 m_link) h^2 + 2 I_link + 4 I_tool
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.dynamics.dynamics import Dynamics
from app.robots.dynamics.elementwise import Functions, Value
from app.robots.dynamics.inertia import GRAVITY, Par4Inertia
from app.robots.dynamics.par4_terms import Par4Terms
from app.robots.dynamics.rotary_leg import RotaryLeg
from app.robots.dynamics.terms import Terms
from app.robots.par4 import ARM_AZIMUTHS, Par4

NEWTON_STEPS = 20
NEARLY = 1e-8
"""A miss this small (as a share of l^2) is gone after the step that follows it: Newton's method squares it."""


class Par4Dynamics(Dynamics[Par4, Par4Inertia]):
    """See the module and `rotary_leg`; pose (x, y, z, theta), joints q_1 to q_4."""

    def _bind(self) -> None:
        g, m, platform = self.robot.geometry, self.inertia, self.robot.platform
        self._L, self._l, self._h = g.L, g.l, g.h
        self._rise = g.P_z - g.B_z
        self._arms = [(math.cos(a), math.sin(a)) for a in ARM_AZIMUTHS]
        self._legs = [RotaryLeg(m, a, g.L, g.l) for a in ARM_AZIMUTHS]
        places = zip(platform.along, platform.across, self._arms, strict=True)
        self._shift = [(along - g.R * ca, across - g.R * sa) for along, across, (ca, sa) in places]
        pair = 2.0 * self._legs[0].carried
        lifted = 2.0 * (m.bar_mass + m.link_mass) + m.tool_mass + m.payload
        self._mass = lifted + 2.0 * pair
        self._far = m.bar_mass + 2.0 * m.link_com * m.link_mass + pair
        far = m.bar_mass + 2.0 * m.link_com**2 * m.link_mass + pair
        self._spin = far * g.h * g.h + 2.0 * m.link_inertia + 4.0 * m.tool_inertia
        self._weight = GRAVITY * lifted + sum(leg.weight for leg in self._legs)

    def _terms(self, m: Functions, pose: Sequence[Value], rate: Sequence[Value]) -> Par4Terms:
        x, y, z, theta = pose
        vx, vy, vz, vt = rate
        tx, ty = -self._h * m.cos(theta), -self._h * m.sin(theta)
        px, py, pz = x + ty, y - tx, z + self._rise  # W = D + (t_y, -t_x)
        wx, wy = vx + tx * vt, vy + ty * vt
        bx, by = -ty * vt * vt, tx * vt * vt
        (s1x, s1y), (s2x, s2y), (s3x, s3y), (s4x, s4y) = self._shift
        leg1, leg2, leg3, leg4 = self._legs
        q1, w1, h1, ax, ay, az, *M1 = leg1.felt(m, px + s1x, py + s1y, pz, wx, wy, vz)
        q2, w2, h2, cx, cy, cz, *M2 = leg2.felt(m, px + s2x, py + s2y, pz, wx, wy, vz)
        q3, w3, h3, dx, dy, dz, *M3 = leg3.felt(m, x + s3x, y + s3y, pz, vx, vy, vz)
        q4, w4, h4, ex, ey, ez, *M4 = leg4.felt(m, x + s4x, y + s4y, pz, vx, vy, vz)
        g1, g2, g3, g4 = M1[-1], M2[-1], M3[-1], M4[-1]
        # the bar of legs 1 and 2: everything felt at W
        xx, xy, xz, yy, yz, zz, nx, ny, nz, _ = [a + b for a, b in zip(M1, M2, strict=True)]
        nx, ny, nz = nx + xx * bx + xy * by, ny + xy * bx + yy * by, nz + xz * bx + yz * by
        xt, yt, zt = xx * tx + xy * ty, xy * tx + yy * ty, xz * tx + yz * ty
        tt, nt = tx * xt + ty * yt, tx * nx + ty * ny
        Xx, Xy, Xz, Yy, Yz, Zz, Nx, Ny, Nz, _ = [a + b for a, b in zip(M3, M4, strict=True)]
        mass, far = self._mass, self._far
        r1, r2 = ax * tx + ay * ty, cx * tx + cy * ty
        gx, gy = ax * g1 + cx * g2 + dx * g3 + ex * g4, ay * g1 + cy * g2 + dy * g3 + ey * g4
        gz, gt = az * g1 + cz * g2 + dz * g3 + ez * g4 + self._weight, r1 * g1 + r2 * g2
        terms = Par4Terms()
        terms.pose, terms.rate = (x, y, z, theta), (vx, vy, vz, vt)
        terms.joints, terms.joint_rates = (q1, q2, q3, q4), (w1, w2, w3, w4)
        terms.rows, terms.turns = (ax, ay, az, cx, cy, cz, dx, dy, dz, ex, ey, ez), (r1, r2)
        terms.joint_bias = (h1 + ax * bx + ay * by, h2 + cx * bx + cy * by, h3, h4)
        xx, yy, zz = mass + xx + Xx, mass + yy + Yy, mass + zz + Zz
        xt, yt, tt = far * tx + xt, far * ty + yt, self._spin + tt
        terms.mass = (xx, xy + Xy, xz + Xz, xt, yy, yz + Yz, yt, zz, zt, tt)
        terms.gravity_force = (gx, gy, gz, gt)
        terms.bias_force = (nx + Nx + far * bx + gx, ny + Ny + far * by + gy, nz + Nz + gz, nt + gt)
        return terms

    def _potential(self, m: Functions, terms: Terms) -> Value:
        arms = sum(leg.moment * m.sin(q) for leg, q in zip(self._legs, terms.joints, strict=True))
        return self._weight * terms.pose[2] - arms

    def _pose_of(self, joints: Sequence[float], guess: Sequence[float]) -> tuple[float, ...]:
        """Newton's method on |B_i - A_i|^2 = l^2 from the guess: the rows of J, each times l_i . A'_i."""
        x, y, z, theta = guess
        elbows = [(self._L * math.cos(q), -self._L * math.sin(q)) for q in joints]
        for _ in range(NEWTON_STEPS):
            terms, misses = self._loops(elbows, x, y, z, theta)
            dx, dy, dz, turn = terms.to_pose(misses)
            x, y, z, theta = x + dx, y + dy, z + dz, theta + turn
            if max(map(abs, misses)) < NEARLY * self._l * self._l:
                return x, y, z, theta
        raise ValueError("The platform cannot be assembled.")

    def _loops(
        self, elbows: Sequence[tuple[float, float]], x: float, y: float, z: float, theta: float
    ) -> tuple[Par4Terms, list[float]]:
        """Rod vectors as rows of J, and by how much half their squares miss l^2 / 2."""
        tx, ty = -self._h * math.cos(theta), -self._h * math.sin(theta)
        bars = ((x + ty, y - tx), (x + ty, y - tx), (x, y), (x, y))
        rods = [
            (bx + sx - reach * ca, by + sy - reach * sa, z + self._rise - lift)
            for (bx, by), (sx, sy), (reach, lift), (ca, sa) in zip(bars, self._shift, elbows, self._arms, strict=True)
        ]
        terms = Par4Terms()
        terms.rows = tuple([value for rod in rods for value in rod])
        terms.turns = (rods[0][0] * tx + rods[0][1] * ty, rods[1][0] * tx + rods[1][1] * ty)
        l2 = self._l * self._l
        return terms, [0.5 * (l2 - u * u - v * v - w * w) for u, v, w in rods]
