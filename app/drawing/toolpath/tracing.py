"""From the speeds along the strokes to samples at 1 kHz, smoothed by the moving average."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.drawing.toolpath.filter import STEP_S, TAPS, counted, moving_average
from app.drawing.toolpath.lookahead import Profile
from app.drawing.toolpath.polyline import Polylines
from app.robots.robot import Array

DOT_S = 0.05
"""How long the pen stands on a dot."""


class Traced(NamedTuple):
    """Samples of all strokes in a row, r in all."""

    points: Array
    """(r, 2) m"""
    segment: NDArray[np.int64]
    """(r,) where the middle of the average lies."""
    samples: NDArray[np.int64]
    """(k,) of each stroke, both ends included."""


def stroke_samples(lines: Polylines, profile: Profile) -> NDArray[np.int64]:
    """(k,) samples that each stroke takes, both ends and the average included."""
    return _steps_of(lines, profile)[0] + TAPS


def trace(lines: Polylines, profile: Profile) -> Traced:
    """Sample every stroke, from rest on its first point to rest on its last."""
    steps, pace = _steps_of(lines, profile)
    # the raw samples wait for TAPS - 1 steps at both ends, so that every average is of samples of one stroke
    counts = steps + 2 * TAPS - 1
    stroke = np.repeat(np.arange(len(counts)), counts)
    place = counted(counts) - (TAPS - 1)
    t = np.clip(place, 0, steps[stroke]) * pace[stroke]
    segment, points = _points_at(lines, profile, stroke, t)
    whole = np.flatnonzero(place >= 0)
    return Traced(moving_average(points)[whole - (TAPS - 1)], segment[whole - TAPS // 2], steps + TAPS)


def _steps_of(lines: Polylines, profile: Profile) -> tuple[NDArray[np.int64], Array]:
    """Whole steps that each stroke takes (k,), and the stroke's own seconds that pass in one of them (k,)."""
    duration = profile.begin[lines.last] - profile.begin[lines.first[:-1]]
    dot = lines.last == lines.first[:-1]
    steps = np.where(dot, round(DOT_S / STEP_S), np.maximum(np.ceil(duration / STEP_S - 1e-6), 1)).astype(int)
    return steps, duration / steps


def _points_at(
    lines: Polylines, profile: Profile, stroke: NDArray[np.int64], t: Array
) -> tuple[NDArray[np.int64], Array]:
    """Segments (r,) and points (r, 2), `t` (r,) s after the beginning of the strokes (r,)."""
    t = t + profile.begin[lines.first[:-1]][stroke]
    found = np.searchsorted(profile.begin, t, side="right") - 1
    segment = np.clip(found, lines.first[:-1][stroke], lines.last[stroke])
    along = profile.travelled(segment, t - profile.begin[segment], lines.length)
    return segment, lines.points[segment] + along[:, None] * lines.direction[segment]
