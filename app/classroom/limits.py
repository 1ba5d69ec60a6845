"""How often something may be tried."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable

from app.recent import Recent

MINUTE_S = 60.0
REMEMBERED = 500
"""Whose tries are remembered; who drops his cookies is a new one each time, and meets the limit of all."""

Clock = Callable[[], float]


class Limit:
    """At most `each` times a minute for each key, and `together` for all of them."""

    def __init__(self, each: int, together: int, clock: Clock = time.monotonic) -> None:
        self._each = each
        self._together = together
        self._clock = clock
        self._by_key: Recent[str, deque[float]] = Recent(REMEMBERED)
        self._all: deque[float] = deque()

    def reached(self, key: str) -> bool:
        """Whether `key` has to wait."""
        mine = self._by_key.get(key) or deque()
        return self._count(mine) >= self._each or self._count(self._all) >= self._together

    def note(self, key: str) -> None:
        """It has happened once more."""
        mine = self._by_key.get(key) or deque()
        for times in (mine, self._all):
            times.append(self._clock())
        self._by_key.put(key, mine)

    def _count(self, times: deque[float]) -> int:
        while times and self._clock() - times[0] >= MINUTE_S:
            times.popleft()
        return len(times)
