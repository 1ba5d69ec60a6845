"""A report as plain data. Texts of lessons are Markdown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Answer:
    """What was answered, as the lesson words it, or a number with its unit."""

    text: str
    right: bool


@dataclass(frozen=True)
class CheckMark:
    """One check of an act."""

    text: str
    met: bool


@dataclass(frozen=True)
class StepReport:
    """One step that was opened."""

    number: int
    title: str
    done: bool
    prediction: Answer | None = None
    checks: tuple[CheckMark, ...] = ()
    answers: tuple[Answer, ...] = ()
    """All tries at Explain, the last one last."""
    more: tuple[Answer, ...] = ()
    hints: int = 0
    attempts: int = 1
    seconds: float = 0.0
    plots: Sequence[Mapping[str, Any]] = ()


@dataclass(frozen=True)
class LessonReport:
    """One lesson of which a step was opened."""

    key: str
    title: str
    steps: tuple[StepReport, ...]
    steps_of: int

    @property
    def done(self) -> int:
        """How many steps are done."""
        return sum(step.done for step in self.steps)

    @property
    def seconds(self) -> float:
        return sum(step.seconds for step in self.steps)


@dataclass(frozen=True)
class Report:
    """Of one student; `made_at` in s since 1970, `steps_of`: steps of the whole course."""

    name: str
    class_name: str
    made_at: float
    lessons: tuple[LessonReport, ...]
    steps_of: int

    @property
    def steps(self) -> tuple[StepReport, ...]:
        return tuple(step for lesson in self.lessons for step in lesson.steps)

    @property
    def done(self) -> int:
        return sum(lesson.done for lesson in self.lessons)

    @property
    def seconds(self) -> float:
        return sum(lesson.seconds for lesson in self.lessons)

    @property
    def hints(self) -> int:
        return sum(step.hints for step in self.steps)

    @property
    def first_tries(self) -> tuple[int, int]:
        """How many explanations were right at the first try, and how many were tried."""
        tried = [step.answers[0].right for step in self.steps if step.answers]
        return sum(tried), len(tried)
