"""Where a drawing can be stopped without leaving a blot: between two strokes, where the pen is highest."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from app.robots.robot import Array

SAME_HEIGHT_M = 1e-6


class Timed(Protocol):
    """A toolpath, or the track made of it. k samples."""

    @property
    def t(self) -> Array:
        """(k,) s"""
        ...

    @property
    def pose(self) -> NDArray[np.floating[Any]]:
        """(k, dof) m and rad"""
        ...

    @property
    def stroke(self) -> NDArray[np.integer[Any]]:
        """(k,) the stroke being drawn, -1 in hops."""
        ...


def pause_after(path: Timed, t: float) -> float:
    """The next time from `t` on, s, at which the pen is highest between two strokes, or else the end.

    Where it stays at one height for a while, on the paper or above it, this is the middle of that while.
    """
    times = path.t[_highest(path)]
    following = np.searchsorted(times, t)
    return float(times[following] if following < len(times) else path.t[-1])


def _highest(path: Timed) -> NDArray[np.int64]:
    """One sample of each hop from a stroke to another."""
    hop = path.stroke < 0
    change = np.diff(hop.astype(np.int8))
    starts, stops = np.flatnonzero(change > 0)[:-1] + 1, np.flatnonzero(change < 0)[1:] + 1
    if not len(starts):
        return starts
    z = path.pose[:, 2]
    # maxima of hops and strokes in turn: every second one is a hop's
    top = np.maximum.reduceat(z, np.column_stack([starts, stops]).ravel())[::2]
    which = np.repeat(np.arange(len(starts)), stops - starts)
    inside = np.concatenate([np.arange(start, stop) for start, stop in zip(starts, stops, strict=True)])
    high = z[inside] >= top[which] - SAME_HEIGHT_M
    inside, which = inside[high], which[high]
    first, last = (np.searchsorted(which, np.arange(len(starts)), side=side) for side in ("left", "right"))
    return inside[(first + last - 1) // 2]
