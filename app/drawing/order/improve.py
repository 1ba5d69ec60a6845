"""Improving an order for as long as there is time (iterated local search), in steps that can go on anywhere."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from app.drawing.order.cost import DEFAULT_COST, HOME, Array, HopCost, pen_up_mm, pen_up_s
from app.drawing.order.moves import EPS
from app.drawing.order.reseat import begun_at, is_closed
from app.drawing.order.search import Search
from app.drawing.order.settle import settled
from app.drawing.order.tour import Ends, in_order

PATIENCE = 30
"""Steps in vain for each stroke, after which it is time to stop."""
ROUND = 200
"""Steps before closed strokes are begun elsewhere, at least."""
BEGUN_ELSEWHERE = 5
"""Closed strokes at once."""

Progress = Callable[[float], object]
"""Called now and then with the share of the time that is over; returning False stops the work."""


@dataclass
class Improvement:
    """An order on its way to a better one. Plain data: send it to another process, improve it there, send it back."""

    strokes: list[Array]
    """In their order. The arrays are never changed, only replaced."""
    home: tuple[float, float] = HOME
    hop_cost: HopCost = DEFAULT_COST
    seed: int = 0
    steps: int = 0
    """So far."""
    idle: int = 0
    """The last steps, which have brought nothing."""

    @property
    def pen_up_mm(self) -> float:
        return pen_up_mm(self.strokes, self.home)

    @property
    def pen_up_s(self) -> float:
        return pen_up_s(self.strokes, self.home, self.hop_cost)

    @property
    def finished(self) -> bool:
        """More time would hardly bring anything."""
        return len(self.strokes) < 3 or self.idle > PATIENCE * len(self.strokes)

    def improve(self, seconds: float = math.inf, *, steps: float = math.inf, progress: Progress | None = None) -> None:
        """Work until the seconds or the steps are over, it is finished, or `progress` returns False.

        The order never becomes slower. It repeats for the same number of steps, not of seconds. Every call has to
        prepare, which takes 20 ms for 500 strokes and a second for 20 000.
        """
        start, last = time.perf_counter(), self.steps + steps

        def go_on() -> bool:
            share = (time.perf_counter() - start) / seconds if seconds else 1.0
            return share < 1.0 and not (progress and progress(share) is False)

        while self.steps < last and not self.finished and self._round(last, go_on):
            self._begin_elsewhere(go_on)

    def _round(self, last: float, go_on: Callable[[], bool]) -> bool:
        """Some steps; False if it is time to stop."""
        search = Search(Ends(self.strokes, self.home, self.hop_cost), self._random())
        last = min(last, self.steps + max(ROUND, len(self.strokes)))
        while (going := self.steps % 10 > 0 or go_on()) and self.steps < last:
            self.idle = 0 if search.step() else self.idle + 1
            self.steps += 1
        self.strokes = in_order(self.strokes, search.tour)
        return going

    def _begin_elsewhere(self, go_on: Callable[[], bool]) -> None:
        """Begin some closed strokes at any of their points, and see whether a better order comes of that."""
        closed = [k for k, stroke in enumerate(self.strokes) if is_closed(stroke)]
        if not closed:
            return
        random = self._random()
        trial = list(self.strokes)
        for k in random.sample(closed, min(BEGUN_ELSEWHERE, len(closed))):
            trial[k] = begun_at(trial[k], random.randrange(len(trial[k]) - 1))
        trial = settled(trial, self.home, self.hop_cost, go_on)
        if pen_up_s(trial, self.home, self.hop_cost) < self.pen_up_s - EPS:
            self.strokes, self.idle = trial, 0

    def _random(self) -> Random:
        return Random(f"{self.seed} {self.steps}")
