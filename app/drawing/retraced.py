"""How much of a drawing is drawn twice: a line along another that is there already costs time and shows nothing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STEP_MM = 0.25
CELL_MM = 0.5
"""About a pen's width: ink that passes through a cell of the sheet that has ink already is drawn twice."""

ALONG_MM = 3.0
"""A line may come back so soon without counting: it turns a corner, or runs along the border of two cells."""


def retraced_share(strokes: Sequence[Array]) -> float:
    """0 to 1 of the ink of strokes, (n, 2) each, mm. Crossings count little, a contour around a thin line much."""
    points, way = _along(strokes)
    if not len(points):
        return 0.0
    shifted = _seen_before(points + 0.5 * CELL_MM, way)  # two lines side by side may lie in two cells, but not twice
    return float((shifted | _seen_before(points, way)).mean())


def _seen_before(points: Array, way: Array) -> NDArray[np.bool_]:
    """(k,) whether the cell of a point had ink from long ago."""
    cells = np.floor(points / CELL_MM).astype(np.int64)
    cells -= cells.min(axis=0)
    key = cells[:, 0] * (int(cells[:, 1].max()) + 1) + cells[:, 1]
    order = np.lexsort((way, key))
    same = np.diff(key[order]) == 0
    passes = np.concatenate([[0], np.cumsum(same & (np.diff(way[order]) > ALONG_MM))])
    first = np.flatnonzero(np.concatenate([[True], ~same]))
    group = np.cumsum(np.concatenate([[0], ~same]))
    seen = np.empty(len(order), bool)
    seen[order] = passes > passes[first][group]
    return seen


def _along(strokes: Sequence[Array]) -> tuple[Array, Array]:
    """Points every `STEP_MM` (k, 2), and how much of the pen's way lies behind each (k,); strokes lie far apart."""
    found, ways, behind = [np.empty((0, 2))], [np.empty(0)], 0.0
    for stroke in strokes:
        lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(stroke, axis=0), axis=1))])
        s = np.arange(0.0, lengths[-1] + STEP_MM / 2, STEP_MM)
        found.append(np.column_stack([np.interp(s, lengths, stroke[:, 0]), np.interp(s, lengths, stroke[:, 1])]))
        ways.append(behind + s)
        behind += float(lengths[-1]) + 2.0 * ALONG_MM
    return np.concatenate(found), np.concatenate(ways)
