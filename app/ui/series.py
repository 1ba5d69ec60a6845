"""Several jobs one after the other, with progress; they can be cancelled. No widgets here."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

from app.signal import Signal
from app.ui.compute import Worker

Job = tuple[Callable[..., Any], tuple[Any, ...]]
"""A plain function, and what it is called with."""


class Series:
    """One series at a time; results come one by one."""

    def __init__(self, worker: Worker) -> None:
        self.progressed: Signal[float] = Signal()
        """Share that is done, 0 to 1; 1 also when cancelled or failed."""
        self._worker = worker
        self._waiting: deque[Job] = deque()
        self._count = 0
        self._each: Callable[[Any], None] = lambda _: None

    @property
    def busy(self) -> bool:
        return self._count > 0

    def start(self, jobs: Sequence[Job], each: Callable[[Any], None]) -> None:
        """Run these; `each` gets every result. What ran before is dropped."""
        self._worker.cancel()
        self._waiting, self._count, self._each = deque(jobs), len(jobs), each
        self._next()

    def cancel(self) -> None:
        """Drop what is still to come."""
        self._worker.cancel()
        self._end()

    def failed(self) -> None:
        """The worker could not do it, and has said so."""
        self._end()

    def _next(self) -> None:
        if not self._waiting:
            self._end()
            return
        self.progressed.emit(1.0 - len(self._waiting) / self._count)
        job, arguments = self._waiting.popleft()
        self._worker.request(self._receive, job, *arguments)

    def _receive(self, result: Any) -> None:
        self._each(result)
        self._next()

    def _end(self) -> None:
        self._waiting.clear()
        self._count = 0
        self.progressed.emit(1.0)
