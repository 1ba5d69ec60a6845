"""The lessons of one browser, put together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import viser

from app.classroom.lessons.lesson import Step
from app.ui.downloads import send
from app.ui.lessons.apparatus import Apparatus
from app.ui.lessons.desk import LessonDesk
from app.ui.lessons.dock import LessonDock
from app.ui.lessons.open_step import OpenStep
from app.ui.panels.lessons.lesson_panel import LessonPanel

if TYPE_CHECKING:
    from app.ui.lessons.door import LessonDoor

EVERYTHING = frozenset({"robot", "geometry"})
"""What can be locked on the page."""


class LessonRoom:
    """Lessons know the tabs only through the apparatus."""

    def __init__(self, door: LessonDoor, dock: LessonDock, tab: viser.GuiTabHandle, asked: str) -> None:
        self._client = door.client
        self._session = door.desks.session
        self._tabs = door.tabs
        self._dock = dock
        self._door = door
        self._reporter = door.desks.staff.slow()
        self.apparatus = Apparatus(self._session, door.desks, self._tabs.show, lambda: self._tabs.front)
        self._tabs.changed.connect(lambda _: self.apparatus.changed.emit(None))
        self.desk = LessonDesk(door.library, door.classroom, door.browser, self.apparatus)
        self.desk.turned.connect(self._turn)
        with tab:
            self._panel = LessonPanel(self._client, self.desk, door.wire, self._save_report)
        was_here = self._session.in_lesson
        self.desk.begin(asked, come_back=door.classroom.in_class if was_here is None else was_here)

    def hear(self, what: str, value: str) -> None:
        """What the page says."""
        if what == "fold":
            self.desk.leave()
            self._dock.fold()
            self._session.in_lesson = False
        else:
            self._panel.hear(what, value)

    def close(self) -> None:
        self.desk.close()

    def _turn(self, step: OpenStep | None) -> None:
        """Another step is open: its tab comes to the front, and what it does not leave open is locked."""
        self._session.in_lesson = self.desk.screen != "list"
        if self.desk.screen != "list":
            self._dock.unfold()
        if step is not None and step.step.tab:
            self._tabs.show(step.step.tab)
        self._session.lock(locked(step.step) if step is not None else frozenset())

    def _save_report(self, kind: str) -> None:
        """Made by a worker: `md` or `html`."""
        from app.classroom.report import deeds_of, report_text

        member, course = self.desk.map.member, self._door.library.course
        if member is None or course is None:
            return
        form = "markdown" if kind == "md" else "html"
        deeds = deeds_of(self._door.classroom, member)
        name = f"delta-lab-report.{'md' if kind == 'md' else 'html'}"
        self._reporter.request(lambda text: self._hand_over(name, text), report_text, deeds, course.folder, form)

    def _hand_over(self, name: str, text: str) -> None:
        send(self._client, name, text.encode())
        self.apparatus.note_export()


def locked(step: Step) -> frozenset[str]:
    """What a student must leave as it is in a step."""
    return frozenset() if step.may_change is None else EVERYTHING - step.may_change
