"""The robot and the tabs as a step wants them."""

from __future__ import annotations

from typing import Protocol

from app.classroom.lessons.lesson import Lesson, Step, Value
from app.errors import UserMistake
from app.ui.lessons.examiner import fixed_settings, same_value

ROBOT = "robot"


class Bench(Protocol):
    """What a lesson may set on a student's page."""

    def value(self, fact: str) -> Value | None: ...

    def set(self, fact: str, value: Value) -> None: ...


def robot_of(lesson: Lesson, step: Step) -> str:
    """The robot that a step works with: the one that was set up last."""
    chosen = lesson.robot
    for earlier in lesson.steps[: step.number]:
        for setting in earlier.settings:
            if setting.fact == ROBOT:
                chosen = str(setting.value)
    return chosen


def set_up(bench: Bench, lesson: Lesson, step: Step) -> str:
    """Make everything as the step wants it; returns a sentence if something could not be done, else nothing."""
    try:
        if not any(setting.fact == ROBOT for setting in step.settings):
            _choose_robot(bench, robot_of(lesson, step))
        for setting in step.settings:
            bench.set(setting.fact, setting.value)
    except UserMistake as mistake:
        return f"The step could not be set up: {mistake}"
    return ""


def is_set_up(bench: Bench, lesson: Lesson, step: Step) -> bool:
    """Whether a student who comes back may go on with what is there."""
    if bench.value(ROBOT) != robot_of(lesson, step):
        return False
    return all(same_value(bench.value(setting.fact), setting.value) for setting in fixed_settings(step))


def _choose_robot(bench: Bench, robot: str) -> None:
    if bench.value(ROBOT) != robot:
        bench.set(ROBOT, robot)
