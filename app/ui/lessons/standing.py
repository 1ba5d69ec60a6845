"""How far a student is with one step: what is open now, and what comes later."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from app.classroom.lessons.lesson import Step
from app.classroom.step_progress import StepProgress

Phase = Literal["predict", "act", "explain", "done"]
"""What there is to do; always in this order."""

Dot = Literal["done", "here", "open", "locked"]


@dataclass(frozen=True)
class Standing:
    """One step with what the student has done in it."""

    step: Step
    work: StepProgress

    @property
    def phase(self) -> Phase:
        if self.step.predict is not None and not self.work.predicted:
            return "predict"
        if self.step.act is not None and not self.work.acted:
            return "act"
        if self.step.explain is not None and not self.work.right:
            return "explain"
        return "done"

    @property
    def done(self) -> bool:
        """Whether the student may go on: it is finished, or was before it was begun anew."""
        return self.phase == "done" or self.work.attempt > 1

    @property
    def shows_prediction(self) -> bool:
        """Whether the student may learn what the prediction was worth: not before the act."""
        return self.work.predicted and (self.step.act is None or self.work.acted)


def first_open(standings: tuple[Standing, ...]) -> int:
    """Number of the first step that is not done; one more than there are steps if all are."""
    return next((s.step.number for s in standings if not s.done), len(standings) + 1)
