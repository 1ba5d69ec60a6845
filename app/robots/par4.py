"""Par4: four rotary arms and an articulated platform, x, y, z and a rotation theta (Laski & Smykowski 2021).

The platform is a parallelogram: legs 3 and 4 carry the bar whose middle is the tool point D = (x, y, z), legs
1 and 2 carry the opposite bar, h away; theta is the angle of the links between them. A 1:2 belt turns the tool
by 2 theta. Equation numbers are the paper's; the printed (18) has a sign error in F_3 (its term in d_3 must
read + 2 L d_3 cos a_3), and the joints on the platform lie P_z = +64.5 mm above D.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.robots import par4_assembly
from app.robots.geometry import Geometry, angle, length
from app.robots.par4_platform import Par4Platform
from app.robots.reach import Reach
from app.robots.robot import LIMIT_TOLERANCE, Array, Assembly, condition_number
from app.robots.rotary_delta import RotaryDelta

ARM_AZIMUTHS = tuple(math.radians(a) for a in (45.0, 135.0, 225.0, 315.0))


@dataclass(frozen=True, kw_only=True)
class Par4Geometry(Geometry):
    """Dimensions of Table 1 (its labels of L and l are swapped in print)."""

    R: float = length(0.185, "Base radius", 0.08, 0.40)
    """Radius of the circle on which the motor axes lie (R)."""
    L: float = length(0.200, "Arm length", 0.10, 0.40)
    """Driven arm, motor axis to elbow (L)."""
    l: float = length(0.386, "Rod length", 0.20, 0.80)
    """Rods, elbow to platform joint (l)."""
    h: float = length(0.072, "Platform link", 0.03, 0.15)
    """Distance between the two bars of the platform, the links that turn by theta (h)."""
    d: float = length(0.102, "Platform bar", 0.04, 0.20)
    """Length of the bars between the links (d)."""
    d_i: float = length(0.009, "Joint offset along the bar", 0.0, 0.06, essential=False)
    """Rod joint beyond the end of its bar, along the bar (d_1..d_4)."""
    h_i: float = length(0.024, "Joint offset across the bar", 0.0, 0.08, essential=False)
    """Rod joint outside of its bar, across the bar (h_1..h_4)."""
    B_z: float = length(0.0, "Motor height", -0.20, 0.20, essential=False)
    """Height of the motor axes above the base frame (B_iz)."""
    P_z: float = length(0.0645, "Joint height", -0.10, 0.20, essential=False)
    """Height of the platform joints above the tool point D (P_iz)."""
    q_min: float = angle(-math.pi / 4, "Lowest arm angle", -math.pi / 2, 0.0)
    """Arm limit above the horizontal (negative)."""
    q_max: float = angle(math.pi / 4, "Highest arm angle", 0.0, math.pi / 2)
    """Arm limit below the horizontal."""
    theta_max: float = angle(math.pi / 4, "Largest platform angle", 0.1, math.pi / 3)
    """Limit of theta to either side."""


class Par4(RotaryDelta):
    """See the module; poses (x, y, z, theta), joints q_1..q_4, positive below the horizontal."""

    name = "par4"
    title = "Par4 delta"
    pose_names = ("x", "y", "z", "theta")
    joint_names = ("q1", "q2", "q3", "q4")
    geometry: Par4Geometry
    _azimuths = ARM_AZIMUTHS

    def _bind(self) -> None:
        g = self.geometry
        super()._bind()
        self._R, self._L, self._l, self._B_z = g.R, g.L, g.l, g.B_z
        self._limits = ((g.q_min, g.q_max),) * 4
        along = g.d / 2 + g.d_i
        self.platform = Par4Platform(
            along=(along, -along, -along, along),
            across=(g.h_i, g.h_i, -g.h_i, -g.h_i),
            links=(g.h, g.h, 0.0, 0.0),
            height=g.P_z,
            theta_max=g.theta_max,
        )

    @property
    def rotation_limit(self) -> float:
        return self.geometry.theta_max

    def _default_home(self) -> tuple[float, ...]:
        return (0.0, -self.geometry.h / 2, -0.3, 0.0)

    def _leg_vectors(self, m: Any, *pose: Any) -> Sequence[tuple[Any, Any, Any]]:
        """u_i = P + DP_i - B_i; (1)-(15). The links of legs 1 and 2 turn by theta, the bars never turn."""
        x, y, z, theta = pose
        s, c = m.sin(theta), m.cos(theta)
        u_z = z + (self.geometry.P_z - self._B_z)
        platform = self.platform
        legs = zip(platform.along, platform.across, platform.links, self._arms, strict=True)
        return [
            (x - link * s + (along - self._R * ca), y + link * c + (across - self._R * sa), u_z)
            for along, across, link, (ca, sa) in legs
        ]

    def _platform_joints(self, pose: Array) -> Array:
        return self.platform.joints(pose)

    def jacobian(self, pose: ArrayLike) -> Array:
        """J = Jq^-1 Jx with rows Jx_i = [l_i, l_i . dP_i/dtheta] and Jq_i = l_i . dA_i/dq_i."""
        poses = np.asarray(pose, dtype=float)
        rods, swing = self._rods_and_swing(poses)
        return self.platform.loop_rows(rods, poses[..., 3]) / swing[..., None]

    def conditioning(self, pose: ArrayLike) -> Array:
        """Condition number of L dq -> (dx, dy, dz, h dtheta)."""
        return condition_number(self.jacobian(pose) / np.array([1.0, 1.0, 1.0, self.geometry.h]))

    def forward(self, joints: ArrayLike) -> Array:
        """Newton's method on |P_i - A_i|^2 = l^2 from the home pose; see `par4_assembly`."""
        elbows = self._elbows(self._columns(joints, 4))
        return par4_assembly.newton(self.platform, elbows, self._l, self.home).reshape(np.shape(joints))

    def assemblies(self, joints: ArrayLike) -> list[Assembly]:
        return par4_assembly.every_mode(self.platform, self._elbows(np.asarray(joints, dtype=float)), self._l)

    def _admissible(self, pose: Array, joints: Array) -> NDArray[np.bool_]:
        return np.abs(pose[..., 3]) <= self.geometry.theta_max + LIMIT_TOLERANCE

    def _pose_limit(self, pose: list[float], joints: tuple[float, ...]) -> Reach | None:
        limit = self.geometry.theta_max
        if abs(pose[3]) <= limit + LIMIT_TOLERANCE:
            return None
        reason = f"The platform turns at most {math.degrees(limit):.0f} degrees to either side."
        return Reach(False, reason, None, joints)
