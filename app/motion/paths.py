"""Closed paths in a horizontal plane, run through lap after lap."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.robots import Robot

Array = NDArray[np.float64]

DWELL = 0.15
"""Share of a lap that point-to-point motion rests at either end."""


@dataclass(frozen=True)
class Path:
    """A closed curve that starts on the positive x axis and stays within a circle of radius 1."""

    title: str
    offset: Callable[[Array], tuple[Array, Array]]
    """Phase in [0, 1), elementwise -> x and y."""


@dataclass(frozen=True)
class Tour:
    """A path of some size and pace."""

    path: str = "circle"
    """Key of `PATHS`."""
    size_m: float = 0.1
    """Radius of the circle around the path."""
    lap_s: float = 100.0
    clockwise: bool = False
    """Seen from above."""

    def poses(self, robot: Robot, t: ArrayLike) -> Array:
        """(..., dof) where the tool should be at times t (...), around the robot's home; a rotation stays 0."""
        phase = np.mod(np.asarray(t, dtype=float) / self.lap_s, 1.0)
        x, y = PATHS[self.path].offset(phase)
        poses = np.broadcast_to(robot.home, (*phase.shape, robot.dof)).copy()
        poses[..., 0] += self.size_m * x
        poses[..., 1] += self.size_m * (-y if self.clockwise else y)
        return poses


def quintic(s: ArrayLike) -> Array:
    """From 0 to 1 over s in [0, 1], at rest at both ends in speed and acceleration; constant beyond."""
    u = np.clip(s, 0.0, 1.0)
    return u * u * u * (10.0 + u * (6.0 * u - 15.0))


def _circle(phase: Array) -> tuple[Array, Array]:
    return np.cos(2 * np.pi * phase), np.sin(2 * np.pi * phase)


def _square(phase: Array) -> tuple[Array, Array]:
    """At constant speed from the middle of a side, its corners on the unit circle."""
    corners = np.array([0.0, 0.125, 0.375, 0.625, 0.875, 1.0])
    half = np.sqrt(0.5)
    x = np.interp(phase, corners, half * np.array([1.0, 1.0, -1.0, -1.0, 1.0, 1.0]))
    y = np.interp(phase, corners, half * np.array([0.0, 1.0, 1.0, -1.0, -1.0, 0.0]))
    return x, y


def _lemniscate(phase: Array) -> tuple[Array, Array]:
    """Bernoulli's."""
    c, s = _circle(phase)
    return c / (1.0 + s * s), c * s / (1.0 + s * s)


def _point_to_point(phase: Array) -> tuple[Array, Array]:
    """From one end to the other and back by quintics, with a rest at both ends."""
    move = 0.5 - DWELL
    there = quintic((phase - DWELL / 2) / move)
    back = quintic((phase - 0.5 - DWELL / 2) / move)
    return 1.0 - 2.0 * (there - back), np.zeros_like(phase)


PATHS: dict[str, Path] = {
    "circle": Path("Circle", _circle),
    "square": Path("Square", _square),
    "lemniscate": Path("Lemniscate", _lemniscate),
    "point-to-point": Path("Point to point", _point_to_point),
}
