"""Pulses of one joint, one after another; then all of them together."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence

from app.link.protocol.messages import Test
from app.link.twin.recording import Recording
from app.ui.hardware.desk import HardwareDesk


class PulseSeries:
    """A pulse that is refused ends the series; the desk tells why."""

    def __init__(self, desk: HardwareDesk, done: Callable[[list[Recording]], None], failed: Callable[[], None]) -> None:
        self._desk = desk
        self._done = done
        self._failed = failed
        self._waiting: deque[Test] = deque()
        self._recordings: list[Recording] = []

    def start(self, pulses: Sequence[Test]) -> None:
        self._waiting = deque(pulses)
        self._recordings = []
        self._next()

    def _next(self) -> None:
        if self._waiting:
            desk = self._desk
            desk.ask(desk.link.test(desk.me, self._waiting.popleft()), self._receive, self._failed)
        else:
            self._done(self._recordings)

    def _receive(self, recording: Recording) -> None:
        self._recordings.append(recording)
        self._next()
