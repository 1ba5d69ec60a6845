"""From a mask of ink to strokes: thin, trace, go through junctions, join, smooth. Every mode ends here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.drawing.vectorise.chains import Line, lengths
from app.drawing.vectorise.crowding import check_lines
from app.drawing.vectorise.gaps import join_gaps
from app.drawing.vectorise.junctions import through_junctions
from app.drawing.vectorise.pixel_graph import trace
from app.drawing.vectorise.smoothing import Flock, onto_ridge, simplify, smooth
from app.drawing.vectorise.thinning import thin


@dataclass(frozen=True)
class Finish:
    """How traced lines become strokes."""

    shortest_mm: float
    """Shorter strokes are dropped."""
    join_mm: float
    """Widest gap between two ends that is drawn over."""
    smooth_px: float = 1.0
    """Deviation of the Gaussian along a stroke."""
    tolerance_mm: float = 0.05
    """By how much a stroke may move to be drawn with fewer points."""


def trace_strokes(
    mask: NDArray[np.bool_],
    ridge: NDArray[np.float32],
    mm_per_px: float,
    finish: Finish,
    half_width: NDArray[np.float32] | None = None,
) -> list[Line]:
    """Strokes along the middle of a mask (h, w), each on the top of `ridge` (h, w).

    half_width: (h, w) pixels of ink beside each pixel of the middle line; None for lines one pixel wide.
    TooManyStrokes for a mask of noise.
    """
    if half_width is None:
        half_width = np.full(mask.shape, 0.5, np.float32)
    thinned = thin(mask)
    check_lines(thinned)
    lines = through_junctions(trace(thinned), half_width)
    kept = np.flatnonzero(lengths(lines) * mm_per_px >= finish.shortest_mm)
    lines = join_gaps([lines[k] for k in kept], finish.join_mm / mm_per_px)
    lines = [line for line in lines if len(line) > 1]
    if not lines:
        return []
    flock = Flock(lines)
    onto_ridge(flock, ridge)
    smooth(flock, finish.smooth_px)
    return [simplify(line, finish.tolerance_mm / mm_per_px) for line in flock.lines()]
