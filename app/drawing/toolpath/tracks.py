"""A toolpath made small for playing: fewer samples, and how far the drawing has come at each of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.toolpath.plan import Toolpath, sample
from app.robots.robot import Array

PLAY_STEP_S = 0.005


@dataclass(frozen=True, eq=False)
class Track:
    """A drawing at even steps of time and at its end. k samples."""

    t: Array
    """(k,) s, from 0"""
    pose: NDArray[np.float32]
    """(k, dof) m and rad"""
    q: NDArray[np.float32]
    """(k, n) rad or m"""
    pen: NDArray[np.bool_]
    """(k,) whether the pen is down on the paper."""
    stroke: NDArray[np.int32]
    """(k,) index of the stroke being drawn, -1 in hops."""
    along_mm: NDArray[np.float32]
    """(k,) length drawn of that stroke, 0 in hops."""
    done: NDArray[np.int32]
    """(k,) number of strokes completed before."""

    @property
    def duration_s(self) -> float:
        return float(self.t[-1])


def track(toolpath: Toolpath, step_s: float = PLAY_STEP_S) -> Track:
    """The toolpath every `step_s` and at its last sample."""
    if not step_s > 0.0:
        raise DrawingError("The step between two moments must be above zero; choose some milliseconds.")
    t = step_s * np.arange(np.ceil(toolpath.duration_s / step_s - 1e-6))
    t = np.append(t, toolpath.duration_s)
    at = sample(toolpath, t)
    first, last = _ends(toolpath.stroke)
    travelled = _travelled_mm(toolpath.pose)
    drawn = at.stroke >= 0
    begin, end = travelled[first][at.stroke], travelled[last][at.stroke]  # a hop's -1 is masked below
    along = np.clip(np.interp(t, toolpath.t, travelled), begin, end) - begin
    return Track(
        t=t,
        pose=at.pose.astype(np.float32),
        q=at.q.astype(np.float32),
        pen=at.pen,
        stroke=at.stroke.astype(np.int32),
        along_mm=np.where(drawn, along, 0.0).astype(np.float32),
        done=np.where(drawn, at.stroke, np.searchsorted(toolpath.t[last], t)).astype(np.int32),
    )


def _ends(stroke: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """First and last samples of each stroke, (s,) each. There is a hop before, between and after all of them."""
    drawn = stroke >= 0
    change = np.diff(drawn.astype(np.int8))
    return np.flatnonzero(change > 0) + 1, np.flatnonzero(change < 0)


def _travelled_mm(pose: Array) -> Array:
    """(k,) way of the tool since the beginning."""
    step = np.linalg.norm(np.diff(pose[:, :3], axis=0), axis=1)
    return 1e3 * np.concatenate([[0.0], np.cumsum(step)])
