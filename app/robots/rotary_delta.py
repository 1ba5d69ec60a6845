"""What the robots with rotary arms share: the angle of each arm, its rods, its limits.

A subclass says where the platform joints are; everything else follows from u_i, the vector from the motor
axis of leg i to its platform joint.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from app.robots.nearest import Boundary
from app.robots.reach import Reach
from app.robots.robot import Array, Robot, Skeleton
from app.robots.rotary_arm import gap, inner_angle, outer_angle, outer_angle_scalar


class RotaryDelta(Robot):
    """Arms of length `_L` on a circle of radius `_R`, rods of length `_l`, one arm at each azimuth."""

    joint_unit = "rad"

    _R: float
    _L: float
    _l: float
    _B_z: float
    _azimuths: tuple[float, ...]

    @abstractmethod
    def _leg_vectors(self, m: Any, *pose: Any) -> Sequence[tuple[Any, Any, Any]]:
        """u_i of each leg. Elementwise: `m` is `math` for floats and `numpy` for arrays."""

    @abstractmethod
    def _platform_joints(self, pose: Array) -> Array:
        """(..., legs, 3) rod joints on the platform."""

    def _bind(self) -> None:
        self._arms = tuple((math.cos(a), math.sin(a)) for a in self._azimuths)

    @property
    def arm_m(self) -> float:
        """Length of the upper arms."""
        return self._L

    @property
    def rod_m(self) -> float:
        """Length of the rods."""
        return self._l

    def leg_equations(self, m: Any, *pose: Any) -> list[tuple[Any, Any, Any]]:
        """E, F, G of each leg in  E sin q + F cos q + G = 0, m^2. Elementwise: `m` is `math` or `numpy`."""
        L = self._L
        constant = L * L - self._l * self._l
        return [
            (2 * L * u_z, -2 * L * (u_x * ca + u_y * sa), u_x * u_x + u_y * u_y + u_z * u_z + constant)
            for (u_x, u_y, u_z), (ca, sa) in zip(self._leg_vectors(m, *pose), self._arms, strict=True)
        ]

    def _inverse_columns(self, *pose: Array) -> Sequence[Array]:
        return [outer_angle(*leg) for leg in self.leg_equations(np, *pose)]

    def solve(self, *pose: float) -> tuple[float, ...]:
        return tuple([outer_angle_scalar(*leg) for leg in self.leg_equations(math, *pose)])

    def working_modes(self, pose: ArrayLike) -> Array:
        legs = [np.array(leg) for leg in self.leg_equations(np, *np.asarray(pose, dtype=float))]
        modes = np.array([[float(angle(*leg)) for leg in legs] for angle in (outer_angle, inner_angle)])
        return modes[~np.isnan(modes).any(axis=-1)]

    def skeleton(self, pose: Sequence[float], joints: Sequence[float]) -> Skeleton:
        arms = np.array(self._arms)
        base = np.column_stack([self._R * arms, np.full(len(arms), self._B_z)])
        tangents = np.column_stack([-arms[:, 1], arms[:, 0], np.zeros(len(arms))])
        platform = self._platform_joints(np.asarray(pose, dtype=float))
        return Skeleton(base, self._elbows(np.asarray(joints, dtype=float)), platform, tangents)

    def _elbows(self, joints: Array) -> Array:
        """(..., legs, 3) ends A_i of the arms."""
        q = joints[..., None]
        radius = self._R + self._L * np.cos(q)
        return np.concatenate([radius * np.array(self._arms), self._B_z - self._L * np.sin(q)], axis=-1)

    def _rods_and_swing(self, pose: Array) -> tuple[Array, Array]:
        """Rod vectors l_i (..., legs, 3) and l_i . dA_i/dq_i (..., legs)."""
        joints = self.inverse(pose)
        rods = self._platform_joints(pose) - self._elbows(joints)
        q = joints[..., None]
        turn = self._L * np.concatenate([-np.sin(q) * np.array(self._arms), -np.cos(q)], axis=-1)
        return rods, (rods * turn).sum(-1)

    def _open_loop(self, pose: list[float], joints: tuple[float, ...]) -> Reach:
        gaps = [gap(*leg, self._l) for leg in self.leg_equations(math, *pose)]
        leg = max(range(len(gaps)), key=lambda i: abs(gaps[i]))
        size = f"{abs(gaps[leg]) * 1e3:.0f}" if abs(gaps[leg]) >= 5e-4 else "less than 1"
        if gaps[leg] > 0.0:
            return Reach(False, f"Out of reach: leg {leg + 1} is {size} mm too short.", leg + 1)
        return Reach(False, f"Too close: leg {leg + 1} is {size} mm too long.", leg + 1)

    def _limit_reason(self, joint: int, value: float) -> str:
        low, high = self._limits[joint]
        return f"Leg {joint + 1}: upper arm at {math.degrees(high if value > high else low):+.0f} degrees."

    def _pose_limit(self, pose: list[float], joints: tuple[float, ...]) -> Reach | None:
        return None

    def _boundaries(self, pose: list[float]) -> list[Boundary]:
        """q_i <= q_max: the platform joint lies within l of the elbow at q_max; q_i >= q_min: beyond l of the
        elbow at q_min. Both together imply that the loop closes."""
        limits = []
        legs = zip(self._leg_vectors(math, *pose), self._arms, self._limits, strict=True)
        for (u_x, u_y, u_z), (ca, sa), (low, high) in legs:
            for q, k in ((high, 1.0 / self._l), (low, -1.0 / self._l)):
                reach = self._L * math.cos(q)
                v_x, v_y, v_z = u_x - reach * ca, u_y - reach * sa, u_z + self._L * math.sin(q)
                value = 0.5 * k * (self._l**2 - v_x * v_x - v_y * v_y - v_z * v_z)
                limits.append(Boundary(value, (-k * v_x, -k * v_y, -k * v_z), k))
        return limits
