"""How far one browser's student is in the course, and what is open."""

from __future__ import annotations

from app.classroom import events
from app.classroom.classroom import Classroom
from app.classroom.people import Member
from app.classroom.progress import Place, Progress
from app.classroom.step_progress import StepProgress
from app.ui.lessons.library import Library
from app.ui.lessons.standing import Dot, Standing, first_open

NOT_A_MEMBER = "Join the class first."
NOT_YET = "Finish the steps before it first."


class Page:
    """A member's notebook, opened at one step."""

    def __init__(self, classroom: Classroom, member: Member, key: str, number: int) -> None:
        self._classroom = classroom
        self._member = member
        self._place = key, number

    @property
    def work(self) -> StepProgress:
        return self._classroom.progress(self._member).of(*self._place)

    def record(self, event: events.Event) -> None:
        """Raises UserMistake if it is not saved."""
        self._classroom.record(self._member, event)


class CourseMap:
    """What there is to learn, seen from one browser."""

    def __init__(self, library: Library, classroom: Classroom, browser: str) -> None:
        self.library = library
        self.classroom = classroom
        self.browser = browser

    @property
    def member(self) -> Member | None:
        """Who learns here; None: has to join the class first."""
        return self.classroom.member(self.browser)

    @property
    def progress(self) -> Progress:
        """Of who learns here; as new where nobody does."""
        member = self.member
        return Progress() if member is None else self.classroom.progress(member)

    def find(self, asked: str) -> str:
        """Key of the lesson that is called `02` or `02-inverse-kinematics`; empty if there is none."""
        keys = self.library.files
        return next((key for key in keys if asked and asked in (key, key.partition("-")[0])), "")

    def standings(self, key: str) -> tuple[Standing, ...]:
        """How far the student is with every step of a lesson; numbers in the texts are nobody's."""
        file, progress = self.library.files.get(key), self.progress
        if file is None:
            return ()
        return tuple(Standing(step, progress.of(key, step.number)) for step in file.outline.steps)

    def present_step(self, key: str) -> int:
        """Where to go on in a lesson; at its beginning if all of it is done."""
        standings = self.standings(key)
        number = first_open(standings)
        return number if number <= len(standings) else 1

    def why_not(self, key: str, number: int) -> str:
        """Why a step cannot be opened; empty if it can."""
        member = self.member
        if member is None:
            return NOT_A_MEMBER
        if member.instructor:
            return ""
        if not self.classroom.pace.allows(key, number):
            return self.limit_words()
        return NOT_YET if number > first_open(self.standings(key)) else ""

    def limit_words(self) -> str:
        """How far the instructor lets everybody go; empty where there is no limit."""
        limit = self.classroom.pace.limit
        if limit is None:
            return ""
        file = self.library.files.get(limit[0])
        where = f"lesson {file.outline.number}" if file is not None else limit[0]
        return f"Your instructor has opened up to step {limit[1]} of {where}."

    def dots(self, key: str, here: int) -> tuple[tuple[Standing, Dot], ...]:
        """The steps of a lesson; the one that is shown is `here`."""
        return tuple((standing, self._dot(key, standing, here)) for standing in self.standings(key))

    def redo_list(self, key: str | None = None) -> tuple[Place, ...]:
        """Steps that should be tried again, of one lesson or all."""
        places = self.progress.redo_list(self.library.outline(), key)
        return tuple(place for place in places if place[0] in self.library.files)

    def share(self, key: str) -> tuple[int, int]:
        """How many steps of a lesson are done, of how many."""
        standings = self.standings(key)
        return sum(standing.done for standing in standings), len(standings)

    def _dot(self, key: str, standing: Standing, here: int) -> Dot:
        if standing.step.number == here:
            return "here"
        if self.why_not(key, standing.step.number):
            return "locked"
        return "done" if standing.done else "open"
