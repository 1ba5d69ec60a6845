"""How long a set-point takes until the board's telemetry names it."""

from __future__ import annotations

from collections import deque
from statistics import quantiles

KEPT = 200


class RoundTrips:
    """The newest 200 round trips. Telemetry comes every 20 ms, which is part of what is measured."""

    def __init__(self) -> None:
        self._sent: dict[int, float] = {}
        self._trips_s: deque[float] = deque(maxlen=KEPT)
        self.median_ms = float("nan")
        self.p95_ms = float("nan")

    @property
    def last_s(self) -> float | None:
        return self._trips_s[-1] if self._trips_s else None

    def sent(self, number: int, now: float) -> None:
        """A set-point with this number was written."""
        if len(self._sent) >= KEPT:
            self._sent.clear()  # nothing comes back
        self._sent[number] = now

    def named(self, number: int, now: float) -> None:
        """Telemetry named this number; only the first time counts, and older ones will not be named any more."""
        sent = self._sent.get(number)
        if sent is None:
            return
        self._sent = {other: time for other, time in self._sent.items() if time > sent}
        self._trips_s.append(now - sent)
        if len(self._trips_s) >= 2:
            cuts = quantiles(self._trips_s, n=20, method="inclusive")
            self.median_ms, self.p95_ms = 1e3 * cuts[9], 1e3 * cuts[18]
