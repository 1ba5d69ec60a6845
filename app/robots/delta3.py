"""delta3: the rotary delta that draws, three arms and a platform that only translates (Rivas et al. 2015).

Arm 1 points along -y, arms 2 and 3 follow at +120 and +240 degrees. The paper gives the triangles' sides f
(base) and e (platform) and prints (1)-(10) with several sign errors; these are the corrected formulas in the
form shared with the Par4. Angles are positive below the horizontal.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.robots.geometry import Geometry, angle, length
from app.robots.robot import Array, Assembly, condition_number
from app.robots.rotary_delta import RotaryDelta
from app.robots.spheres import intersect_three_spheres

ARM_AZIMUTHS = tuple(math.radians(a) for a in (270.0, 30.0, 150.0))


@dataclass(frozen=True, kw_only=True)
class Delta3Geometry(Geometry):
    """Dimensions `desk_A4`: draws an A4 sheet in both orientations. The paper prints none."""

    f: float = length(0.360, "Base triangle side", 0.10, 0.80)
    """Side of the base triangle whose edges carry the motors (f)."""
    e: float = length(0.120, "Platform triangle side", 0.03, 0.40)
    """Side of the platform triangle (e)."""
    rf: float = length(0.160, "Arm length", 0.05, 0.40)
    """Driven arm, motor axis to elbow (r_f)."""
    re: float = length(0.380, "Rod length", 0.10, 0.80)
    """Rods, elbow to platform joint (r_e)."""
    q_min: float = angle(-math.pi / 4, "Lowest arm angle", -math.pi / 2, 0.0)
    """Arm limit above the horizontal (negative)."""
    q_max: float = angle(math.pi / 2, "Highest arm angle", 0.0, math.pi / 2)
    """Arm limit below the horizontal."""


PRESETS = {
    "desk_A4": {},
    "classic": {"e": 0.115, "f": 0.4573, "re": 0.232, "rf": 0.112, "q_min": math.radians(-35.0)},
}
"""`classic` is the geometry of most published examples; below -35 degrees one of its arms crosses the fold."""


class Delta3(RotaryDelta):
    """See the module; poses (x, y, z), joints theta_1..theta_3, positive below the horizontal."""

    name = "delta3"
    title = "Drawing delta"
    pose_names = ("x", "y", "z")
    joint_names = ("q1", "q2", "q3")
    geometry: Delta3Geometry
    _azimuths = ARM_AZIMUTHS
    _B_z = 0.0

    def _bind(self) -> None:
        g = self.geometry
        super()._bind()
        self._R, self._L, self._l = g.f / (2 * math.sqrt(3)), g.rf, g.re
        self._platform_radius = g.e / (2 * math.sqrt(3))
        self._limits = ((g.q_min, g.q_max),) * 3

    def _default_home(self) -> tuple[float, ...]:
        return (0.0, 0.0, -0.330)

    def _leg_vectors(self, m: Any, *pose: Any) -> Sequence[tuple[Any, Any, Any]]:
        x, y, z = pose
        inward = self._platform_radius - self._R
        return [(x + inward * ca, y + inward * sa, z) for ca, sa in self._arms]

    def _platform_joints(self, pose: Array) -> Array:
        arms = np.column_stack([np.array(self._arms), np.zeros(3)])
        return pose[..., None, :] + self._platform_radius * arms

    def jacobian(self, pose: ArrayLike) -> Array:
        """Rows l_i / (l_i . dA_i/dq_i)."""
        rods, swing = self._rods_and_swing(np.asarray(pose, dtype=float))
        return rods / swing[..., None]

    def conditioning(self, pose: ArrayLike) -> Array:
        """Condition number of r_f dq -> (dx, dy, dz)."""
        return condition_number(self.jacobian(pose))

    def forward(self, joints: ArrayLike) -> Array:
        """Lower intersection of the three spheres of rod ends."""
        return intersect_three_spheres(self._rod_spheres(joints), self._l, upper=False)

    def assemblies(self, joints: ArrayLike) -> list[Assembly]:
        centres = self._rod_spheres(np.asarray(joints, dtype=float))
        poses = [intersect_three_spheres(centres, self._l, upper=upper) for upper in (False, True)]
        return [Assembly(pose, valid) for pose, valid in zip(poses, (True, False), strict=True) if pose[0] == pose[0]]

    def _rod_spheres(self, joints: ArrayLike) -> Array:
        """(..., 3, 3) spheres of radius r_e about these centres pass through the tool point."""
        q = np.asarray(joints, dtype=float)
        self._columns(q, 3)
        arms = np.column_stack([np.array(self._arms), np.zeros(3)])
        return self._elbows(q) - self._platform_radius * arms

    def _admissible(self, pose: Array, joints: Array) -> NDArray[np.bool_]:
        return np.ones(pose.shape[:-1], dtype=bool)
