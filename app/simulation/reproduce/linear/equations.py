"""The thesis' forward kinematics as its program must have had it: one sign decides Table 3."""

from __future__ import annotations

import math
from typing import NamedTuple

from app.robots.linear import LinearGeometry

Point = tuple[float, float, float]


class Reduced(NamedTuple):
    """Three spheres, boiled down: all points equally far from their centres lie on the line x = s_x z + t_x,
    y = s_y z + t_y, and those at the right distance have a z^2 + b z + c = 0. Metres."""

    s_x: float
    t_x: float
    s_y: float
    t_y: float
    a: float
    b: float
    c: float


def platform(d: tuple[float, float, float], geometry: LinearGeometry, slip: bool = False) -> Point:
    """Position (m) of carriages at d (m), by three spheres, the lower of both solutions. For `slip` see `reduced`."""
    s_x, t_x, s_y, t_y, a, b, c = reduced(d, geometry, slip)
    z = (-b - math.sqrt(b * b - 4.0 * a * c)) / (2.0 * a)
    return s_x * z + t_x, s_y * z + t_y, z


def reduced(d: tuple[float, float, float], geometry: LinearGeometry, slip: bool = False) -> Reduced:
    """Subtracting sphere 1 from 2 and 3 leaves the line; put into sphere 1 with centre q it leaves the quadratic with
    b = 2 (s_x (t_x - q_x) + s_y (t_y - q_y) - q_z). With `slip`, t_y has a minus there.
    """
    spheres = _centres(d, geometry)
    s_x, t_x, s_y, t_y = _line(spheres)
    q_x, q_y, q_z = spheres[0]
    a = s_x * s_x + s_y * s_y + 1.0
    b = 2.0 * (s_x * (t_x - q_x) + s_y * ((-t_y if slip else t_y) - q_y) - q_z)
    c = (t_x - q_x) ** 2 + (t_y - q_y) ** 2 + q_z * q_z - geometry.l**2
    return Reduced(s_x, t_x, s_y, t_y, a, b, c)


def _centres(d: tuple[float, float, float], g: LinearGeometry) -> tuple[Point, Point, Point]:
    """zeta_i = a_i - b_i, and the height of the carriage."""
    half, back, front = 0.5 * (g.S_A - g.s_p), g.W_A - g.w_p, g.U_A - g.u_b
    return (-half, -back, -d[0]), (half, -back, -d[1]), (0.0, front, -d[2])


def _line(spheres: tuple[Point, Point, Point]) -> tuple[float, float, float, float]:
    """s_x, t_x, s_y, t_y of the line on which all points equally far from the three centres lie."""
    x1, y1, z1 = spheres[0]
    rows = [(x - x1, y - y1, z - z1, 0.5 * (x * x + y * y + z * z - x1 * x1 - y1 * y1 - z1 * z1))
            for x, y, z in spheres[1:]]  # fmt: skip
    (a1, b1, c1, k1), (a2, b2, c2, k2) = rows
    det = a1 * b2 - a2 * b1
    return (
        (b1 * c2 - b2 * c1) / det,
        (k1 * b2 - k2 * b1) / det,
        (a2 * c1 - a1 * c2) / det,
        (a1 * k2 - a2 * k1) / det,
    )
