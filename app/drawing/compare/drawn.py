"""What the pen really leaves on the paper: the toolpath's samples with the pen down, back on the sheet."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from app.drawing.fitting import in_pixels
from app.drawing.likeness import likeness as likeness_in_pixels
from app.drawing.rasterise import render_ink
from app.drawing.toolpath import Placement, Toolpath
from app.robots.robot import Array

PIECE_MM = 0.25
NEIGHBOURS = 6
"""The strokes in pieces this short at most: the nearest piece is among so many with the nearest middles."""

MOST_SAMPLES = 20_000
"""At which the deviation is measured."""

SPACING_MM = 0.1
"""Between two points of drawn ink, about; with many more the rendered lines would come out thicker."""

PX_PER_MM = 3.0
"""Of the picture of strokes that come without one."""


def drawn_strokes(toolpath: Toolpath, placement: Placement) -> list[Array]:
    """The ink of a toolpath as strokes, (n, 2) sheet mm each: one from every lowering of the pen to its next lift."""
    down = np.flatnonzero(toolpath.pen)
    points = placement.on_sheet(toolpath.pose[down, :2])
    runs = np.split(points, np.flatnonzero(np.diff(down) > 1) + 1)
    return [_thinned(run) for run in runs]


def deviation_um(toolpath: Toolpath, placement: Placement, strokes: Sequence[Array]) -> float:
    """Root mean square distance of what is drawn from the nearest stroke, (n, 2) sheet mm each, micrometres."""
    drawn = np.flatnonzero(toolpath.stroke >= 0)
    points = placement.on_sheet(toolpath.pose[drawn[:: math.ceil(len(drawn) / MOST_SAMPLES)], :2])
    start, step = _pieces(strokes)
    nearest = KDTree(start + step / 2).query(points, k=min(NEIGHBOURS, len(start)))[1].reshape(len(points), -1)
    along, from_start = step[nearest], points[:, None] - start[nearest]
    share = (from_start * along).sum(axis=2) / np.maximum((along**2).sum(axis=2), 1e-18)
    apart = from_start - np.clip(share, 0.0, 1.0)[..., None] * along
    return 1e3 * math.sqrt(float((apart**2).sum(axis=2).min(axis=1).mean()))


def likeness(grey: NDArray[np.uint8], drawn: Sequence[Array], mm_per_px: float, pen_mm: float) -> float:
    """Likeness (0..1) of a picture (h, w) in the middle of the sheet with the ink of sheet strokes (n, 2) mm."""
    return likeness_in_pixels(grey, in_pixels(drawn, grey.shape, mm_per_px), mm_per_px, pen_mm)


def likeness_to_strokes(strokes: Sequence[Array], drawn: Sequence[Array], pen_mm: float) -> float:
    """The same for strokes without a picture: with that of their own ink as it should be, which scores 1."""
    half = np.max([np.abs(stroke).max(axis=0) for stroke in strokes], axis=0) + pen_mm
    grey = render_ink(strokes, (2.0 * float(half[0]), 2.0 * float(half[1])), pen_mm, PX_PER_MM)
    at_best = likeness(grey, strokes, 1.0 / PX_PER_MM, pen_mm)
    return min(1.0, likeness(grey, drawn, 1.0 / PX_PER_MM, pen_mm) / at_best)


def _thinned(run: Array) -> Array:
    """Its ends, and the points of a run (n, 2) mm that are `SPACING_MM` apart."""
    cell = np.cumsum(np.hypot(*np.diff(run, axis=0).T)) // SPACING_MM
    kept = np.flatnonzero(np.diff(cell[:-1]) > 0.0) + 2
    return run[np.concatenate([[0], kept, [len(run) - 1]])]


def _pieces(strokes: Sequence[Array]) -> tuple[Array, Array]:
    """Starts and steps (m, 2) of all segments, long ones divided; a dot is a piece of length 0."""
    start = np.concatenate([stroke[:-1] for stroke in strokes])
    step = np.concatenate([np.diff(stroke, axis=0) for stroke in strokes])
    parts = np.maximum(np.ceil(np.hypot(*step.T) / PIECE_MM), 1).astype(int)
    which = np.repeat(np.arange(len(parts)), parts)
    place = np.arange(len(which)) - np.repeat(np.cumsum(parts) - parts, parts)
    small = (step / parts[:, None])[which]
    return start[which] + place[:, None] * small, small
