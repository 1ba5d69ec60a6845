"""The curves a tool can follow around the robot's home, over s: one unit a lap, or one from end to end.

Polygon and arch have rounded corners: over a stretch of 2 b the direction passes from d1 to d2 by a smoothstep, so
that the curve leaves the first straight b before the corner and joins the second b after it, with a continuous
second derivative. All derivatives are by s.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.motion.pieces import Pieces, joined
from app.motion.settings import MotionSettings
from app.motion.trajectory import Array, Law, MotionError

CORNER = 0.3
"""Of a polygon's side, how long before its corner the tool begins to turn."""


@dataclass(frozen=True)
class CurveKind:
    """One family of curves."""

    title: str
    closed: bool
    parameters: tuple[str, ...]
    """Which settings shape it, beside its size."""
    draw: Callable[[MotionSettings], Law]
    """From the settings: (k, 3) offsets from the middle over s in [0, 1], metres."""


@dataclass(frozen=True)
class Trigonometric:
    """Circles and their kin: offset = size (c(a), s(a)) with a = first + turns 2 pi s, and a steady climb."""

    size: float
    turns: float = 1.0
    climb: float = 0.0
    figure_eight: bool = False

    def at(self, u: ArrayLike) -> tuple[Array, Array, Array]:
        s = np.asarray(u, dtype=float)
        pace = 2.0 * math.pi * self.turns
        plane = _lemniscate(pace * s) if self.figure_eight else _circle(pace * s)
        zero = np.zeros_like(s)
        heights = (self.climb * (s - 0.5), np.full_like(s, self.climb), zero)
        factors = (self.size, self.size * pace, self.size * pace * pace)
        columns = [
            np.stack([factor * x, factor * y, height], axis=-1)
            for factor, (x, y), height in zip(factors, plane, heights, strict=True)
        ]
        return columns[0], columns[1], columns[2]


def _circle(a: Array) -> list[tuple[Array, Array]]:
    c, s = np.cos(a), np.sin(a)
    return [(c, s), (-s, c), (-c, -s)]


def _lemniscate(a: Array) -> list[tuple[Array, Array]]:
    """Bernoulli's: x = c / w, y = c s / w with c = cos a, s = sin a, w = 1 + s^2, and their derivatives by a."""
    c, s = np.cos(a), np.sin(a)
    w, dw, ddw = 1.0 + s * s, 2.0 * s * c, 2.0 * (c * c - s * s)
    x, y = _quotient(c, -s, -c, w, dw, ddw), _quotient(c * s, c * c - s * s, -4.0 * c * s, w, dw, ddw)
    return list(zip(x, y, strict=True))


def _quotient(f: Array, df: Array, ddf: Array, w: Array, dw: Array, ddw: Array) -> tuple[Array, Array, Array]:
    """f / w and its first two derivatives."""
    value = f / w
    first = (df - value * dw) / w
    return value, first, (ddf - 2.0 * first * dw - value * ddw) / w


def rounded(points: Array, reach: Array) -> Pieces:
    """Through the first and last of points (m, 3), rounding each corner over `reach` (m - 2,) to either side; over
    s in [0, 1], as fast as each other on all straights."""
    sides = np.diff(points, axis=0)
    lengths = np.linalg.norm(sides, axis=1)
    directions = sides / lengths[:, None]
    room = lengths - np.concatenate([[0.0], reach]) - np.concatenate([reach, [0.0]])
    pieces: list[tuple[float, list[Array]]] = []
    position = points[0]
    for side, straight in enumerate(room):
        here = directions[side]
        if straight > 1e-12:
            pieces.append((straight, [position, here]))
            position = position + straight * here
        if side < len(reach):
            h = 2.0 * reach[side]
            bend = directions[side + 1] - here
            # the derivative is here + bend (3 x^2 - 2 x^3), x = u / h
            pieces.append((h, [position, here, 0.0 * bend, bend / h**2, -bend / (2.0 * h**3)]))
            position = position + h * (here + 0.5 * bend)
    curve = joined(pieces)
    return curve.stretched(1.0 / curve.knots[-1])


def _line(shape: MotionSettings) -> Pieces:
    end = np.array([shape.size_m, 0.0, 0.5 * shape.height_m])
    return joined([(1.0, [-end, 2.0 * end])])


def _polygon(shape: MotionSettings) -> Pieces:
    """From the middle of a side; its corners, were they sharp, on the cylinder."""
    angles = 2.0 * math.pi * (np.arange(shape.sides) + 0.5) / shape.sides
    corners = shape.size_m * np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=-1)
    middle = 0.5 * (corners[0] + corners[-1])
    reach = np.full(shape.sides, CORNER * 2.0 * shape.size_m * math.sin(math.pi / shape.sides))
    return rounded(np.vstack([middle, corners, middle]), reach)


def _arch(shape: MotionSettings) -> Pieces:
    half, lift = shape.size_m, shape.height_m
    if not abs(lift) > 1e-4:
        raise MotionError("An arch needs a lift; give it a height above 0.")
    corners = np.array([[-half, 0.0, -lift], [-half, 0.0, lift], [half, 0.0, lift], [half, 0.0, -lift]])
    return rounded(corners * [1.0, 1.0, 0.5], np.full(2, min(0.7 * abs(lift), 0.9 * half)))


CURVES: dict[str, CurveKind] = {
    "line": CurveKind("Line", False, ("height_m",), _line),
    "circle": CurveKind("Circle", True, ("laps",), lambda shape: Trigonometric(shape.size_m)),
    "helix": CurveKind(
        "Helix",
        False,
        ("height_m", "turns"),
        lambda shape: Trigonometric(shape.size_m, shape.turns, shape.height_m),
    ),
    "lemniscate": CurveKind(
        "Lemniscate", True, ("laps",), lambda shape: Trigonometric(shape.size_m, figure_eight=True)
    ),
    "arch": CurveKind("Arch (pick and place)", False, ("height_m",), _arch),
    "polygon": CurveKind("Polygon", True, ("sides", "laps"), _polygon),
}
