"""A token bucket: a steady rate, with room for a burst."""

from __future__ import annotations

import time
from collections.abc import Callable


class TokenBucket:
    """`rate` tokens a second flow in, up to `burst`; whoever takes more than there are has to wait.

    `clock` returns seconds.
    """

    def __init__(self, rate: float, burst: float, clock: Callable[[], float] = time.monotonic) -> None:
        if rate <= 0 or burst <= 0:
            raise ValueError(f"A token bucket needs a positive rate and burst, not {rate:g} and {burst:g}.")
        self.rate = rate
        self.burst = burst
        self._clock = clock
        self._tokens = burst
        self._filled_at = clock()

    def take(self, tokens: float = 1.0) -> float:
        """Take tokens, on credit where too few are left; returns the seconds to wait until they are paid."""
        now = self._clock()
        self._tokens = min(self.burst, self._tokens + self.rate * (now - self._filled_at)) - tokens
        self._filled_at = now
        return max(0.0, -self._tokens / self.rate)
