"""The runs of one browser: asked for, computed by a worker, kept to compare. No widgets here."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from weakref import WeakKeyDictionary

from app.robots import Robot
from app.signal import Signal
from app.simulation import Run
from app.ui.compute import Worker
from app.ui.lab.jobs import run_robot
from app.ui.lab.settings import ControlSettings
from app.ui.refusal import Refusal
from app.ui.session import Session

KEPT = 8
"""Runs that are kept; the oldest is forgotten first. Each takes about 2 MB."""


class RunBook:
    """Which runs there are, and which one is shown."""

    def __init__(self, session: Session, worker: Worker, tell: Callable[[str], None]) -> None:
        self.selected: Signal[Run | None] = Signal()
        """Another run is to be shown, or none."""
        self.finished: Signal[Run] = Signal()
        """All runs that were asked for are there; this is the last one."""
        self.busy_changed: Signal[bool] = Signal()
        self._session = session
        self._worker = worker
        self._tell = tell
        self._wanted: deque[ControlSettings] = deque()
        self.runs: list[Run] = []
        self.run: Run | None = None
        self.busy = False
        self._computing: ControlSettings | None = None
        self._asked: WeakKeyDictionary[Run, ControlSettings] = WeakKeyDictionary()
        session.robot_changed.connect(self._follow_robot)

    def request(self, *experiments: ControlSettings) -> None:
        """Compute these one after the other; what was asked before and is not done yet is dropped."""
        self._wanted = deque(experiments)
        self._next()

    def cancel(self) -> None:
        """Drop what is being computed."""
        self._wanted.clear()
        self._worker.cancel()
        self._set_busy(False)

    def failed(self) -> None:
        """The worker could not do it, and has said so."""
        self._wanted.clear()
        self._set_busy(False)

    def asked(self, run: Run) -> ControlSettings:
        """What was set for one of `runs`; gains of a tuning method are those from before it was applied."""
        return self._asked[run]

    def select(self, run: Run | None) -> None:
        self.run = run
        self.selected.emit(run)

    def clear(self) -> None:
        """Forget every run."""
        self.cancel()
        self.runs = []
        self.select(None)

    def _next(self) -> None:
        if not self._wanted:
            self._set_busy(False)
            return
        self._set_busy(True)
        self._computing = self._wanted.popleft()
        self._worker.request(self._receive, run_robot, self._computing, dict(self._session.dimensions))

    def _receive(self, result: Run | Refusal) -> None:
        if isinstance(result, Refusal):
            self._wanted.clear()
            self._tell(result.reason)
            self._set_busy(False)
            return
        assert self._computing is not None
        self._asked[result] = self._computing
        self.runs = [*self.runs, result][-KEPT:]
        self.select(result)
        self._next()
        if not self.busy:
            self.finished.emit(result)

    def _set_busy(self, busy: bool) -> None:
        if busy != self.busy:
            self.busy = busy
            self.busy_changed.emit(busy)

    def _follow_robot(self, robot: Robot) -> None:
        """Runs belong to a robot of certain dimensions; those of another cannot be played on it."""
        if self.runs or self.busy:
            self.clear()
