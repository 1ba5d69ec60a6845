"""Watches a student's act: which checks hold, whether they hold all at once, and whether the task is still the same."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import Protocol

from app.classroom.lessons.catalogue import namespace
from app.classroom.lessons.check import Verdict, judge
from app.classroom.lessons.lesson import Check, Setting, Step, Value

LOOKS_TO_PASS = 2
"""So often in a row all checks must hold: a gizmo on its way through the right place is not there."""

SAME = 1e-3
"""Two numbers, in the units that people read, that differ by less are the same."""


class Facts(Protocol):
    """What there is to know about a student's page."""

    def value(self, fact: str) -> Value | None: ...

    @property
    def busy(self) -> bool:
        """Something still computes: what is shown may belong to what was set before."""
        ...


class Examiner:
    """Of one step, while its act is open."""

    def __init__(self, facts: Facts, step: Step, seen: Collection[int] = ()) -> None:
        """`seen` are the numbers of the checks, from 0, that were met before."""
        self._facts = facts
        self._checks: tuple[Check, ...] = step.act.checks if step.act is not None else ()
        self._latched = {k for k in seen if k < len(self._checks) and self._checks[k].ever}
        self._given = {setting.fact: facts.value(setting.fact) for setting in fixed_settings(step)}
        self._in_a_row = 0
        self.verdicts: tuple[Verdict, ...] = tuple(Verdict(False, None, check.says, "") for check in self._checks)
        self.astray: tuple[str, ...] = ()
        """Facts that the step has set up and that are no longer so, though they are not to be changed."""

    @property
    def passed(self) -> bool:
        return self._in_a_row >= LOOKS_TO_PASS

    @property
    def wants_another_look(self) -> bool:
        """Whether it matters that all is still so in a moment."""
        return 0 < self._in_a_row < LOOKS_TO_PASS or self._facts.busy

    def look(self) -> None:
        """Judge anew. Nothing counts while something computes, or the task was changed."""
        self.astray = tuple(
            fact for fact, value in self._given.items() if not same_value(self._facts.value(fact), value)
        )
        counts = not self.astray and not self._facts.busy
        self.verdicts = tuple(self._judge(number, check, counts) for number, check in enumerate(self._checks))
        met = bool(self._checks) and all(verdict.met for verdict in self.verdicts)
        self._in_a_row = self._in_a_row + 1 if met and counts else 0

    def _judge(self, number: int, check: Check, counts: bool) -> Verdict:
        verdict = judge(check, self._facts.value)
        if verdict.met and check.ever and counts:
            self._latched.add(number)
        return verdict._replace(met=True, advice="") if number in self._latched else verdict


def fixed_settings(step: Step) -> tuple[Setting, ...]:
    """What the step sets up and the student is not to change."""
    if step.may_change is None:
        return ()
    return tuple(setting for setting in step.settings if namespace(setting.fact) not in step.may_change)


def same_value(one: Value | None, other: Value | None) -> bool:
    """Whether a fact is still the same; a number that is not there (NaN) is as good as none."""
    one, other = (None if isinstance(value, float) and math.isnan(value) else value for value in (one, other))
    if isinstance(one, float | int) and isinstance(other, float | int):
        return math.isclose(one, other, rel_tol=SAME, abs_tol=SAME)
    return one == other
