"""A lesson as one student sees it: every number is concrete. Plain immutable data, in the units that people read."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

Value = float | bool | str
"""Of a fact: a number in its unit, a flag or a word."""


@dataclass(frozen=True)
class Setting:
    """A fact that is set when a step begins."""

    fact: str
    value: Value


@dataclass(frozen=True)
class Choice:
    """One option of a question; texts are Markdown."""

    text: str
    right: bool
    feedback: str


@dataclass(frozen=True)
class Near:
    """A wrong answer that is known, and what to say about it."""

    value: float
    within: float
    says: str


@dataclass(frozen=True)
class NumberAnswer:
    """What a number is compared with; all in `unit`."""

    answer: float
    unit: str
    within: float
    right: str
    wrong: str
    near: tuple[Near, ...] = ()


class Grade(NamedTuple):
    """Of one answer."""

    right: bool
    feedback: str
    """Markdown."""


@dataclass(frozen=True)
class Question:
    """Asked before or after an act: either choices, or a number."""

    text: str
    choices: tuple[Choice, ...] = ()
    number: NumberAnswer | None = None

    def grade(self, answer: float) -> Grade:
        """Judge the number of an option (from 1), or a number in the question's unit."""
        if self.number is not None:
            return _grade_number(self.number, float(answer))
        if not float(answer).is_integer() or not 1 <= answer <= len(self.choices):
            return Grade(False, "Choose one of the options.")
        choice = self.choices[int(answer) - 1]
        return Grade(choice.right, choice.feedback)


def _grade_number(wanted: NumberAnswer, answer: float) -> Grade:
    if not math.isfinite(answer):
        return Grade(False, "Give a number.")
    if is_near(answer, wanted.answer, wanted.within):
        return Grade(True, wanted.right)
    for near in wanted.near:
        if is_near(answer, near.value, near.within):
            return Grade(False, near.says)
    return Grade(False, wanted.wrong)


def is_near(value: float, wanted: float, within: float) -> bool:
    """Whether two numbers agree, with room for how floats are rounded; never for NaN."""
    return abs(value - wanted) <= within + 1e-9 * max(1.0, abs(wanted))


@dataclass(frozen=True)
class Relation:
    """A bound that is another live fact of the same unit: times * fact + plus."""

    fact: str
    times: float = 1.0
    plus: float = 0.0


Bound = float | Relation


@dataclass(frozen=True)
class Check:
    """What must hold of a fact; exactly one of `is_`, bounds and `one_of` is given."""

    fact: str
    unit: str
    says: str
    """Shown beside the check mark."""
    is_: Value | None = None
    within: float = 0.0
    at_least: Bound | None = None
    at_most: Bound | None = None
    one_of: tuple[Value, ...] = ()
    why: str = ""
    """Shown once it is met."""
    if_not: str = ""
    """Advice while it is not."""
    ever: bool = False
    """Whether it stays met once it was met in this step."""
    line: int = 0
    """Of the lesson file."""


@dataclass(frozen=True)
class Act:
    """A task on the live robot; done when all checks hold."""

    text: str
    checks: tuple[Check, ...]


@dataclass(frozen=True)
class Set:
    """A deed: set a fact."""

    fact: str
    to: Value


@dataclass(frozen=True)
class Press:
    """A deed: start an action, and wait until it is done."""

    name: str


Deed = Set | Press


@dataclass(frozen=True)
class Play:
    """What a test does in place of a student; answers as `Question.grade` takes them."""

    deeds: tuple[Deed, ...] = ()
    predict: float | None = None
    explain: float | None = None
    more: float | None = None
    line: int = 0
    """Of the lesson file."""


@dataclass(frozen=True)
class Step:
    """One predict -> act -> explain cycle; texts are Markdown, empty where there are none."""

    number: int
    """From 1."""
    title: str
    minutes: float
    text: str
    tab: str = ""
    """Which tab is brought to the front; empty: it stays."""
    settings: tuple[Setting, ...] = ()
    may_change: frozenset[str] | None = None
    """Namespaces of facts; None: everything."""
    predict: Question | None = None
    act: Act | None = None
    explain: Question | None = None
    more: Question | None = None
    hints: tuple[str, ...] = ()
    """A question, a hint, the worked step; or none."""
    errors: str = ""
    safety: str = ""
    notes: str = ""
    """For the instructor only."""
    solution: Play | None = None
    wrong: Play | None = None
    line: int = 0
    """Of the lesson file."""


@dataclass(frozen=True)
class Lesson:
    """All of it, with one student's numbers."""

    key: str
    """Name of its file, without .md."""
    number: int
    title: str
    minutes: float
    robot: str
    goals: tuple[str, ...]
    needs: tuple[str, ...]
    """Keys of lessons to do before."""
    papers: tuple[str, ...]
    hardware: bool
    """Whether it uses the robot on the table, real or emulated."""
    intro: str
    steps: tuple[Step, ...]
    path: Path = field(compare=False)
