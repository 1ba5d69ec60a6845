"""The ink of a drawing as line segments in the order in which they are drawn, and the parts in which it is sent."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BLOCKS = (400, 50)
"""Segments in a part, from the large ones to the small."""

DOT_M = 1e-5
"""A dot is a segment of this length; it looks round, since lines have round ends."""


@dataclass(frozen=True, eq=False)
class Ink:
    """s segments of k strokes."""

    segments: NDArray[np.float32]
    """(s, 2, 3) m, relative to the sheet."""
    stray: NDArray[np.bool_]
    """(s,) between two strokes."""
    first: NDArray[np.int64]
    """(k,) first segment of each stroke."""
    end: NDArray[np.int64]
    """(k,) one after its last."""
    reached: Array
    """(s,) m, drawn of the stroke at the end of each segment."""

    def extent(self, stroke: int, along_m: float, done: int) -> tuple[int, float]:
        """How many segments are begun when `along_m` of a stroke is drawn, or `done` strokes in a hop (`stroke` is
        -1), and which share of the last of them is drawn."""
        if stroke < 0:
            return (int(self.end[done - 1]) if done else 0), 1.0
        first, end = int(self.first[stroke]), int(self.end[stroke])
        last = min(first + int(np.searchsorted(self.reached[first:end], along_m)), end - 1)
        before = self.reached[last - 1] if last > first else 0.0
        length = self.reached[last] - before
        return last + 1, float(min((along_m - before) / length, 1.0)) if length > 0.0 else 1.0

    def cut(self, start: int, stop: int, share: float = 1.0) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
        """Segments (n, 2, 3) from `start` to `stop`, of the last one only a share, and which are stray (n,)."""
        part = self.segments[start:stop].copy()
        part[-1:, 1] = part[-1:, 0] + share * (part[-1:, 1] - part[-1:, 0])
        return part, self.stray[start:stop]


def lay_ink(strokes_m: Sequence[Array], height_m: float, stray: bool, lengths_m: Array | None = None) -> Ink:
    """The ink of all strokes, `height_m` above the paper.

    Args:
        strokes_m: (n, 2) each, n >= 2.
        stray: whether the ways between the strokes are drawn too.
        lengths_m: (k,) lengths by which it will be told how far a stroke is drawn, if not the strokes' own.
    """
    segments, begin = along(strokes_m, height_m, stray)
    sizes = np.array([len(stroke) for stroke in strokes_m], dtype=np.int64)
    last = np.cumsum(sizes) - 1
    first, end = np.searchsorted(begin, last - sizes + 1), np.searchsorted(begin, last)
    lengths = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)
    travelled = np.concatenate([[0.0], np.cumsum(lengths, dtype=float)])
    own = travelled[end] - travelled[first]
    scale = np.ones(len(sizes)) if lengths_m is None else lengths_m / own
    stroke = np.repeat(np.arange(len(sizes)), sizes)[begin]
    reached = scale[stroke] * (travelled[1:] - travelled[first][stroke])
    return Ink(segments, np.isin(begin, last), first, end, reached)


def along(strokes_m: Sequence[Array], height_m: float, gaps: bool) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """Segments (s, 2, 3) along the strokes and, with `gaps`, from each to the next; and the vertices (s,) at which
    they begin, counted over all strokes."""
    points = np.concatenate([*strokes_m, np.zeros((1, 2))])[:-1]  # also where there are no strokes
    last = np.cumsum([len(stroke) for stroke in strokes_m], dtype=np.int64) - 1
    begin = np.arange(len(points) - 1) if gaps else np.setdiff1d(np.arange(len(points)), last)
    segments = np.full((len(begin), 2, 3), height_m, dtype=np.float32)
    segments[:, 0, :2], segments[:, 1, :2] = points[begin], points[begin + 1]
    segments[(segments[:, 0] == segments[:, 1]).all(axis=1), 1, 0] += DOT_M
    return segments, begin


def parts(count: int) -> list[tuple[int, int]]:
    """The complete parts of the first `count` segments as (start, stop): as many large ones as fit, then small ones."""
    found, start = [], 0
    for size in BLOCKS:
        while start + size <= count:
            found.append((start, start + size))
            start += size
    return found
