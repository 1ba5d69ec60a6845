"""What happened, in sentences."""

from __future__ import annotations

import math

from app.link.status import LogLine

KEPT = 100
FRESH_S = 8.0
"""The newest sentence is shown beside the state for so long."""


class Diary:
    """The last 100 sentences."""

    def __init__(self) -> None:
        self.lines: tuple[LogLine, ...] = ()
        self._said: dict[str, float] = {}

    def write(self, sentence: str, now: float) -> None:
        self.lines = (*self.lines, LogLine(now, sentence))[-KEPT:]

    def write_seldom(self, topic: str, sentence: str, now: float, every_s: float = 10.0) -> None:
        """Not more often than `every_s` for one topic."""
        if now - self._said.get(topic, -math.inf) >= every_s:
            self._said[topic] = now
            self.write(sentence, now)

    def fresh(self, now: float) -> str:
        """The newest sentence if it is new, else nothing."""
        return self.lines[-1].sentence if self.lines and now - self.lines[-1].time_s < FRESH_S else ""
