"""Strokes as the pen goes along them."""

from __future__ import annotations

import numpy as np


def walked(stroke, step=0.5):
    """(n, 2) points along a stroke, `step` pixels apart at most, its own among them."""
    parts = np.maximum(1, np.ceil(np.hypot(*np.diff(stroke, axis=0).T) / step)).astype(int)
    number = np.concatenate([[0], np.cumsum(parts)])
    at = np.arange(number[-1] + 1)
    return np.column_stack([np.interp(at, number, axis) for axis in stroke.T])
