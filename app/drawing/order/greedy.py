"""A first order: always the shortest hop that can still be taken, until all strokes hang together."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.spatial import KDTree

from app.drawing.order.tour import Ends, Tour

NEAR_FIRST = 8
NEAR_LATER = 6
"""Candidates of an end, itself and the other end of its chain included: at least 3."""


def greedy_tour(ends: Ends) -> Tour:
    """Chains of strokes grow together; each round looks only at the chains' loose ends."""
    free = len(ends.points) - 1
    partner = [-1] * free
    chain_to = [end ^ 1 for end in range(free)]  # the other end of the chain; `free` for the one from home
    missing = free // 2
    loose, near = np.arange(free), NEAR_FIRST
    while missing:
        for a, b in _pairs(ends.strewn, loose, near):
            if partner[a] < 0 and partner[b] < 0 and chain_to[a] != b:
                partner[a], partner[b] = b, a
                far_a, far_b = chain_to[a], chain_to[b]
                for here, there in ((far_a, far_b), (far_b, far_a)):
                    if here != free:
                        chain_to[here] = there
                missing -= 1
        loose, near = np.array([end for end in loose.tolist() if partner[end] < 0]), NEAR_LATER
    return _walk(partner)


def _pairs(points: np.ndarray, loose: np.ndarray, near: int) -> Iterator[tuple[int, int]]:
    """Near pairs of loose ends, the nearest first."""
    here = points[loose]
    far, found = KDTree(here).query(here, k=min(near, len(loose)))
    order = np.argsort(far, axis=None, kind="stable")
    a = np.repeat(loose, far.shape[1])[order]
    b = loose[found.ravel()[order]]
    return ((x, y) for x, y in zip(a.tolist(), b.tolist(), strict=True) if x != y)


def _walk(partner: list[int]) -> Tour:
    """From home along the hops; the stroke that has no partner ends it."""
    ring = [len(partner) - 1]
    while (end := partner[ring[-1]]) >= 0:
        ring += (end, end ^ 1)
    return Tour([*ring, len(partner)])
