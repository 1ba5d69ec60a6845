"""What the members do: saved as it happens, and never more than a student at work would."""

from __future__ import annotations

import json
import time
from dataclasses import dataclass

from app.classroom.errors import ClassroomRefusal
from app.classroom.events import KINDS, Event
from app.classroom.evidence import packed
from app.classroom.limits import Clock, Limit
from app.classroom.progress import Progress, progress_of
from app.classroom.store.store import Store
from app.recent import Recent

EVENTS_A_MINUTE = 240
EVENTS_OF_ALL = 12_000
MOST_EVENTS = 20_000
"""Of one member; a diligent one has some 2000 in a whole course."""

MOST_EVIDENCE_BYTES = 8_000_000
"""Of one member. What is done beyond that counts as well, only its plots are not kept."""

LONGEST_KEY = 100
LONGEST_DETAIL = 400
REMEMBERED = 800
TOO_FAST = "That was too quick: wait a moment, then try again."
TOO_MUCH = "Your place is full, nothing more is saved: ask your instructor."


@dataclass(frozen=True)
class _Desk:
    """What is known of one member without reading the store."""

    progress: Progress
    events: int
    evidence_bytes: int


class Work:
    """Everybody's progress, read from the store when it is first asked for."""

    def __init__(self, store: Store, clock: Clock = time.monotonic, wall: Clock = time.time) -> None:
        self._store = store
        self._wall = wall
        self._desks: Recent[str, _Desk] = Recent(REMEMBERED)
        self._pace = Limit(EVENTS_A_MINUTE, EVENTS_OF_ALL, clock)

    def progress(self, member_id: str) -> Progress:
        return self._desk(member_id).progress

    def why_not(self, member_id: str) -> str:
        """Why nothing more may be recorded now; empty if it may."""
        if self._pace.reached(member_id):
            return TOO_FAST
        return TOO_MUCH if self._desk(member_id).events >= MOST_EVENTS else ""

    def record(self, member_id: str, event: Event) -> None:
        """Save an event; it is on disk when this returns.

        Raises:
            ClassroomRefusal: too quick, or too many.
        """
        if len(event.lesson) > LONGEST_KEY or len(json.dumps(dict(event.detail))) > LONGEST_DETAIL:
            raise ValueError(f"An event says too much: {event.kind} in {event.lesson[:LONGEST_KEY]}.")
        if event.kind not in KINDS:
            raise ValueError(f"There is no event {event.kind!r}.")
        if refusal := self.why_not(member_id):
            raise ClassroomRefusal(refusal)
        self._pace.note(member_id)
        desk = self._desk(member_id)
        plots = packed(event.evidence)
        if desk.evidence_bytes + len(plots) > MOST_EVIDENCE_BYTES:
            plots = ""
        happened = self._store.add_event(member_id, self._wall(), event, plots)
        after = _Desk(desk.progress.after(happened), desk.events + 1, desk.evidence_bytes + len(plots))
        self._desks.put(member_id, after)

    def _desk(self, member_id: str) -> _Desk:
        desk = self._desks.get(member_id)
        if desk is None:
            events = list(self._store.events(member_id))
            desk = _Desk(progress_of(events), len(events), self._store.evidence_bytes(member_id))
            self._desks.put(member_id, desk)
        return desk
