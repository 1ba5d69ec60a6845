"""Positions and rotations of rigid bodies, in plain floats of full precision: loops must close to the last digit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from app.robots.parts.quaternions import IDENTITY, Quaternion

Vector = tuple[float, float, float]
ORIGIN: Vector = (0.0, 0.0, 0.0)


class Frame(NamedTuple):
    """Where something is, seen from the world or from another frame."""

    position: Vector = ORIGIN
    """metres"""
    wxyz: Quaternion = IDENTITY

    def seen_from(self, other: Frame) -> Frame:
        """This frame in coordinates of another one, both given in the same."""
        back = conjugate(other.wxyz)
        offset = minus(self.position, other.position)
        return Frame(rotated(back, offset), product(back, self.wxyz))

    def inside(self, other: Frame) -> Frame:
        """The frame that is this one in coordinates of `other`: undoes `seen_from`."""
        return Frame(other.point(self.position), product(other.wxyz, self.wxyz))

    def point(self, local: Sequence[float]) -> Vector:
        """A point of this frame (3,) in the coordinates in which the frame is given."""
        x, y, z = rotated(self.wxyz, local)
        return self.position[0] + x, self.position[1] + y, self.position[2] + z


def minus(a: Sequence[float], b: Sequence[float]) -> Vector:
    """The difference of two points."""
    return float(a[0] - b[0]), float(a[1] - b[1]), float(a[2] - b[2])


def product(a: Quaternion, b: Quaternion) -> Quaternion:
    """First the turn b, then a."""
    w, x, y, z = a
    W, X, Y, Z = b
    return (
        w * W - x * X - y * Y - z * Z,
        w * X + x * W + y * Z - z * Y,
        w * Y - x * Z + y * W + z * X,
        w * Z + x * Y - y * X + z * W,
    )


def conjugate(q: Quaternion) -> Quaternion:
    """The turn back."""
    return q[0], -q[1], -q[2], -q[3]


def rotated(q: Quaternion, v: Sequence[float]) -> Vector:
    """A vector after a turn."""
    _, x, y, z = product(product(q, (0.0, float(v[0]), float(v[1]), float(v[2]))), conjugate(q))
    return x, y, z


def about_x(angle: float) -> Quaternion:
    """A turn about x."""
    return math.cos(0.5 * angle), math.sin(0.5 * angle), 0.0, 0.0


def about_y(angle: float) -> Quaternion:
    """A turn about y."""
    return math.cos(0.5 * angle), 0.0, math.sin(0.5 * angle), 0.0
