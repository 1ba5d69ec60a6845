"""The planar five-bar: two driven arms whose rods meet in one point P = (x, y). No limits, no screw.

E_k = A_k + l_p e_k are the elbows, e_k = (cos q_k, sin q_k) the arms, w_k = P - E_k the rods, and e'_k is e_k
turned by 90 degrees. Everything works on floats and, elementwise, on arrays.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.robots.robot import Array

OUTWARD = (1.0, -1.0)
"""The way each arm turns away from the line motor to P with its elbow out: +1 is counter-clockwise."""


@dataclass(frozen=True)
class Linkage:
    """Motors at (-+l_f / 2, 0), arms l_p, rods l_d."""

    motors: tuple[float, float]
    l_p: float
    l_d: float

    def arm_direction(self, leg: int, x: Any, y: Any, side: float, sqrt: Callable[[Any], Any]) -> tuple[Any, Any]:
        """Where an arm points: to P, turned to one side by acos((r^2 + l_p^2 - l_d^2) / (2 l_p r)). Of any
        length, so that it is never 0/0; NaN where the loop cannot close."""
        dx = x - self.motors[leg]
        r2 = dx * dx + y * y
        c = r2 + (self.l_p * self.l_p - self.l_d * self.l_d)
        s = side * sqrt(4.0 * self.l_p * self.l_p * r2 - c * c)
        return c * dx - s * y, c * y + s * dx

    def arm_angles(self, x: Array, y: Array, sides: Sequence[float] = OUTWARD) -> list[Array]:
        """q_1 and q_2, (...,) each, in [-90, 270) degrees: they jump only where an arm points to -y."""
        with np.errstate(invalid="ignore"):
            arms = [self.arm_direction(leg, x, y, side, np.sqrt) for leg, side in enumerate(sides)]
        return [0.5 * math.pi - np.arctan2(*arm) for arm in arms]

    def arm_angle(self, leg: int, x: float, y: float) -> float:
        """`arm_angles` of one leg in plain floats."""
        return 0.5 * math.pi - math.atan2(*self.arm_direction(leg, x, y, OUTWARD[leg], _real_sqrt))

    def elbows(self, q: Array) -> Array:
        """(..., 2, 2) E_k of arm angles (..., 2)."""
        arms = np.stack([np.cos(q), np.sin(q)], axis=-1)
        return np.column_stack([self.motors, np.zeros(2)]) + self.l_p * arms

    def distance(self, leg: int, x: float, y: float) -> float:
        """Of P from a motor."""
        return math.hypot(x - self.motors[leg], y)

    def gap(self, leg: int, x: float, y: float) -> float:
        """How far the loop is from closing: positive when the leg is too short, negative when it is folded
        too tightly, 0 when it closes."""
        r = self.distance(leg, x, y)
        return max(r - self.l_p - self.l_d, 0.0) + min(r - abs(self.l_p - self.l_d), 0.0)

    def tool(self, q: Array, side: float) -> Array:
        """(..., 2) P of arm angles (..., 2), on the left (+1) or right (-1) of the line from E_1 to E_2; NaN
        where the rods cannot meet or could turn freely about a common elbow.

        p = (E_1 + E_2) / 2 +- sqrt(l_d^2 / |e|^2 - 1/4) perp(e) with e = E_2 - E_1
        """
        elbows = self.elbows(q)
        e = elbows[..., 1, :] - elbows[..., 0, :]
        gap = (e * e).sum(-1, keepdims=True)
        with np.errstate(invalid="ignore", divide="ignore"):
            height = side * np.sqrt(np.where(gap > 0.0, self.l_d**2 / gap - 0.25, np.nan))
        return elbows.mean(axis=-2) + height * np.stack([-e[..., 1], e[..., 0]], axis=-1)

    def rates(self, x: Array, y: Array, q: Array) -> Array:
        """(..., 2, 2) inverse of D_5R: w_k . pdot = l_p (w_k . e'_k) qdot_k."""
        w = np.stack([x, y], axis=-1)[..., None, :] - self.elbows(q)
        swing = self.l_p * (w[..., 1] * np.cos(q) - w[..., 0] * np.sin(q))
        with np.errstate(invalid="ignore", divide="ignore"):
            return w / swing[..., None]

    def sines(self, m: Any, x: Any, y: Any, q1: Any, q2: Any) -> tuple[Any, Any, Any]:
        """Of the angles between arm and rod of legs 1 and 2 and between the two rods, positive where the
        elbows are out and P is on the left. `m` is `math` or `numpy`."""
        c1, s1, c2, s2 = m.cos(q1), m.sin(q1), m.cos(q2), m.sin(q2)
        x1, y1 = x - self.motors[0] - self.l_p * c1, y - self.l_p * s1
        x2, y2 = x - self.motors[1] - self.l_p * c2, y - self.l_p * s2
        l_d = self.l_d
        return (x1 * s1 - y1 * c1) / l_d, (y2 * c2 - x2 * s2) / l_d, (x1 * y2 - y1 * x2) / (l_d * l_d)


def _real_sqrt(value: float) -> float:
    return math.sqrt(value) if value >= 0.0 else math.nan
