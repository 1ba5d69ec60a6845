"""Any recorded run, played on the robot: play, pause, scrub, speed. No widgets here."""

from __future__ import annotations

import asyncio

import numpy as np

from app.simulation import Run
from app.ui.session import Session, Signal

FRAME_S = 0.05
SPEEDS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
PLEASANT_S = 12.0
"""A run is first played at the speed at which it takes about this long."""


class Playback:
    """Moves the robot along a run. Somebody who moves the robot otherwise pauses it."""

    def __init__(self, session: Session) -> None:
        self.moved: Signal[float] = Signal()
        """The time shown, s."""
        self.playing_changed: Signal[bool] = Signal()
        self._session = session
        self._run: Run | None = None
        self._task: asyncio.Task[None] | None = None
        self._showing = False
        self.time_s = 0.0
        self.speed = 1.0
        session.stance_changed.connect(lambda _: self._give_way())

    @property
    def playing(self) -> bool:
        return self._task is not None

    @property
    def run(self) -> Run | None:
        return self._run

    def load(self, run: Run | None) -> None:
        """Take a run, at its beginning; it does not play yet."""
        self.pause()
        self._run = run
        self.time_s = 0.0
        if run is not None:
            self.speed = min(SPEEDS, key=lambda speed: abs(np.log(run.t[-1] / speed / PLEASANT_S)))
            self.moved.emit(0.0)

    def play(self) -> None:
        """Go on, or begin again at the end."""
        if self._run is None or self.playing:
            return
        if self.time_s >= self._run.t[-1] - 1e-9:
            self.time_s = 0.0
        self._task = asyncio.get_running_loop().create_task(self._march())
        self.playing_changed.emit(True)

    def pause(self) -> None:
        if self._task is not None:
            self._task.cancel()
            self._task = None
            self.playing_changed.emit(False)

    def seek(self, time_s: float) -> None:
        """Show one instant."""
        self.time_s = time_s
        self._show()

    async def _march(self) -> None:
        loop = asyncio.get_running_loop()
        last = loop.time()
        while self._run is not None and self.time_s < self._run.t[-1]:
            await asyncio.sleep(FRAME_S)
            now = loop.time()
            self.time_s = min(self.time_s + self.speed * (now - last), float(self._run.t[-1]))
            last = now
            self._show()
        self._task = None
        self.playing_changed.emit(False)

    def _show(self) -> None:
        if self._run is None:
            return
        k = min(int(np.searchsorted(self._run.t, self.time_s)), len(self._run.t) - 1)
        self._showing = True
        self._session.replay(self._run.pose[k].tolist(), self._run.q[k].tolist())
        self._showing = False
        self.moved.emit(self.time_s)

    def _give_way(self) -> None:
        if not self._showing:
            self.pause()
