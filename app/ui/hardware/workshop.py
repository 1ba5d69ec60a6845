"""The robot on the table, as all rooms of one server share it: the link, who is who, and what has happened."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import Future
from typing import TYPE_CHECKING

from app.classroom.classroom import Classroom
from app.classroom.codes import random_pin
from app.ui.hardware.watch import Watch

if TYPE_CHECKING:
    from app.link.emulated.faults import Faults
    from app.link.emulated.table import Table
    from app.link.lease import Person
    from app.link.link import RobotLink
    from app.link.status import LinkStatus

ONLY_INSTRUCTOR = "Only the instructor chooses the port on this server: give the PIN under You."


class Workshop:
    """One a server. The link, and all that it needs, is loaded when somebody wants it."""

    def __init__(self, people: Classroom | None = None, *, local_only: bool = True) -> None:
        self.people = people or Classroom.in_memory()
        self.watch = Watch(lambda: self.status)
        self._local_only = local_only
        self._table: Table | None = None
        self._link: RobotLink | None = None
        self._making = threading.Lock()

    @property
    def link(self) -> RobotLink:
        with self._making:  # the command line and the first room may both want it first
            if self._link is None:
                from app.link.emulated.table import Table
                from app.link.link import RobotLink

                self._table = Table()
                self._link = RobotLink(open_port=self._table.open)
            return self._link

    @property
    def status(self) -> LinkStatus:
        """How things are; looking makes no link."""
        if self._link is not None:
            return self._link.status
        from app.link.status import LinkStatus

        return LinkStatus()

    def why_no_port(self, person: Person) -> str:
        """Why somebody may not connect and disconnect; empty if he may."""
        return "" if self._local_only or person.instructor else ONLY_INSTRUCTOR

    def connect_at_start(self, port: str, say: Callable[[str], None]) -> None:
        """Open a port from the command line; `say` hears, on another thread, how that went."""
        self.link.connect(port).add_done_callback(lambda answer: say(self._how(answer, port)))

    @property
    def faults(self) -> Faults | None:
        """What is wrong with the emulated board that is connected; None for a real one, or none at all."""
        return None if self._table is None else self._table.faults(self.status.port)

    def break_board(self, faults: Faults) -> None:
        """Give the emulated board these faults, if there is one."""
        if self._table is not None:
            self._table.break_board(self.status.port, faults)

    def warm_up(self) -> None:
        """Load what the tab Hardware needs, before somebody opens it."""
        import app.ui.hardware.room  # noqa: F401

    def close(self) -> None:
        if self._link is not None:
            self._link.close()

    def _how(self, answer: Future[None], port: str) -> str:
        error = answer.exception()
        return f"The robot on {port} is connected." if error is None else f"{error}"


CLASS_PIN_DIGITS = 6


def choose_pin(pin: str | None, *, serial: bool, local_only: bool, in_class: bool = False) -> str:
    """The instructor's PIN: as given, or a new one where one is needed; empty where nobody needs one."""
    if pin is not None:
        return pin
    if in_class:
        return random_pin(CLASS_PIN_DIGITS)
    return "" if local_only and not serial else random_pin()
