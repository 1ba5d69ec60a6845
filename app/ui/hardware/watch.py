"""Looks at the link for all rooms, while anybody wants to know. Everything runs on the event loop."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from app.ui.hardware.history import History

if TYPE_CHECKING:
    from app.link.status import LinkStatus

PERIOD_S = 0.05
IDLE_S = 0.2
"""The same without a robot."""

Listener = Callable[["LinkStatus"], None]

_log = logging.getLogger(__name__)


class Watch:
    """Tells its listeners 20 times a second how things are, without a robot 5 times."""

    def __init__(self, read: Callable[[], LinkStatus]) -> None:
        self._read = read
        self._listeners: list[Listener] = []
        self._task: asyncio.Task[None] | None = None
        self._seen: tuple[Any, ...] = ()
        self.edition = 0
        """Grows when something changes that is not merely a motion."""
        self.history = History()

    def attend(self, listener: Listener) -> Callable[[], None]:
        """Begin to tell a listener; what is returned ends it."""
        self._listeners.append(listener)
        if self._task is None:
            self._task = asyncio.get_running_loop().create_task(self._look())

        def leave() -> None:
            if listener in self._listeners:
                self._listeners.remove(listener)

        return leave

    async def _look(self) -> None:
        while self._listeners:
            status = self._read()
            self._remember(status)
            for listener in tuple(self._listeners):
                _tell(listener, status)
            await asyncio.sleep(IDLE_S if status.phase == "none" else PERIOD_S)
        self._task = None

    def _remember(self, status: LinkStatus) -> None:
        seen = _noticeable(status)
        if seen != self._seen:
            self._seen = seen
            self.edition += 1
        if status.telemetry is not None:
            self.history.append(status.telemetry, time.monotonic())
        else:
            self.history.clear()


def _noticeable(status: LinkStatus) -> tuple[Any, ...]:
    """Everything but numbers that change while the robot moves."""
    telemetry, log = status.telemetry, status.log
    board = () if telemetry is None else (telemetry.state, telemetry.flags, telemetry.fault, telemetry.fault_joint)
    who = (status.holder, status.queue, status.activity, status.program_title, status.override)
    link = (status.phase, status.sentence, status.port, status.identity, status.robot, status.settings)
    return (*link, *who, *board, log[-1:], len(log), status.recording_s > 0.0)


def _tell(listener: Listener, status: LinkStatus) -> None:
    try:
        listener(status)
    except Exception:  # one room's trouble is not the others'
        _log.exception("a room could not follow the link")
