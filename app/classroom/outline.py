"""What the course asks for, in numbers: enough to say how far somebody is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from app.classroom.lessons.course import Course
    from app.classroom.lessons.lesson import Step

USUAL_MINUTES = 5.0


@dataclass(frozen=True)
class StepOutline:
    """One step: its minutes, and what is done in it."""

    title: str = ""
    minutes: float = USUAL_MINUTES
    predicts: bool = False
    checks: int = 0
    explains: bool = False


Outline = Mapping[str, tuple[StepOutline, ...]]
"""The steps of every lesson, by its key."""


def step_outline(outline: Outline, lesson: str, step: int) -> StepOutline:
    """A step, counted from 1; one that is no longer in the course is a usual one."""
    steps = outline.get(lesson, ())
    return steps[step - 1] if 1 <= step <= len(steps) else StepOutline()


def outline_of(course: Course) -> Outline:
    """The outline of all lessons that are not broken; no student's numbers are computed."""
    return {key: tuple(map(_outline_of_step, file.outline.steps)) for key, file in course.files.items()}


def _outline_of_step(step: Step) -> StepOutline:
    checks = 0 if step.act is None else len(step.act.checks)
    return StepOutline(step.title, step.minutes, step.predict is not None, checks, step.explain is not None)
