"""Fewer calls than events: panels need not follow a drag at its full rate. Everything runs on the event loop."""

from __future__ import annotations

import asyncio
from collections.abc import Callable


class Paced:
    """Calls a function at most once an interval; the last of a burst of events is never lost."""

    def __init__(self, act: Callable[[], None], interval_s: float) -> None:
        self._act = act
        self._interval_s = interval_s
        self._timer: asyncio.TimerHandle | None = None
        self._due = False

    def request(self) -> None:
        """Act now, or at the end of the running interval."""
        if self._timer is None:
            self._run()
        else:
            self._due = True

    def cancel(self) -> None:
        """Drop what is still due."""
        self._due = False
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _run(self) -> None:
        self._timer = asyncio.get_running_loop().call_later(self._interval_s, self._elapsed)
        self._act()

    def _elapsed(self) -> None:
        self._timer = None
        if self._due:
            self._due = False
            self._run()
