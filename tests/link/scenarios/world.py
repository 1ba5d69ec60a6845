"""What a scenario plays in: a board, a cable, the link and the people who use it."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import ExitStack
from dataclasses import replace
from typing import Any

import numpy as np

from app.link.errors import LinkError
from app.link.lease import Person
from app.link.link import RobotLink
from app.link.programs import Jog, Program
from app.link.status import LinkStatus
from app.link.transport import open_transport
from tests.link.scenarios.machines import BoardOnStage, board_on_stage
from tests.support.cable import Cable

ANSWER_S = 4.0
RENEW_S = 0.05
TURN_MS = 5
MEMORY_S = 3.0


class Clock:
    """The time of a scenario on a board in this process: it passes when somebody waits."""

    def __init__(self) -> None:
        self.now_s = 0.0

    def __call__(self) -> float:
        return self.now_s


class World:
    """Everything that a line of a script can reach. To be closed."""

    def __init__(self, board: str) -> None:
        self._cleanup = ExitStack()
        self.board: BoardOnStage = self._cleanup.enter_context(board_on_stage(board))
        self.cable = Cable(self.board.open)
        self._cleanup.callback(self.cable.close)
        self.now = time.monotonic if self.board.live else Clock()
        port = open_transport if self.board.live else self.cable.open_counted
        self.link = RobotLink(self.now, port, threaded=self.board.live)
        self._cleanup.callback(self.link.close)
        self.refusal = ""
        """Of the last line, in the words that a person would read."""
        self._finger: tuple[Person, Jog] | None = None
        self._renew_s = 0.0
        self._seen: deque[tuple[float, tuple[float, ...]]] = deque()

    def close(self) -> None:
        self._cleanup.close()

    def pass_time(self, seconds: float) -> None:
        """Everything goes on for so long."""
        end = self.now() + seconds
        while self.now() < end - 1e-9:
            self._turn()

    def _turn(self) -> None:
        """Five milliseconds of the world, or what of it is not done by others."""
        for _ in range(TURN_MS):
            self.cable.carry(self.now())
            if isinstance(self.now, Clock):
                self.board.advance(1)
                self.now.now_s += 1e-3
            else:
                time.sleep(1e-3)
        if isinstance(self.now, Clock):
            self.link.turn()
        self._watch()
        if self._finger and self.now() >= self._renew_s:
            self._renew_s = self.now() + RENEW_S
            self.link.jog(*self._finger)

    @property
    def status(self) -> LinkStatus:
        return self.link.status

    @property
    def linear(self) -> bool:
        """Joints in mm instead of degrees."""
        return self.status.robot is not None and self.status.robot.joint_units[0] == "m"

    @property
    def per_unit(self) -> float:
        """rad or m for what a script calls deg or mm."""
        return 1e-3 if self.linear else math.radians(1.0)

    def person(self, name: str, instructor: bool = False) -> Person:
        return Person(name.lower(), name, instructor)

    def ask(self, question: Callable[[], Future[Any]]) -> None:
        """Wait for an answer; a refusal is kept for the next lines to look at."""
        answer = question()
        if not self.until(answer.done, ANSWER_S):
            self.refusal = "no answer"
        elif error := answer.exception():
            assert isinstance(error, LinkError), error
            self.refusal = str(error)

    def disturb(self, **faults: float) -> None:
        """Change what is wrong with the cable."""
        self.cable.faults = replace(self.cable.faults, **faults)  # type: ignore[arg-type]

    def hold(self, person: Person, jog: Jog) -> None:
        """A finger on a jog button: the page renews it every 50 ms."""
        self._finger, self._renew_s = (person, jog), 0.0

    def let_go(self) -> None:
        """The page does not renew any more, as when it hangs."""
        self._finger = None

    def wave(self, amplitude: float, duration_s: float, laser: float = 0.0) -> Program:
        """All joints up and down once from home, rad or m."""
        robot = self.status.robot
        assert robot is not None
        t = np.arange(0.0, duration_s, 0.005)
        bump = amplitude * np.sin(np.pi * t / duration_s) ** 2
        q = robot.inverse(robot.home) + bump[:, None]
        return Program("Wave", robot.name, t, q, np.ones(len(t), dtype=bool), np.full(len(t), laser))

    def until(self, met: Callable[[], bool], seconds: float) -> bool:
        """Whether it comes true in time."""
        deadline = self.now() + seconds
        while not met():
            if self.now() > deadline:
                return False
            self._turn()
        return True

    def travel(self, seconds: float) -> float:
        """How far any joint moved within the last so many seconds, rad or m."""
        since = self.now() - seconds
        joints = np.array([q for t, q in tuple(self._seen) if t >= since])
        return float(np.ptp(joints, axis=0).max())

    def top_speed(self) -> float:
        """Greatest speed of a joint lately, over 0.1 s, rad/s or m/s."""
        seen = tuple(self._seen)
        t, q = np.array([at for at, _ in seen]), np.array([joints for _, joints in seen])
        later = np.searchsorted(t, t + 0.1)
        first = np.flatnonzero(later < len(t))
        last = later[first]
        return float(np.max(np.abs(q[last] - q[first]).max(axis=1) / (t[last] - t[first])))

    def _watch(self) -> None:
        self._seen.append((self.now(), self.board.joints()))
        while self.now() - self._seen[0][0] > MEMORY_S:
            self._seen.popleft()
