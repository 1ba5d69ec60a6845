"""Anything recorded or planned, played on the robot: play, pause, scrub, speed. No widgets here."""

from __future__ import annotations

import asyncio
import math
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from app.signal import Signal
from app.simulation import Run
from app.ui.session import Session

FRAME_S = 0.05
SPEEDS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
PLEASANT_S = 12.0
"""A run is first played at the speed at which it takes about this long."""


class Playable(Protocol):
    """Where the robot is at k moments: a run of the control lab, or the track of a drawing."""

    @property
    def t(self) -> NDArray[np.float64]:
        """(k,) s, from 0"""
        ...

    @property
    def pose(self) -> NDArray[np.floating[Any]]:
        """(k, dof) m and rad"""
        ...

    @property
    def q(self) -> NDArray[np.floating[Any]]:
        """(k, n) rad or m"""
        ...


# a run satisfies the protocol, but pyright does not see it, since its pose is a cached property
Played: TypeAlias = Playable | Run


class Playback:
    """Moves the robot along a run. Somebody who moves the robot otherwise pauses it."""

    def __init__(self, session: Session) -> None:
        self.moved: Signal[float] = Signal()
        """The time shown, s."""
        self.playing_changed: Signal[bool] = Signal()
        self.loaded: Signal[Played | None] = Signal()
        """Something else is to be played, or nothing."""
        self._session = session
        self._run: Played | None = None
        self._task: asyncio.Task[None] | None = None
        self._showing = False
        self._halt_s = math.inf
        self.time_s = 0.0
        self.speed = 1.0
        self.repeats = False
        """Whether it begins again at the end."""
        session.stance_changed.connect(lambda _: self._give_way())

    @property
    def playing(self) -> bool:
        return self._task is not None

    @property
    def halting(self) -> bool:
        """Whether it plays only to a time that was asked for."""
        return self.playing and self._halt_s < math.inf

    @property
    def run(self) -> Played | None:
        return self._run

    @property
    def duration_s(self) -> float:
        return 0.0 if self._run is None else float(self._run.t[-1])

    def load(self, run: Played | None, speed: float | None = None) -> None:
        """Take a run, at its beginning; it does not play yet. Without a speed it gets a pleasant one."""
        self.pause()
        self._run = run
        self.time_s = 0.0
        if run is not None:
            self.speed = _pleasant_speed(self.duration_s) if speed is None else speed
        self.loaded.emit(run)
        if run is not None:
            self.moved.emit(0.0)

    def play(self) -> None:
        """Go on, or begin again at the end."""
        if self._run is None or self.playing:
            return
        if self.time_s >= self.duration_s - 1e-9:
            self.time_s = 0.0
        self._task = asyncio.get_running_loop().create_task(self._march())
        self.playing_changed.emit(True)

    def pause(self) -> None:
        """Stand still at once."""
        if self._task is not None:
            self._task.cancel()
            self._came_to_rest()

    def halt_at(self, time_s: float | None) -> None:
        """While playing: go on to this time and stop there. None: to the end after all."""
        self._halt_s = math.inf if time_s is None else max(time_s, self.time_s)

    def seek(self, time_s: float) -> None:
        """Show one instant."""
        self.time_s = time_s
        self._show()

    async def _march(self) -> None:
        loop = asyncio.get_running_loop()
        last = loop.time()
        while self.time_s < self._until or self._goes_round:
            await asyncio.sleep(FRAME_S)
            now = loop.time()
            self.time_s += self.speed * (now - last)
            if self.time_s >= self._until:
                self.time_s = self.time_s % self.duration_s if self._goes_round else self._until
            last = now
            self._show()
        self._came_to_rest()

    @property
    def _goes_round(self) -> bool:
        return self.repeats and self._halt_s == math.inf and self.duration_s > 0.0

    @property
    def _until(self) -> float:
        return min(self._halt_s, self.duration_s)

    def _came_to_rest(self) -> None:
        self._task = None
        self._halt_s = math.inf
        self.playing_changed.emit(False)

    def _show(self) -> None:
        if self._run is None:
            return
        k = instant_at(self._run.t, self.time_s)
        self._showing = True
        self._session.replay(self._run.pose[k].tolist(), self._run.q[k].tolist())
        self._showing = False
        self.moved.emit(self.time_s)

    def _give_way(self) -> None:
        if not self._showing:
            self.pause()


def instant_at(t: NDArray[np.float64], time_s: float) -> int:
    """Index of the first of times t (k,) at or after this one; of the last where there is none."""
    return min(int(np.searchsorted(t, time_s)), len(t) - 1)


def _pleasant_speed(duration_s: float) -> float:
    return min(SPEEDS, key=lambda speed: abs(np.log(max(duration_s, 1e-3) / speed / PLEASANT_S)))
