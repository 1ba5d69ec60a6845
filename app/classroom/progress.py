"""How far a student is, as a function of everything that happened, one event after the other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from app.classroom.events import Happened
from app.classroom.outline import Outline, step_outline
from app.classroom.step_progress import StepProgress

GAP_S = 300.0
"""Between two events nobody works longer than this on a step: he is away."""

STUCK_S = 180.0
STUCK_SHARE = 1.5
"""Without progress for longer than both 3 minutes and 1.5 times the step's minutes: stuck."""

Place = tuple[str, int]


@dataclass(frozen=True)
class Progress:
    """All that a student has done. Times in s since 1970; steps count from 1."""

    lesson: str = ""
    step: int = 0
    """Where he is; no lesson at first."""
    hand_since: float | None = None
    steps: Mapping[Place, StepProgress] = field(default_factory=dict)
    seen_at: float | None = None
    """The last event in a step."""
    moved_at: float | None = None
    """The last one that was progress: a step opened, a question answered right, another check met, ..."""

    def of(self, lesson: str, step: int) -> StepProgress:
        """One step; an untouched one is as new."""
        return self.steps.get((lesson, step), StepProgress())

    def after(self, happened: Happened) -> Progress:
        """The same with one more event."""
        event = happened.event
        if event.kind == "raised":
            return self if self.hand_since is not None else replace(self, hand_since=happened.at)
        if event.kind == "lowered":
            return replace(self, hand_since=None)
        spent = self._spent(happened.at)
        place = event.lesson, event.step
        before = spent.get(place, StepProgress())
        after = before.after(happened)
        moved = _is_progress(happened, before, after)
        return Progress(
            *place,
            self.hand_since,
            {**spent, place: after},
            happened.at,
            happened.at if moved else self.moved_at,
        )

    def redo_list(self, outline: Outline, lesson: str | None = None) -> tuple[Place, ...]:
        """What should be done again, of one lesson or the whole course, in its order."""
        due = (place for place, step in self.steps.items() if step.redo_due(step_outline(outline, *place)))
        return tuple(sorted(place for place in due if lesson in (None, place[0])))

    def done(self, lesson: str, step: int, outline: Outline) -> bool:
        return (lesson, step) in self.steps and self.of(lesson, step).done(step_outline(outline, lesson, step))

    def lesson_share(self, lesson: str, outline: Outline) -> float:
        """0 to 1: how many steps of a lesson are done."""
        return self.share({lesson: outline.get(lesson, ())})

    def share(self, outline: Outline) -> float:
        """0 to 1: how many steps of the course are done."""
        steps_of = sum(map(len, outline.values()))
        done = sum(
            step.done(outline[lesson][number - 1])
            for (lesson, number), step in self.steps.items()
            if 1 <= number <= len(outline.get(lesson, ()))
        )
        return done / steps_of if steps_of else 0.0

    def seconds_here(self, now: float) -> float:
        """How long he has worked on the step where he is."""
        seconds = self.of(self.lesson, self.step).seconds
        return seconds if self.seen_at is None else seconds + min(max(0.0, now - self.seen_at), GAP_S)

    def stuck_since(self, outline: Outline, now: float) -> float | None:
        """Since when he needs help where he is; None: he does not, as far as can be seen.

        He does after the worked hint or the third wrong answer, until a right one; and after a time without progress.
        """
        here = step_outline(outline, self.lesson, self.step)
        step = self.of(self.lesson, self.step)
        if not self.lesson or step.finished(here):
            return None
        waited = self.moved_at is not None and now - self.moved_at > max(STUCK_S, 60.0 * STUCK_SHARE * here.minutes)
        reasons = [step.struggling_since, self.moved_at if waited else None]
        return min((since for since in reasons if since is not None), default=None)

    def _spent(self, at: float) -> Mapping[Place, StepProgress]:
        """The time since the last event goes to the step that was open."""
        if self.seen_at is None:
            return self.steps
        place = self.lesson, self.step
        step = self.of(*place)
        spent = min(max(0.0, at - self.seen_at), GAP_S)
        return {**self.steps, place: replace(step, seconds=step.seconds + spent)}


def progress_of(events: Iterable[Happened]) -> Progress:
    """Of everything that happened, in order."""
    progress = Progress()
    for happened in events:
        progress = progress.after(happened)
    return progress


def _is_progress(happened: Happened, before: StepProgress, after: StepProgress) -> bool:
    match happened.event.kind:
        case "opened" | "redo" | "more":
            return True
        case "explained":
            return after.right
        case "hint":
            return False
        case _:
            return after != before
