"""What the instructor does, and which student it is about. No widgets here.

Every deed is one of the classroom's, which looks again at who asks for it.
"""

from __future__ import annotations

import io
import time
import zipfile
from collections.abc import Callable
from concurrent.futures import Future
from typing import TYPE_CHECKING

from app.classroom.board import BoardRow, board
from app.classroom.errors import ClassroomRefusal
from app.classroom.export import events_csv, progress_csv
from app.classroom.people import Member, as_person
from app.link.lease import Person
from app.signal import Signal
from app.ui.classroom.hall import Hall
from app.ui.desks import Desks
from app.ui.hardware.workshop import Workshop

if TYPE_CHECKING:
    from app.link.status import LinkStatus

SURE_S = 8.0
"""What cannot be undone is done by a second press within this time."""


class InstructorDesk:
    """The state behind every panel of the instructor's page."""

    def __init__(self, hall: Hall, browser: str, workshop: Workshop, desks: Desks, tell: Callable[[str], None]) -> None:
        self.hall = hall
        self.classroom = hall.classroom
        self.browser = browser
        self.workshop = workshop
        self.tell = tell
        self.chosen_changed: Signal[Member | None] = Signal()
        self._desks = desks
        self._chosen = ""
        self._asked, self._asked_at = "", 0.0

    @property
    def chosen(self) -> Member | None:
        """The student whom the buttons are about."""
        return self.classroom.find(self._chosen) if self._chosen else None

    @property
    def me(self) -> Person:
        return self.classroom.person(self.browser)

    @property
    def status(self) -> LinkStatus:
        """Of the robot on the table."""
        return self.workshop.status

    def rows(self) -> tuple[BoardRow, ...]:
        """The board, who needs help first."""
        holder = self.status.holder
        return board(self.classroom, holder.key if holder is not None else "")

    def choose(self, member_id: str) -> None:
        """Let the buttons be about a student; about nobody if it was him already."""
        self._chosen = "" if member_id == self._chosen else member_id
        self._asked = ""
        self.chosen_changed.emit(self.chosen)

    def do(self, deed: Callable[[], object]) -> bool:
        """Do something; why it is not possible is told. Returns whether it was done."""
        try:
            deed()
        except ClassroomRefusal as refusal:
            self.tell(str(refusal))
            return False
        return True

    def sure(self, what: str) -> bool:
        """Whether a button that cannot be undone was pressed twice in a short time; the first press asks."""
        sure = self.asks(what)
        self._asked, self._asked_at = ("" if sure else what), time.monotonic()
        return sure

    def asks(self, what: str) -> bool:
        """Whether a button waits for its second press."""
        return what == self._asked and time.monotonic() - self._asked_at < SURE_S

    def remove(self, member: Member) -> None:
        """Out of the class, and away from the robot on the table."""
        if self.do(lambda: self.classroom.remove(self.browser, member.id)) and self.status.phase != "none":
            self._desks.hardware.ask(self.workshop.link.release(as_person(member)))

    def hand_robot_to(self, member: Member) -> None:
        """Give the robot on the table to somebody, who needs not have asked for it."""
        self._ask_link(lambda: self.workshop.link.hand_to(self.me, as_person(member)))

    def take_robot(self) -> None:
        self._ask_link(lambda: self.workshop.link.take_over(self.me))

    def free_robot(self) -> None:
        """Give it to whoever is next."""
        self._ask_link(lambda: self.workshop.link.release(self.me))

    def export(self) -> tuple[str, bytes]:
        """Name and content of a file with everybody's progress and all events."""
        self.classroom.require_instructor(self.browser)
        content = io.BytesIO()
        with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as together:
            together.writestr("progress.csv", progress_csv(self.classroom))
            together.writestr("events.csv", events_csv(self.classroom))
        return time.strftime("class-%Y-%m-%d.zip"), content.getvalue()

    def _ask_link(self, order: Callable[[], Future[None]]) -> None:
        if self.status.phase != "ready":
            self.tell("There is no robot on the table: connect one in the tab Hardware.")
        elif self.do(lambda: self.classroom.require_instructor(self.browser)):
            self._desks.hardware.ask(order())
