"""How much later one motion is than another, finer than their sampling."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LONGEST_S = 0.5
MOVES = 1e-3
"""A joint whose reference moves less than this (rad or m) tells nothing."""


def lag_s(t: Array, reference: Array, late: Array, longest_s: float = LONGEST_S) -> float:
    """By how many seconds `late` (k, n) follows `reference` (k, n) at times t (k,); negative if it is ahead.

    The lag with the largest correlation, summed over the joints, each about its mean: first on a grid as fine as
    the samples, then between its points on cubic splines. NaN where nothing moves, or for too short a time.
    """
    from scipy.interpolate import CubicSpline
    from scipy.optimize import minimize_scalar

    moving = np.ptp(reference, axis=0) > MOVES
    inside = (t >= t[0] + longest_s) & (t <= t[-1] - longest_s)
    if not moving.any() or inside.sum() < 10:
        return math.nan
    spline = CubicSpline(t, reference[:, moving])
    target = _centred(late[inside][:, moving])

    def mismatch(lag: float) -> float:
        shifted = _centred(np.asarray(spline(t[inside] - lag)))
        size = np.linalg.norm(shifted, axis=0) * np.linalg.norm(target, axis=0)
        return -float(np.sum((shifted * target).sum(axis=0) / np.maximum(size, 1e-300)))

    step = float(np.median(np.diff(t)))
    lags = np.arange(-longest_s, longest_s + step / 2, step)
    best = float(lags[int(np.argmin([mismatch(lag) for lag in lags]))])
    found = minimize_scalar(mismatch, bounds=(best - step, best + step), method="bounded", options={"xatol": 1e-7})
    return float(found.x)  # pyright: ignore[reportAttributeAccessIssue]


def _centred(columns: Array) -> Array:
    return columns - columns.mean(axis=0)
