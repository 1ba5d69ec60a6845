"""Join lines whose ends nearly touch: each gap closed spares the pen a lift."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial import KDTree

from app.drawing.vectorise.chains import Line, lengths, outward, tied

SPAN_PX = 6
BACKWARD = 0.75
"""Share of the gap that is left where a pen would have to turn right back: no long hairpins."""

LOOP = 4.0
"""A line is closed only if it is so many gaps long."""


def join_gaps(lines: Sequence[Line], gap_px: float) -> list[Line]:
    """Lines with points about a pixel apart, tied where ends are within `gap_px`: near and straight ones first."""
    ends = np.array([2 * k + side for k, line in enumerate(lines) for side in (0, 1) if (line[0] != line[-1]).any()])
    if len(ends) < 2 or gap_px <= 0.0:
        return list(lines)
    points = np.array([(line[0], line[-1]) for line in lines]).reshape(-1, 2)[ends]
    ways = outward(lines, np.zeros(2 * len(lines), int), np.full(2 * len(lines), SPAN_PX))[ends]
    pairs = KDTree(points).query_pairs(gap_px, output_type="ndarray")
    i, j = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))].T
    step = points[j] - points[i]
    distance = np.hypot(*step.T)
    turning = np.minimum((ways[i] * step).sum(axis=1), -(ways[j] * step).sum(axis=1)) / np.maximum(distance, 1e-9)
    near = distance <= gap_px * np.interp(turning, [-1.0, 1.0], [BACKWARD, 1.0])
    near &= (ends[i] // 2 != ends[j] // 2) | (lengths(lines)[ends[i] // 2] >= LOOP * distance)
    order = np.argsort(distance * (2.0 - turning), kind="stable")
    free, links = set(ends.tolist()), []
    for one, other in np.column_stack([ends[i], ends[j]])[order[near[order]]].tolist():
        if one in free and other in free:
            free -= {one, other}
            links.append((one, other))
    return tied(lines, links)
