"""The newest recording beside what the simulated twin makes of the same set-points. No widgets here."""

from __future__ import annotations

from collections.abc import Callable

from app.link.twin.compare import TwinComparison
from app.link.twin.recording import Recording
from app.signal import Signal
from app.ui.compute import Worker
from app.ui.hardware import jobs
from app.ui.hardware.desk import HardwareDesk
from app.ui.refusal import Refusal


class TwinDesk:
    """The state behind the comparison in the panel `Record`."""

    def __init__(self, desk: HardwareDesk, hire: Callable[[Callable[[], None]], Worker]) -> None:
        """
        Args:
            hire: makes a worker; what it is given hears of failures.
        """
        self.busy_changed: Signal[bool] = Signal()
        self.answered: Signal[TwinComparison] = Signal()
        self.result: TwinComparison | None = None
        """Of the newest recording."""
        self._desk = desk
        self._worker = hire(lambda: self.busy_changed.emit(False))
        desk.recorded.connect(self._forget)

    def compare(self) -> None:
        """Lay the newest recording beside its twin."""
        desk, recording = self._desk, self._desk.recording
        if recording is None:
            return
        motor = desk.session.control.motor if desk.session.control else None
        same = desk.session.robot_name == recording.robot
        arguments = (recording, desk.status.identity, dict(desk.status.settings), motor if same else None)
        self.busy_changed.emit(True)
        self._worker.request(self._receive, jobs.compare_with_twin, *arguments)

    def _receive(self, result: TwinComparison | Refusal) -> None:
        self.busy_changed.emit(False)
        if isinstance(result, Refusal):
            self._desk.tell(result.reason)
            return
        self.result = result
        self.answered.emit(result)

    def _forget(self, _: Recording) -> None:
        self.result = None
