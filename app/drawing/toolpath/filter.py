"""The moving average that takes the jerks out of the samples.

Over 8 ms it spreads what the look-ahead leaves as jumps: of the velocity at corners and at the ends of a stroke, of
the acceleration in between. It rounds a corner by some hundredths of a millimetre.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from app.robots.robot import Array

STEP_S = 1e-3
"""Between two samples."""

TAPS = 8
"""Samples averaged."""

WINDOW_S = TAPS * STEP_S


def moving_average(rows: Array) -> Array:
    """(r - 7, d) means of 8 neighbouring rows of (r, d)."""
    count = len(rows) - TAPS + 1
    total = rows[:count].copy()
    for shift in range(1, TAPS):
        total += rows[shift : shift + count]
    return total / TAPS


def counted(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """0, 1, 2, ... for each of the counts in turn."""
    return np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
