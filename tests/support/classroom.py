"""A class for tests: time passes when a test says so."""

from __future__ import annotations

from app.classroom.classroom import Classroom
from app.classroom.outline import StepOutline
from app.classroom.people import Member
from app.classroom.store.store import Store

PIN = "047119"
TEACHER = "the teacher's browser"
LESSON = "02-inverse"
OUTLINE = {
    "01-meet": (StepOutline("Look", 4.0, predicts=True),),
    LESSON: (StepOutline("One leg", 4.0, True, 2, True), StepOutline("All legs", 10.0, False, 3, True)),
}


class Clock:
    """Seconds; starts in the year 2026."""

    def __init__(self) -> None:
        self.now = 1_790_000_000.0

    def __call__(self) -> float:
        return self.now


def a_class(store: Store | None = None, clock: Clock | None = None) -> Classroom:
    """With an outline and a PIN."""
    clock = clock or Clock()
    return Classroom(store or Store(), in_class=True, pin=PIN, outline=lambda: OUTLINE, clock=clock, wall=clock)


def joined(classroom: Classroom, name: str) -> Member:
    """Somebody who has joined from a browser called as he is."""
    return classroom.join(name, name, classroom.code)


def with_teacher(classroom: Classroom) -> Classroom:
    assert classroom.prove(TEACHER, PIN) == ""
    return classroom
