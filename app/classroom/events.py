"""What happens while a student works, one event each; everything else about his work follows from them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, get_args

Kind = Literal[
    "opened", "predicted", "checked", "acted", "explained", "more", "hint", "redo", "raised", "lowered"
]  # fmt: skip
KINDS = frozenset(get_args(Kind))
HINTS = 3

Plot = Mapping[str, Any]
"""One plot of the evidence, as JSON takes it: title, x_label, y_label, series of {label, x, y}; equal = True: both
axes have one scale."""


@dataclass(frozen=True)
class Event:
    """One thing that a student did in a step of a lesson; steps count from 1. Hands are raised without a step."""

    kind: Kind
    lesson: str = ""
    step: int = 0
    detail: Mapping[str, Any] = field(default_factory=dict)
    evidence: Sequence[Plot] = ()


@dataclass(frozen=True)
class Happened:
    """An event with its time (s since 1970) and its number in the store."""

    number: int
    at: float
    event: Event


def opened(lesson: str, step: int) -> Event:
    """The step is on the screen, for the first time or again."""
    return Event("opened", lesson, step)


def predicted(lesson: str, step: int, answer: float) -> Event:
    """The question before the act was answered: the number of an option from 1, or a number."""
    return Event("predicted", lesson, step, {"answer": _number(answer)})


def checked(lesson: str, step: int, check: int) -> Event:
    """A check, counted from 0, was met for the first time."""
    return Event("checked", lesson, step, {"check": int(check)})


def acted(lesson: str, step: int, evidence: Sequence[Plot] | None = None) -> Event:
    """All checks were met at once."""
    return Event("acted", lesson, step, evidence=tuple(evidence or ()))


def explained(lesson: str, step: int, answer: float, right: bool) -> Event:
    """The question after the act was answered."""
    return Event("explained", lesson, step, {"answer": _number(answer), "right": bool(right)})


def more(lesson: str, step: int, answer: float, right: bool) -> Event:
    """The extra problem was answered."""
    return Event("more", lesson, step, {"answer": _number(answer), "right": bool(right)})


def hint(lesson: str, step: int, stage: int) -> Event:
    """A hint was shown: 1 a question, 2 a hint, 3 the worked step."""
    return Event("hint", lesson, step, {"stage": min(max(int(stage), 1), HINTS)})


def redo(lesson: str, step: int) -> Event:
    """The step begins anew, with other numbers."""
    return Event("redo", lesson, step)


def raised() -> Event:
    return Event("raised")


def lowered() -> Event:
    return Event("lowered")


def _number(answer: float) -> float | None:
    """JSON has no infinity."""
    return answer if math.isfinite(answer) else None
