"""Lines tied end to end: which follow each other, and their points as one line."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Line = NDArray[np.float64]
"""(n, 2) x and y in pixels; a closed one repeats its first point."""


def chains(count: int, links: Iterable[tuple[int, int]]) -> list[tuple[list[int], bool]]:
    """Group `count` lines by links between their ends, each end used at most once.

    Line k has the ends 2k, its beginning, and 2k + 1. A chain is the list of the ends at which its lines are entered,
    and whether it closes.
    """
    partner = [-1] * (2 * count)
    for one, other in links:
        partner[one], partner[other] = other, one
    loose = [end for end in range(2 * count) if partner[end] < 0]
    seen = [False] * count
    found = []
    for entry in (*loose, *range(0, 2 * count, 2)):  # open chains first: what is left then are rings
        if not seen[entry // 2]:
            found.append(_walk(entry, partner, seen))
    return found


def _walk(entry: int, partner: list[int], seen: list[bool]) -> tuple[list[int], bool]:
    chain = []
    while entry >= 0 and not seen[entry // 2]:
        seen[entry // 2] = True
        chain.append(entry)
        entry = partner[entry ^ 1]
    return chain, entry >= 0


def tied(lines: Sequence[Line], links: Sequence[tuple[int, int]]) -> list[Line]:
    """Lines with points about a pixel apart, tied by straight pieces of the same spacing."""
    ways = [(line, line[::-1]) for line in lines]
    found = chains(len(lines), links)
    return [_tie([ways[entry // 2][entry % 2] for entry in chain], closed) for chain, closed in found]


def _tie(pieces: list[Line], closed: bool) -> Line:
    if closed:
        pieces = [*pieces, pieces[0][:1]]
    parts = [pieces[0]]
    for before, after in pairwise(pieces):
        shared = int((before[-1] == after[0]).all())
        parts += [_between(before[-1], after[0]), after[shared:]]
    return np.concatenate(parts) if len(parts) > 1 else parts[0]


def _between(start: Line, stop: Line) -> Line:
    """Points strictly between two, at most a pixel apart."""
    steps = max(int(np.ceil(np.hypot(*(stop - start)))), 1)
    return start + np.arange(1, steps)[:, None] / steps * (stop - start)


def lengths(lines: Sequence[Line]) -> NDArray[np.float64]:
    """Pixels along each line."""
    if not lines:
        return np.zeros(0)
    stops = np.cumsum([len(line) for line in lines])
    steps = np.append(np.hypot(*np.diff(np.concatenate(lines), axis=0).T), 0.0)
    steps[stops - 1] = 0.0
    return np.add.reduceat(steps, np.append(0, stops[:-1]))


def outward(lines: Sequence[Line], skip: NDArray[np.intp], span: NDArray[np.intp]) -> NDArray[np.float64]:
    """(ends, 2) unit vector in which each line leaves at its two ends, judged over `span` points after `skip`.

    Ends are numbered as for `chains`; skip and span: (ends,). A dot leaves nowhere: (0, 0).
    """
    size = np.repeat([len(line) for line in lines], 2)
    tip = np.cumsum(size.reshape(-1, 2)[:, 0]).repeat(2) - size
    tip[1::2] += size[1::2] - 1
    inward = np.tile([1, -1], len(lines))
    near = np.minimum(skip, size - 1)
    far = np.minimum(near + span, size - 1)
    near = np.where(far > near, near, 0)
    points = np.concatenate(lines)
    step = points[tip + inward * near] - points[tip + inward * far]
    return step / np.maximum(np.hypot(*step.T), 1e-9)[:, None]
