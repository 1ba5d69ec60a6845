"""One step of iterated local search: disturb the order in one place, repair it, take it back if it is worse.

The disturbance swaps short runs of strokes (a double bridge); the repair exchanges two or three hops at a time, as in
`moves`, but around the disturbed place only and in plain Python numbers, which is faster for so few.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random

from app.drawing.order.moves import EPS, new_hops
from app.drawing.order.tour import Ends, Hop, Tour, Undo

NEAR = 14
"""Ends to which an end may get a hop."""
REACH = 5
"""Strokes in each of the runs that a disturbance moves, at most."""


class Search:
    """Steps from one order to the next, which `tour` has."""

    def __init__(self, ends: Ends, random: Random):
        self.tour = Tour.as_given(len(ends.points) // 2 - 1)
        self._seconds = _seconds_between(ends)
        near = zip(*(table.tolist() for table in ends.near(NEAR)), strict=True)
        self._near = [[(end, s) for end, s in zip(*row, strict=True) if s < math.inf] for row in near]
        self._random = random.random

    def step(self) -> bool:
        """Disturb and repair; whether the order has become better. It never becomes worse."""
        hops = self._double_bridge()
        todo = [end for hop in hops for end in hop]
        before = sum(self._seconds(end, self.tour.partner(end)) for end in todo) / 2
        undo = self.tour.exchange(hops)
        assert undo, "a double bridge leaves one ring"
        done = [undo]
        gain = before - sum(self._seconds(*hop) for hop in hops) + self._repair(todo, done)
        if gain < 0.0:
            while done:
                self.tour.restore(done.pop())
        return gain > EPS

    def _double_bridge(self) -> tuple[Hop, Hop, Hop, Hop]:
        """Three short runs of strokes, one after the other: 1 2 3 becomes 3 2 1, none of them reversed."""
        ring = self.tour.ring
        hops = len(ring) // 2
        reach = min(REACH, (hops - 1) // 3)
        k = int(self._random() * hops)
        ends = []
        for _ in range(4):
            ends += (ring[2 * k], ring[2 * k + 1])
            k = (k + 1 + int(self._random() * reach)) % hops
        return (ends[0], ends[5]), (ends[6], ends[3]), (ends[4], ends[1]), (ends[2], ends[7])

    def _repair(self, todo: list[int], done: list[Undo]) -> float:
        """Exchange hops at the ends to do while that saves time; returns the seconds saved, and notes what was done."""
        saved = 0.0
        waiting = set(todo)
        while todo:
            end = todo.pop()
            waiting.discard(end)
            gain, undo, touched = self._exchange_at(end)
            if undo:
                saved += gain
                done.append(undo)
                todo += [each for each in touched if each not in waiting]
                waiting.update(touched)
        return saved

    def _exchange_at(self, a: int) -> tuple[float, Undo | None, list[int]]:
        """The best exchange of two or three hops that gives up a's hop: seconds saved, how to undo it, its ends."""
        ring, place, near, seconds = self.tour.ring, self.tour.place, self._near, self._seconds
        b = ring[place[a] ^ 1]
        found: list[tuple[float, list[int]]] = []
        given_up = seconds(a, b)
        for c, hop in near[b]:
            if hop >= given_up:
                break
            d = ring[place[c] ^ 1]
            gain = given_up - hop + seconds(c, d)
            if (place[b] ^ place[c]) & 1 == 0 and (two := gain - seconds(d, a)) > EPS:
                found.append((two, [a, b, c, d]))
            for e, hop in near[d]:
                if hop >= gain - EPS:
                    break
                f = ring[place[e] ^ 1]
                three = gain - hop + seconds(e, f) - seconds(f, a)
                if three > EPS and e != a and e != b and e != c:
                    found.append((three, [a, b, c, d, e, f]))
        for gain, chain in sorted(found, reverse=True):
            if undo := self.tour.exchange(new_hops(chain)):
                return gain, undo, chain
        return 0.0, None, []


def _seconds_between(ends: Ends) -> Callable[[int, int], float]:
    """As `Ends.seconds`, for one hop in plain numbers."""
    points = [complex(x, y) for x, y in ends.points.tolist()]
    lift, pace, touch = ends.hop_cost.lift_s, 1.0 / ends.hop_cost.speed_mm_s, ends.hop_cost.touch_mm

    def seconds(a: int, b: int) -> float:
        mm = abs(points[a] - points[b])
        return lift + pace * mm if touch < mm < math.inf else 0.0

    return seconds
