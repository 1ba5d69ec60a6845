"""Look again soon, but not more often than need be."""

from __future__ import annotations

import asyncio
from collections.abc import Callable


class Pulse:
    """Calls `look` some time after the first of any number of nudges; on the event loop.

    `later(delay_s, callback)` starts a timer that can be cancelled; tests bring their own.
    """

    def __init__(
        self,
        look: Callable[[], None],
        period_s: float,
        later: Callable[[float, Callable[[], None]], asyncio.TimerHandle] | None = None,
    ) -> None:
        self._look = look
        self._period_s = period_s
        self._later = later or (lambda delay, call: asyncio.get_running_loop().call_later(delay, call))
        self._timer: asyncio.TimerHandle | None = None

    def nudge(self) -> None:
        if self._timer is None:
            self._timer = self._later(self._period_s, self._beat)

    def stop(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _beat(self) -> None:
        self._timer = None
        self._look()
