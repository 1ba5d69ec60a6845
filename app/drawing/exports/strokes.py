"""What every exporter asks of strokes: that they can be written, how long they are, where the pen hops."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError

LARGEST_MM = 1e5

Stroke = NDArray[np.float64]
"""(n, 2) mm from the middle of the sheet, y up."""

SheetSize = tuple[float, float]
"""Width and height in mm."""


def checked_strokes(strokes: Sequence[Stroke]) -> list[Stroke]:
    """The same strokes as arrays; DrawingError if one cannot be written to a file."""
    arrays = [np.asarray(stroke, dtype=np.float64) for stroke in strokes]
    for number, stroke in enumerate(arrays, 1):
        if stroke.ndim != 2 or stroke.shape[1] != 2 or len(stroke) < 2:
            raise DrawingError(f"Stroke {number} has the shape {stroke.shape}; a stroke needs two or more points x, y.")
        if not (np.abs(stroke) <= LARGEST_MM).all():
            raise DrawingError(f"Stroke {number} has a point that is no place on a sheet; process the picture again.")
    return arrays


def checked_sheet(sheet_mm: SheetSize) -> SheetSize:
    """Width and height; DrawingError if there is no such sheet."""
    width, height = (float(side) for side in sheet_mm)
    if not (0.0 < width <= LARGEST_MM and 0.0 < height <= LARGEST_MM):
        raise DrawingError(f"A sheet of {width:g} x {height:g} mm cannot be drawn on; give its width and height in mm.")
    return width, height


def from_corner(points: Stroke, sheet_mm: SheetSize) -> Stroke:
    """(n, 2) mm from the sheet's upper left corner, y down, as pictures have it."""
    return points * (1.0, -1.0) + np.array(sheet_mm) / 2.0


def hops(strokes: Sequence[Stroke]) -> NDArray[np.float64]:
    """(strokes - 1, 2, 2): from where to where the pen moves lifted between strokes."""
    if len(strokes) < 2:
        return np.zeros((0, 2, 2))
    return np.array([[before[-1], after[0]] for before, after in pairwise(strokes)])


def length_mm(points: NDArray[np.float64]) -> float:
    """Of one polyline (n, 2), or of many with the same number of points (..., n, 2)."""
    return float(np.linalg.norm(np.diff(points, axis=-2), axis=-1).sum())
