"""The whole page in this process, with an emulated robot on its table: tests see what the board does."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import contextmanager, suppress
from typing import Any

from app.errors import UserMistake
from app.link.lease import Person
from app.link.link import RobotLink
from app.link.programs import Jog
from app.link.protocol.codes import Flag, State
from app.link.status import LinkStatus
from app.ui.options import ServeOptions
from app.ui.server import Lab

JOG = Jog("joint", 0, 1, 0.3)
ADA = Person("ada", "Ada")
STEPS = {State.OFF: "enable", State.FAULT: "clear", State.STOPPED: "clear", State.HELD: "resume", State.READY: "home"}
"""What leads on from a state to a homed robot that stands."""


class RobotLab:
    """`url` serves the page; `link` is the one that its rooms share."""

    def __init__(self, lab: Lab) -> None:
        self.lab = lab
        self.url = f"http://127.0.0.1:{lab.server.get_port()}"

    @property
    def link(self) -> RobotLink:
        return self.lab.workshop.link

    @property
    def status(self) -> LinkStatus:
        return self.lab.workshop.status

    @property
    def state(self) -> State | None:
        telemetry = self.status.telemetry
        return None if telemetry is None else telemetry.state

    @property
    def setpoint(self) -> tuple[float, ...]:
        telemetry = self.status.telemetry
        return () if telemetry is None else telemetry.setpoint

    def on_the_loop(self, act: Callable[[], object]) -> None:
        """Do something to a room, as its own callbacks would."""
        self.lab.server.get_event_loop().call_soon_threadsafe(act)

    def connect(self, port: str) -> None:
        self.link.connect(port).result(20.0)
        wait(lambda: self.state is not None, "telemetry")

    def make_ready(self, person: Person = ADA) -> None:
        """Homed, standing, and hers."""
        self.link.request(person).result(5.0)
        for _ in range(60):
            self.link.alive(person)
            telemetry = self.status.telemetry
            if telemetry is not None and telemetry.state is State.READY and Flag.HOMED in telemetry.flags:
                return
            if telemetry is not None and telemetry.state in STEPS:
                with suppress(UserMistake):
                    getattr(self.link, STEPS[telemetry.state])(person).result(5.0)
            time.sleep(0.2)
        raise AssertionError(f"the robot never got ready: it is {self.state!r}")

    def start_jog(self, person: Person = ADA) -> None:
        """It moves for 125 ms more than the last call."""
        answer: Future[Any] = self.link.jog(person, JOG)
        with suppress(UserMistake):
            answer.result(5.0)


@contextmanager
def robot_lab(robot: str) -> Iterator[RobotLab]:
    """Served on any free port; nothing is connected yet."""
    lab = Lab(ServeOptions(port=0, robot=robot, open_browser=False, shadows=False))
    try:
        yield RobotLab(lab)
    finally:
        lab.close()


def wait(condition: Callable[[], Any], what: str, timeout_s: float = 20.0) -> None:
    """Poll until something is so."""
    end = time.monotonic() + timeout_s
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"no {what} within {timeout_s:g} s")
        time.sleep(0.01)
