"""The order of strokes as a ring of their ends, and the exchange of hops in it.

Stroke i has the ends 2i and 2i + 1, so `e ^ 1` is the other end of e's stroke. The n-th "stroke" is not drawn: its
ends are home, 2n, and the free end, 2n + 1, which the last stroke hops to at no cost. It closes the ring:

    home, in, out, in, out, .., in, out, free

Hops lie at the places (0, 1), (2, 3) and so on: the partner of the end at place p in its hop is at p ^ 1.
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from app.drawing.order.cost import Array, HopCost

Ints = NDArray[np.int64]
Hop = tuple[int, int]
Undo = tuple[int, Ints]
"""Where a stretch of the ring starts, and what was there."""

STREWN_MM = 1e-6


class Ends:
    """Where the ends are, what it costs to hop between them, and which are near."""

    def __init__(self, strokes: Sequence[Array], home: tuple[float, float], hop_cost: HopCost):
        ends = [point for stroke in strokes for point in (stroke[0], stroke[-1])]
        self.points = np.array([*ends, home, (math.inf, math.inf)], dtype=float)
        """(2n + 2, 2) mm; the free end is infinitely far, see `HopCost.seconds`."""
        self.hop_cost = hop_cost
        # Where many ends coincide, all would have the same few of them as their neighbours: strew them a little.
        strewn = np.random.default_rng(0).uniform(-STREWN_MM, STREWN_MM, (len(ends) + 1, 2))
        self.strewn = self.points[:-1] + strewn
        """(2n + 1, 2) mm; to look for neighbours."""

    def seconds(self, a: Ints, b: Ints) -> Array:
        """Of the hops between the ends a and b."""
        return self.hop_cost.seconds(np.hypot(*np.moveaxis(self.points[a] - self.points[b], -1, 0)))

    def near(self, count: int) -> tuple[Ints, Array]:
        """For each end the nearest ends of other strokes and the seconds to get there: two (2n + 2, count) arrays.

        Where there are no more, and for the free end, the seconds are infinite.
        """
        size = len(self.points)
        index, seconds = np.zeros((size, count), dtype=int), np.full((size, count), np.inf)
        _, found = KDTree(self.strewn).query(self.strewn, k=min(count + 2, size - 1))
        own = found >> 1 == np.arange(size - 1)[:, None] >> 1
        last = np.argsort(own, axis=1, kind="stable")[:, :count]
        wide = last.shape[1]
        index[:-1, :wide] = np.take_along_axis(found, last, 1)
        to_get_there = self.seconds(np.arange(size - 1)[:, None], index[:-1, :wide])
        seconds[:-1, :wide] = np.where(np.take_along_axis(own, last, 1), np.inf, to_get_there)
        return index, seconds


class Tour:
    """A ring of ends in which hops can be exchanged, and the exchange taken back.

    Each of the two sequences is there twice over the same memory: single numbers are faster to read from an `array`,
    long stretches faster to move with NumPy.
    """

    def __init__(self, ring: Sequence[int]):
        self.ring = array("q", ring)
        """The end at each place."""
        self.place = array("q", bytes(8 * len(ring)))
        """Of each end."""
        self.rings = np.frombuffer(self.ring, dtype=np.int64)
        self.places = np.frombuffer(self.place, dtype=np.int64)
        self.places[self.rings] = np.arange(len(ring))

    @classmethod
    def as_given(cls, strokes: int) -> Tour:
        """Home, then so many strokes in their order, each forwards."""
        return cls([2 * strokes, *range(2 * strokes), 2 * strokes + 1])

    def partner(self, end: int) -> int:
        """The other end of its hop."""
        return self.ring[self.place[end] ^ 1]

    def entries(self) -> list[int]:
        """The end at which each stroke is entered, from home on."""
        home = self.place[len(self.ring) - 2]
        ring = np.roll(self.rings, -home) if home & 1 == 0 else np.roll(self.rings[::-1], home + 1)
        return ring[1:-1:2].tolist()

    def exchange(self, hops: Sequence[Hop]) -> Undo | None:
        """Make these the hops of all their ends, if the ring stays one; the longest stretch between stays in place."""
        place, size = self.place, len(self.ring)
        mate = {place[a]: place[b] for a, b in hops}
        mate |= {there: here for here, there in mate.items()}
        lefts = sorted(here for here in mate if not here & 1)
        rights = [*lefts[1:], lefts[0] + size]
        lengths = [right - left for left, right in zip(lefts, rights, strict=True)]
        fixed = lengths.index(max(lengths))
        first = {here + 1: k for k, here in enumerate(lefts)}
        last = {here % size: k for k, here in enumerate(rights)}
        start = here = rights[fixed] % size
        stretches = []
        for _ in lefts[1:]:
            here = mate[here]
            forwards = here in first
            k = first[here] if forwards else last[here]
            if k == fixed:
                return None
            stretches.append((lefts[k] + 1, rights[k] + 1, forwards))
            here = rights[k] % size if forwards else lefts[k] + 1
        return self._put(start + 1, np.concatenate([self._stretch(*stretch) for stretch in stretches]))

    def restore(self, undo: Undo) -> None:
        """Take back the last exchange that has not been taken back."""
        self._put(*undo)

    def _stretch(self, start: int, stop: int, forwards: bool = True) -> Ints:
        """Of the ring, around its end if need be."""
        ends = self.rings[start:stop]
        if stop > len(self.rings):
            ends = np.concatenate([ends, self.rings[: stop - len(self.rings)]])
        return ends if forwards else ends[::-1]

    def _put(self, start: int, new: Ints) -> Undo:
        """Write over the ring from a place on, around its end if need be."""
        old = self._stretch(start, start + len(new)).copy()
        room = len(self.rings) - start
        for first, part in ((start, new[:room]), (0, new[room:])):
            self.rings[first : first + len(part)] = part
            self.places[part] = np.arange(first, first + len(part))
        return start, old


def in_order(strokes: Sequence[Array], tour: Tour) -> list[Array]:
    """The strokes as the tour meets them, reversed where it enters them at their end."""
    return [strokes[end // 2] if end % 2 == 0 else strokes[end // 2][::-1].copy() for end in tour.entries()]
