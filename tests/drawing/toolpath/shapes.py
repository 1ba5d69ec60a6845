"""Strokes to plan with, sheet millimetres."""

from __future__ import annotations

import numpy as np

from app.robots.robot import Array

HALF_MM = 45.0
"""Every robot reaches a square of twice this side around the middle of its sheet."""


def circle(radius: float, centre: tuple[float, float] = (0.0, 0.0), points: int = 60) -> Array:
    turn = 2 * np.pi * np.linspace(0.0, 1.0, points + 1)
    return np.column_stack([centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn)])


def zigzag(tooth: float, height: float, teeth: int = 20) -> Array:
    k = np.arange(float(teeth))
    return np.column_stack([k * tooth, (k % 2) * height])


def spiral(turns: float, pitch: float) -> Array:
    turn = np.linspace(0.0, 2 * np.pi * turns, int(40 * turns))
    radius = np.linspace(0.0, turns * pitch, len(turn))
    return np.column_stack([radius * np.cos(turn), radius * np.sin(turn)])


def dot(x: float, y: float) -> Array:
    return np.array([[x, y], [x, y]])


def line(start: tuple[float, float], stop: tuple[float, float]) -> Array:
    return np.array([start, stop], dtype=float)


def every_kind() -> list[Array]:
    """Smooth, sharp, there and back, large, tiny, and a dot."""
    return [
        circle(20.0),
        zigzag(1.0, 3.0) - 20.0,
        zigzag(0.3, 0.4) + 10.0,
        spiral(4.0, 3.0),
        line((-40.0, -30.0), (40.0, 35.0)),
        np.array([[0.0, 0.0], [10.0, 0.0], [0.0, 0.0], [10.0, 1e-7], [10.0, 10.0], [10.0, 10.0], [12.0, 3.0]]),
        circle(0.05, (5.0, 5.0)),
        dot(-10.0, 12.0),
    ]


def random_strokes(rng: np.random.Generator, count: int) -> list[Array]:
    """Any of the kinds, at any place, and wild scribbles."""
    strokes = []
    for _ in range(count):
        kinds = every_kind()
        kind = int(rng.integers(len(kinds) + 1))
        scribble = rng.normal(0.0, rng.choice([0.02, 0.2, 2.0, 8.0]), (int(rng.integers(2, 60)), 2))
        stroke = kinds[kind] if kind < len(kinds) else scribble
        strokes.append(np.clip(stroke + rng.uniform(-20.0, 20.0, 2), -HALF_MM, HALF_MM))
    return strokes


def distances(points: Array, polyline: Array) -> Array:
    """(n,) from points (n, 2) to the segments of a polyline (m, 2)."""
    start, step = polyline[:-1], np.diff(polyline, axis=0)
    from_start = points[:, None] - start
    share = np.clip((from_start * step).sum(axis=2) / np.maximum((step**2).sum(axis=1), 1e-30), 0.0, 1.0)
    return np.linalg.norm(from_start - share[..., None] * step, axis=2).min(axis=1)


def length(stroke: Array) -> float:
    return float(np.hypot(*np.diff(stroke, axis=0).T).sum())
