"""Rotations of rigid bodies as unit quaternions (w, x, y, z), in plain floats: one pose is placed at a time."""

from __future__ import annotations

import math

Quaternion = tuple[float, float, float, float]

IDENTITY: Quaternion = (1.0, 0.0, 0.0, 0.0)


def about_z(angle: float) -> Quaternion:
    """A turn about the vertical."""
    return (math.cos(0.5 * angle), 0.0, 0.0, math.sin(0.5 * angle))


def turned(azimuth: Quaternion, w: float, x: float, y: float, z: float) -> Quaternion:
    """A rotation (w, x, y, z) seen from a frame that is turned about z by `azimuth`."""
    c, s = azimuth[0], azimuth[3]
    return (c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w)
