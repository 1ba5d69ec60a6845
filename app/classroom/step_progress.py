"""How far a student is in one step, as a function of what happened in it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from app.classroom.events import HINTS, Happened, Kind
from app.classroom.outline import StepOutline

WRONG_TRIES = 3
"""So many wrong answers in a step: somebody should come and help."""


@dataclass(frozen=True)
class StepProgress:
    """One step. "Redo" begins another attempt, in which everything is open again but the time and the attempt."""

    attempt: int = 1
    predicted: bool = False
    prediction: float | None = None
    """What was predicted first."""
    checks: frozenset[int] = frozenset()
    """Checks, counted from 0, that were met once."""
    acted: bool = False
    tries: int = 0
    right: bool = False
    first_try_right: bool | None = None
    answer: float | None = None
    """The last answer to Explain."""
    hints: int = 0
    more_right: bool | None = None
    seconds: float = 0.0
    struggling_since: float | None = None
    """When the worked hint was taken, or the third wrong answer given, without a right one since."""
    weak: bool = False
    """The first answer was wrong, or the worked hint was needed."""
    was_weak: bool = False
    """An attempt before this one was."""

    def after(self, happened: Happened) -> StepProgress:
        """The same with one more event of this step."""
        return _AFTER[happened.event.kind](self, happened)

    def finished(self, outline: StepOutline) -> bool:
        """Whether everything that the step asks for is done in this attempt."""
        return (
            (self.predicted or not outline.predicts)
            and (self.acted or not outline.checks)
            and (self.right or not outline.explains)
        )

    def done(self, outline: StepOutline) -> bool:
        """Whether it was finished in any attempt: only what is done can be redone."""
        return self.attempt > 1 or self.finished(outline)

    def redo_due(self, outline: StepOutline) -> bool:
        """Whether it should be done again: it was done, but not without help, and not well since."""
        return self.done(outline) and (self.weak or (self.was_weak and not self.finished(outline)))


def _opened(step: StepProgress, happened: Happened) -> StepProgress:
    return step


def _predicted(step: StepProgress, happened: Happened) -> StepProgress:
    if step.predicted:
        return step
    return replace(step, predicted=True, prediction=happened.event.detail.get("answer"))


def _checked(step: StepProgress, happened: Happened) -> StepProgress:
    return replace(step, checks=step.checks | {happened.event.detail["check"]})


def _acted(step: StepProgress, happened: Happened) -> StepProgress:
    return replace(step, acted=True)


def _explained(step: StepProgress, happened: Happened) -> StepProgress:
    right = bool(happened.event.detail["right"])
    first = step.tries == 0
    struggling = step.struggling_since
    if not right and not step.right and step.tries + 1 >= WRONG_TRIES and struggling is None:
        struggling = happened.at
    return replace(
        step,
        tries=step.tries + 1,
        right=step.right or right,
        first_try_right=right if first else step.first_try_right,
        answer=happened.event.detail.get("answer"),
        weak=step.weak or (first and not right),
        struggling_since=None if right else struggling,
    )


def _more(step: StepProgress, happened: Happened) -> StepProgress:
    return replace(step, more_right=bool(step.more_right) or bool(happened.event.detail["right"]))


def _hint(step: StepProgress, happened: Happened) -> StepProgress:
    stage = happened.event.detail["stage"]
    if stage < HINTS or step.right:
        return replace(step, hints=max(step.hints, stage))
    return replace(step, hints=stage, weak=True, struggling_since=step.struggling_since or happened.at)


def _redo(step: StepProgress, happened: Happened) -> StepProgress:
    return StepProgress(step.attempt + 1, seconds=step.seconds, was_weak=step.weak or step.was_weak)


_AFTER: dict[Kind, Callable[[StepProgress, Happened], StepProgress]] = {
    "opened": _opened,
    "predicted": _predicted,
    "checked": _checked,
    "acted": _acted,
    "explained": _explained,
    "more": _more,
    "hint": _hint,
    "redo": _redo,
}
