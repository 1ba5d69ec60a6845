"""Where lines meet, go straight through, as a hand would.

Thinning leaves a whisker at a corner of thick ink and turns a crossing into two junctions with a short bridge between
them. Whiskers go, bridges are contracted, and the ends that then meet are paired, the straightest first.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from app.drawing.vectorise.chains import Line, lengths, outward, tied
from app.drawing.vectorise.pixel_graph import Branches

WHISKER = 1.5
"""Longest whisker, in half widths of the ink."""

BRIDGE, BRIDGE_PX = 2.5, 2.0
"""Longest bridge: half widths, and pixels more."""

SPAN_PX = 6
STRAIGHT = np.cos(np.radians(45.0))
SHARPEST = np.cos(np.radians(120.0))
"""A pen does not turn back on itself: such a pair is lifted between."""


def through_junctions(branches: Branches, half_width: NDArray[np.float32]) -> list[Line]:
    """Lines that pass their junctions. half_width: (h, w) pixels, of the ink around a line at each of its pixels."""
    if not branches.lines:
        return []
    x, y = np.array([(line[0], line[-1]) for line in branches.lines]).astype(int).transpose(2, 0, 1)
    radius = half_width[y, x]
    bridge, whisker = _bridges_and_whiskers(branches, radius)
    kept = np.flatnonzero(~(bridge | whisker))
    if not len(kept):
        return []
    lines = [branches.lines[branch] for branch in kept]
    meeting = _meetings(branches, bridge)[kept].ravel()
    depth = np.rint(radius[kept].ravel()).astype(int)
    ways = outward(lines, depth, depth + SPAN_PX)
    cuts = (meeting >= 0).astype(int)  # a leg stops a pixel short of the line it meets: its ink touches all the same
    links = []
    for ends in _groups(meeting):
        for one, other, straightness in _pairs(ends, ways[ends]):
            links.append((one, other))
            cuts[[one, other]] = depth[[one, other]] if straightness > STRAIGHT else 0
    return tied([_trimmed(line, *cut) for line, cut in zip(lines, cuts.reshape(-1, 2).tolist(), strict=True)], links)


def _bridges_and_whiskers(
    branches: Branches, radius: NDArray[np.float32]
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    length = lengths(branches.lines)
    at_junction = branches.degrees > 2
    bridge = at_junction.all(axis=1) & (length <= BRIDGE * radius.mean(axis=1) + BRIDGE_PX)
    one_free = at_junction.any(axis=1) & (branches.degrees == 1).any(axis=1)
    return bridge, one_free & (length <= WHISKER * np.where(at_junction, radius, 0.0).max(axis=1))


def _meetings(branches: Branches, bridge: NDArray[np.bool_]) -> NDArray[np.intp]:
    """(branches, 2) number of the meeting at each end, one for junctions with a bridge between; -1 for none."""
    nodes, number = np.unique(branches.nodes, return_inverse=True)
    number = number.reshape(branches.nodes.shape)
    one, other = number[bridge].T
    graph = coo_array((np.ones(len(one), np.int8), (one, other)), shape=(len(nodes), len(nodes)))
    meeting = connected_components(graph, directed=False)[1][number]
    return np.where(branches.degrees > 2, meeting, -1)


def _groups(meeting: NDArray[np.intp]) -> list[list[int]]:
    """Ends at the same meeting, in order."""
    order = np.argsort(meeting, kind="stable")
    order = order[meeting[order] >= 0]
    return [ends.tolist() for ends in np.split(order, np.flatnonzero(np.diff(meeting[order])) + 1) if len(ends) > 1]


def _pairs(ends: list[int], ways: NDArray[np.float64]) -> list[tuple[int, int, float]]:
    """(end, end, cosine of the turn between) of the ends that meet, straightest first."""
    turns = (-ways @ ways.T).tolist()
    candidates = [(turns[i][j], ends[i], ends[j]) for i, j in combinations(range(len(ends)), 2)]
    free, pairs = set(ends), []
    for straightness, one, other in sorted(candidates, key=lambda candidate: -candidate[0]):
        if one in free and other in free and (len(ends) == 2 or straightness > SHARPEST):
            free -= {one, other}
            pairs.append((one, other, straightness))
    return pairs


def _trimmed(line: Line, start: int, stop: int) -> Line:
    """Without so many points at either end, but never without any."""
    if start + stop >= len(line):
        start = stop = (len(line) - 1) // 2
    return line[start : len(line) - stop]
