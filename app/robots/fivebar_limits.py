"""The five-bar's limits in its plane, as `nearest` needs them: defined everywhere and smooth.

Each leg is linearised at P or, where its loop is open or nearly so, at the closest point of the ring in which
it is far enough from being stretched or folded; beyond the ring its angles go on along their tangents.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from app.robots.fivebar_linkage import OUTWARD, Linkage
from app.robots.nearest import Boundary

Vector = tuple[float, float]


class Leg(NamedTuple):
    """One leg around P."""

    radius: float
    """Distance of P from the motor."""
    outward: Vector
    """Unit vector from the motor to P."""
    q: float
    """Arm angle."""
    q_gradient: Vector
    psi: float
    """Rod angle."""
    psi_gradient: Vector


def planar_limits(
    linkage: Linkage, arm_limits: Sequence[tuple[float, float]], sigma: float, x: float, y: float
) -> list[Boundary]:
    """Limits of both arm angles, and of the three angles that must stay `sigma` away from a singularity."""
    ring = ring_radii(linkage, sigma)
    legs = [_linearised(linkage, leg, ring, x, y) for leg in (0, 1)]
    limits = _between_the_rods(legs[0], legs[1], sigma, 1.0 / linkage.l_d)
    for leg, side, (low, high) in zip(legs, OUTWARD, arm_limits, strict=True):
        # P stays inside the circle about the elbow of the innermost arm and outside that of the outermost.
        bend = side / linkage.l_d
        limits += [
            _boundary(leg.q - low, leg.q_gradient, 1.0, bend),
            _boundary(high - leg.q, leg.q_gradient, -1.0, -bend),
            _boundary(leg.radius - ring[0], leg.outward, 1.0, -1.0 / ring[0]),
            _boundary(ring[1] - leg.radius, leg.outward, -1.0, 1.0 / ring[1]),
        ]
    return limits


def ring_radii(linkage: Linkage, sigma: float) -> tuple[float, float]:
    """Distances of P from a motor with arm and rod at the angle `sigma` from folded and from stretched."""
    squares, product = linkage.l_p**2 + linkage.l_d**2, 2.0 * linkage.l_p * linkage.l_d * math.cos(sigma)
    return math.sqrt(squares - product), math.sqrt(squares + product)


def _linearised(linkage: Linkage, leg: int, ring: tuple[float, float], x: float, y: float) -> Leg:
    """grad q = w / (l_p w . e'),  grad psi = (perp w - (w . e / w . e') w) / l_d^2."""
    motor, l_p = linkage.motors[leg], linkage.l_p
    radius = math.hypot(x - motor, y)
    out_x, out_y = ((x - motor) / radius, y / radius) if radius > 0.0 else (0.0, 1.0)
    near = min(max(radius, ring[0]), ring[1])
    beyond = radius - near
    q = linkage.arm_angle(leg, motor + near * out_x, near * out_y)
    e_x, e_y = math.cos(q), math.sin(q)
    w_x, w_y = near * out_x - l_p * e_x, near * out_y - l_p * e_y
    swing = w_y * e_x - w_x * e_y
    slope = (w_x * e_x + w_y * e_y) / swing
    q_x, q_y = w_x / (l_p * swing), w_y / (l_p * swing)
    psi_x, psi_y = (-w_y - slope * w_x) / linkage.l_d**2, (w_x - slope * w_y) / linkage.l_d**2
    q += beyond * (q_x * out_x + q_y * out_y)
    psi = math.atan2(w_y, w_x) + beyond * (psi_x * out_x + psi_y * out_y)
    return Leg(radius, (out_x, out_y), q, (q_x, q_y), psi, (psi_x, psi_y))


def _between_the_rods(first: Leg, second: Leg, sigma: float, bend: float) -> list[Boundary]:
    """The angle from rod 1 to rod 2 lies between sigma and pi - sigma. It is measured from their middle, so
    that it jumps only where the rods cross at right angles on the wrong side."""
    middle = math.remainder(second.psi - first.psi - 0.5 * math.pi, math.tau)
    gradient = (
        second.psi_gradient[0] - first.psi_gradient[0],
        second.psi_gradient[1] - first.psi_gradient[1],
    )
    if math.hypot(*gradient) < 0.1 * bend:
        return []
    room = 0.5 * math.pi - sigma
    return [
        _boundary(room - middle, gradient, -1.0, -bend),
        _boundary(room + middle, gradient, 1.0, 0.0),
    ]


def _boundary(value: float, gradient: Vector, sign: float, curvature: float) -> Boundary:
    """A limit with a gradient of length 1, so that its value is in metres."""
    steep = math.hypot(*gradient)
    direction = (sign * gradient[0] / steep, sign * gradient[1] / steep, 0.0)
    return Boundary(value / steep, direction, curvature)
