"""What a report needs of a student, read from the store in one go."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from app.classroom.classroom import Classroom
from app.classroom.outline import Outline
from app.classroom.people import Member, seed_of_attempt
from app.classroom.progress import Place, Progress

Try = tuple[float | None, bool]
"""An answer, and whether it was right."""


@dataclass(frozen=True)
class Deeds:
    """Plain data. Times in s since 1970."""

    name: str
    class_name: str
    made_at: float
    seed: int
    outline: Outline
    progress: Progress
    tries: Mapping[Place, Sequence[Try]]
    """Answers to Explain in the latest attempt at each step."""
    more: Mapping[Place, Sequence[Try]]
    """The same for One more."""
    plots: Mapping[Place, Sequence[Mapping[str, Any]]]
    """Evidence of the latest act that left some."""

    def seed_at(self, place: Place) -> int:
        """Of the numbers in the latest attempt."""
        return seed_of_attempt(self.seed, self.progress.of(*place).attempt)


def deeds_of(classroom: Classroom, member: Member) -> Deeds:
    """All that a member has done until now; quick."""
    evidence = classroom.store.evidence(member.id)
    tries: dict[Place, list[Try]] = {}
    more: dict[Place, list[Try]] = {}
    plots: dict[Place, list[dict]] = {}
    for happened in classroom.store.events(member.id):
        event, place = happened.event, (happened.event.lesson, happened.event.step)
        match event.kind:
            case "explained":
                tries.setdefault(place, []).append((event.detail["answer"], event.detail["right"]))
            case "more":
                more.setdefault(place, []).append((event.detail["answer"], event.detail["right"]))
            case "redo":
                tries.pop(place, None)
                more.pop(place, None)
            case "acted" if happened.number in evidence:
                plots[place] = evidence[happened.number]
    name = classroom.name if classroom.in_class else ""
    progress = classroom.progress(member)
    return Deeds(member.name, name, time.time(), member.seed, classroom.outline, progress, tries, more, plots)
