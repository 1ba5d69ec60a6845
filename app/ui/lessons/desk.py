"""Which step of which lesson a student has open, and the way from one to the next. No widgets here."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Literal

from app.classroom import events
from app.classroom.classroom import Classroom
from app.classroom.lessons.lesson import Lesson
from app.classroom.people import Member, seed_of_attempt
from app.errors import UserMistake
from app.signal import Signal
from app.ui.lessons.course_map import NOT_A_MEMBER, CourseMap, Page
from app.ui.lessons.library import Library
from app.ui.lessons.open_step import Apparatus, OpenStep

Screen = Literal["list", "step", "end"]
How = Literal["on", "back", "again"]
"""A step is opened on the way, by who comes back to the page, or to be tried again with other numbers."""

NO_STEP = "There is no such step."


class LessonDesk:
    """The state behind the lesson panel of one browser."""

    def __init__(self, library: Library, classroom: Classroom, browser: str, apparatus: Apparatus) -> None:
        self.map = CourseMap(library, classroom, browser)
        self.changed: Signal[None] = Signal()
        """The page says something else."""
        self.marked: Signal[None] = Signal()
        """Check marks do, and nothing more."""
        self.turned: Signal[OpenStep | None] = Signal()
        """Another step is open, or none; before it is set up."""
        self.screen: Screen = "list"
        self.lesson: Lesson | None = None
        """The one that is open; None on the list."""
        self.open_step: OpenStep | None = None
        """None on the list and at a lesson's end."""
        self.problem = ""
        """Why something could not be done; a sentence."""
        self._library = library
        self._classroom = classroom
        self._apparatus = apparatus
        self._member_id = self._id_now
        self._wish = ""
        """A lesson to open once somebody has joined."""
        self._fetching: asyncio.Task[None] | None = None
        self._closers: list[Callable[[], None]] = [
            classroom.progress_changed.connect(self._hear_progress),
            classroom.pace_changed.connect(lambda _: self.keep_pace()),
            classroom.members_changed.connect(lambda _: self._follow_member()),
            library.changed.connect(lambda _: self._reread()),
        ]

    @property
    def place(self) -> tuple[str, int]:
        """Key of the open lesson and number of the step; after the last step one more."""
        if self.lesson is None:
            return "", 0
        step = self.open_step
        return self.lesson.key, len(self.lesson.steps) + 1 if step is None else step.step.number

    @property
    def fetching(self) -> bool:
        """A lesson's numbers are being computed."""
        return self._fetching is not None

    @property
    def why_not_next(self) -> str:
        """Why the student cannot go on; empty if he can."""
        step, member = self.open_step, self.map.member
        if step is None or self.lesson is None or (member is not None and member.instructor):
            return ""
        if not step.standing.done:
            return "Finish this step first."
        key, number = self.place
        return self.map.why_not(key, number + 1) if number < len(self.lesson.steps) else ""

    def close(self) -> None:
        for disconnect in self._closers:
            disconnect()
        self._cancel()
        if self.open_step is not None:
            self.open_step.close()

    def begin(self, asked: str = "", *, come_back: bool = True) -> None:
        """The page is there: open the lesson that its address asks for, or where the student was."""
        self._wish = self.map.find(asked)
        self._start(come_back=come_back)
        if asked and not self.map.find(asked):
            self._refuse(f"There is no lesson {asked[:40]}.")

    def go(self, key: str, number: int | None = None) -> None:
        """Open a step, if that is allowed; without a number where the student was in this lesson."""
        wanted = self.map.present_step(key) if number is None else number
        if refusal := self.map.why_not(key, wanted):
            self._refuse(refusal)
        else:
            self._open(key, wanted)

    def next(self) -> None:
        """The step after this one, or the end of the lesson."""
        if self.lesson is None or self.open_step is None:
            return
        key, number = self.place
        if self.why_not_next:
            self._refuse(self.why_not_next)
        elif number < len(self.lesson.steps):
            self.go(key, number + 1)
        else:
            self._turn("end", self.lesson, None)

    def back(self) -> None:
        key, number = self.place
        if number > 1:
            self.go(key, number - 1)

    def leave(self) -> None:
        """Close the lesson: explore freely."""
        self._cancel()
        self._turn("list", None, None)

    def redo(self, key: str, number: int) -> None:
        """Try a step again with new numbers."""
        member, standings = self.map.member, self.map.standings(key)
        try:
            if member is None:
                raise UserMistake(NOT_A_MEMBER)
            if not 1 <= number <= len(standings):
                raise UserMistake(NO_STEP)
            if self.map.why_not(key, number) or not standings[number - 1].done:
                raise UserMistake("Finish this step before you try it again.")
        except UserMistake as mistake:
            self._refuse(str(mistake))
        else:
            self._open(key, number, "again")

    def keep_pace(self) -> None:
        """Follow the instructor who brings everybody to a step."""
        pace, member = self._classroom.pace, self.map.member
        wanted = pace.lesson, pace.step
        if pace.mode == "all_at" and member is not None and not member.instructor and wanted != self.place:
            self._open(*wanted)
        else:
            self.changed.emit(None)

    def _start(self, *, come_back: bool) -> None:
        member, progress = self.map.member, self.map.progress
        if member is not None and self._wish:
            wish, self._wish = self._wish, ""
            self.go(wish)
        elif come_back and progress.lesson in self._library.files:
            self._open(progress.lesson, progress.step, "back")
        if self._classroom.pace.mode == "all_at":
            self.keep_pace()
        self.changed.emit(None)

    def _open(self, key: str, number: int, how: How = "on") -> None:
        """Show a step as soon as its numbers are there; what was asked for last is what counts."""
        self._cancel()
        member = self.map.member
        if member is None:
            self._refuse(NOT_A_MEMBER)
            return
        attempt = self.map.progress.of(key, number).attempt + (how == "again")
        seed = seed_of_attempt(member.seed, attempt)
        lesson = self._library.known(key, seed)
        if lesson is not None:
            self._show(member, lesson, number, how)
            return
        self._fetching = asyncio.get_running_loop().create_task(self._fetch(member, key, number, seed, how))
        self.changed.emit(None)

    async def _fetch(self, member: Member, key: str, number: int, seed: int, how: How) -> None:
        try:
            lesson = await self._library.fetch(key, seed)
        except UserMistake as mistake:
            self._fetching = None
            self._refuse(str(mistake))
        else:
            self._fetching = None
            self._show(member, lesson, number, how)

    def _show(self, member: Member, lesson: Lesson, number: int, how: How) -> None:
        if not 1 <= number <= len(lesson.steps):
            self._refuse(NO_STEP)
            return
        event = events.redo if how == "again" else events.opened
        try:
            self._classroom.record(member, event(lesson.key, number))
        except UserMistake as refusal:
            self._refuse(str(refusal))
            return
        page = Page(self._classroom, member, lesson.key, number)
        tell, mark = (lambda: self.changed.emit(None)), (lambda: self.marked.emit(None))
        step = OpenStep(lesson, lesson.steps[number - 1], page, self._apparatus, tell, mark)
        self._turn("step", lesson, step)
        step.begin(come_back=how == "back")
        self.changed.emit(None)

    def _turn(self, screen: Screen, lesson: Lesson | None, step: OpenStep | None) -> None:
        if self.open_step is not None:
            self.open_step.close()
        self.screen, self.lesson, self.open_step = screen, lesson, step
        self.problem = ""
        self.turned.emit(step)
        self.changed.emit(None)

    def _reread(self) -> None:
        """Lesson files have changed: show the open one anew, at the same place."""
        key, number = self.place
        if self.lesson is None or self.map.member is None:
            self.changed.emit(None)
        elif key not in self._library.files:
            broken = self._library.broken.get(key)
            self._refuse(
                f"This lesson is broken now: line {broken.line}, {broken.reason}" if broken else "It has gone."
            )
        elif not self.fetching:
            self._fetching = asyncio.get_running_loop().create_task(self._exchange(self.map.member, key, number))

    async def _exchange(self, member: Member, key: str, number: int) -> None:
        try:
            lesson = await self._library.fetch(key, self._classroom.seed(member, key, number))
        except UserMistake as mistake:
            self._refuse(str(mistake))
            return
        finally:
            self._fetching = None
        step = self.open_step
        if self.place != (key, number) or (lesson == self.lesson and not self.problem):
            return
        self.problem = ""
        if step is not None and number > len(lesson.steps):
            self._show(member, lesson, len(lesson.steps), "on")
            return
        self.lesson = lesson
        if step is not None:
            step.exchange(lesson, lesson.steps[number - 1])
        self.changed.emit(None)

    def _cancel(self) -> None:
        if self._fetching is not None:
            self._fetching.cancel()
            self._fetching = None

    def _refuse(self, sentence: str) -> None:
        self.problem = sentence
        self.changed.emit(None)

    def _hear_progress(self, member: Member) -> None:
        """Also from another page of the same student."""
        if member.id == self._id_now:
            self.changed.emit(None)

    @property
    def _id_now(self) -> str:
        member = self.map.member
        return "" if member is None else member.id

    def _follow_member(self) -> None:
        """Somebody has joined at this browser, or was removed."""
        if self._id_now != self._member_id:
            self._member_id = self._id_now
            self.leave()
            if self._member_id:
                self._start(come_back=True)
