"""The driven arm of a rotary leg: the angle q that closes  E sin q + F cos q + G = 0.

With u the vector from the arm's motor to the platform joint, the elbow at L (cos q, -sin q) in the arm's
plane and the rod of length l:

    E = 2 L u_z,   F = -2 L u_r,   G = |u|^2 + L^2 - l^2

where u_r is the part of u along the arm's horizontal direction. The root with the elbow on the outside is
tan(q/2) = (G + F) / (sqrt(D) - E), D = E^2 + F^2 - G^2, the other one (sqrt(D) - E) / (G - F). The first is
never 0/0 while the platform hangs below the motors (E < 0); above them the same root is taken in the
form -(sqrt(D) + E) / (G - F).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def outer_angle(E: Array, F: Array, G: Array) -> Array:
    """Angle with the elbow on the outside, (-pi, pi]; NaN where the loop cannot close. Elementwise."""
    with np.errstate(invalid="ignore"):
        root = np.sqrt(E * E + F * F - G * G)
    if np.all(E <= 0.0):
        return 2.0 * np.arctan2(G + F, root - E)
    below = E <= 0.0
    return _wrapped(2.0 * np.arctan2(np.where(below, G + F, -(root + E)), np.where(below, root - E, G - F)))


def inner_angle(E: Array, F: Array, G: Array) -> Array:
    """Angle with the elbow folded in, (-pi, pi]; NaN where the loop cannot close. Elementwise."""
    with np.errstate(invalid="ignore"):
        root = np.sqrt(E * E + F * F - G * G)
    below = E <= 0.0
    return _wrapped(2.0 * np.arctan2(np.where(below, root - E, G + F), np.where(below, G - F, -(root + E))))


def outer_angle_scalar(E: float, F: float, G: float) -> float:
    """`outer_angle` on plain floats, for the drag path."""
    discriminant = E * E + F * F - G * G
    if not discriminant >= 0.0:
        return math.nan
    root = math.sqrt(discriminant)
    if E <= 0.0:
        return 2.0 * math.atan2(G + F, root - E)
    q = 2.0 * math.atan2(-(root + E), G - F)
    return q - math.copysign(math.tau, q) if abs(q) > math.pi else q


def _wrapped(q: Array) -> Array:
    return np.where(np.abs(q) > math.pi, q - np.copysign(math.tau, q), q)


def gap(E: float, F: float, G: float, rod: float) -> float:
    """How far the loop is from closing, in metres: positive when the leg is too short, negative when it is
    folded too tightly, 0 when it closes. The elbow-to-platform distance spans sqrt(l^2 + G -+ hypot(E, F))."""
    swing = math.hypot(E, F)
    if swing < G:
        return math.sqrt(rod * rod + G - swing) - rod
    if -swing > G:
        return math.sqrt(max(rod * rod + G + swing, 0.0)) - rod
    return 0.0
