"""A class, or everybody who works alone: who is who, what they do, and what the instructor wishes.

One a server, on its event loop only. Every deed of the instructor's names the browser that acts (`by`), and is refused
unless the PIN was given there. Signals tell pages what has changed.
"""

from __future__ import annotations

import json
import secrets
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from app.classroom.codes import browser_hash, new_class_code
from app.classroom.errors import ClassroomRefusal
from app.classroom.events import Event, lowered, raised
from app.classroom.limits import Clock
from app.classroom.outline import Outline
from app.classroom.pace import Pace, clean_message, new_pace, pace_as_data, pace_of
from app.classroom.people import Member, Pin, as_person, seed_of_attempt
from app.classroom.presence import Presence
from app.classroom.progress import Progress
from app.classroom.roster import Roster
from app.classroom.showing import Showing
from app.classroom.solo import SoloPeople
from app.classroom.store.rows import ClassRow, MemberRow
from app.classroom.store.store import Store
from app.classroom.work import Work
from app.link.lease import Person
from app.signal import Signal

NO_OUTLINE: Outline = {}
NOT_INSTRUCTOR = "Only the instructor can do this: give the PIN first."
CLOSED = "The class is closed: nothing more is saved, but your report is still there."
NAME_STAYS = "In a class your name stays as you joined: ask your instructor to change it."


class Classroom(Showing):
    """See the module. Refusals are `ClassroomRefusal`s of one sentence."""

    def __init__(
        self,
        store: Store,
        *,
        in_class: bool,
        pin: str = "",
        name: str = "",
        outline: Callable[[], Outline] = lambda: NO_OUTLINE,
        notice: str = "",
        clock: Clock = time.monotonic,
        wall: Clock = time.time,
    ) -> None:
        super().__init__()
        self.in_class = in_class
        self.notice = notice
        """What whoever started the server should know, in one sentence, or nothing."""
        self.members_changed: Signal[None] = Signal()
        """Somebody joined, left, was removed or renamed; a page was opened or closed."""
        self.progress_changed: Signal[Member] = Signal()
        """Also when a hand is raised or lowered."""
        self.pace_changed: Signal[Pace] = Signal()
        self.door_changed: Signal[bool] = Signal()
        self.removed: Signal[Member] = Signal()
        self.closed: Signal[None] = Signal()
        self.store = store
        self._outline = outline
        self._wall = wall
        self._row = open_row(store, in_class=in_class, name=name, now=wall())
        self._pace = pace_of(json.loads(self._row.pace)) if self._row.pace else Pace()
        self._pin = Pin(pin, clock)
        people = Roster(store, self._row, self._pin, clock, wall) if in_class else None
        self._roster = people
        self._people = people or SoloPeople(store, self._row, self._pin, wall)
        self._work = Work(store, clock, wall)
        self._presence = Presence()

    @classmethod
    def in_memory(cls, *, in_class: bool = False, pin: str = "", clock: Clock = time.monotonic) -> Classroom:
        """One that is forgotten at the end."""
        return cls(Store(), in_class=in_class, pin=pin, clock=clock)

    @classmethod
    def in_file(cls, path: Path, *, in_class: bool, pin: str = "") -> Classroom:
        """One that goes on where the file ends."""
        return cls(Store(path), in_class=in_class, pin=pin)

    def close(self) -> None:
        """The server stops; the class goes on when it starts again."""
        self.store.close()

    @property
    def code(self) -> str:
        """What one joins with; empty without a class."""
        return self._row.code

    @property
    def name(self) -> str:
        return self._row.name

    @property
    def opened_at(self) -> float:
        return self._row.opened_at

    @property
    def is_open(self) -> bool:
        return self._row.closed_at is None

    @property
    def door_open(self) -> bool:
        return self._row.door_open

    @property
    def has_pin(self) -> bool:
        return bool(self._pin)

    @property
    def outline(self) -> Outline:
        return self._outline()

    @property
    def pace(self) -> Pace:
        return self._pace

    @property
    def members(self) -> tuple[Member, ...]:
        """The students who are there, by name."""
        return () if self._roster is None else self._roster.students

    @property
    def everybody(self) -> tuple[MemberRow, ...]:
        """All members there ever were, in the order in which they came."""
        return tuple(self.store.members(self._row.id))

    def member(self, browser: str) -> Member | None:
        """Who sits at this browser; None: he has to join."""
        return self._people.member(browser)

    def find(self, member_id: str) -> Member | None:
        return self._people.find(member_id)

    def person(self, browser: str) -> Person:
        """The same as the robot on the table knows him. A visitor of a class must join before he may ask for it."""
        member = self.member(browser)
        return Person(f"visitor {browser_hash(browser)}", "Visitor") if member is None else as_person(member)

    def join(self, browser: str, name: str, code: str) -> Member:
        """Become a member. Whoever is one stays the same."""
        self._require_open()
        member = self._class().join(browser, name, code, door_open=self.door_open)
        self.members_changed.emit(None)
        return member

    def resume(self, browser: str, own_code: str) -> Member:
        """Come back by one's own code."""
        member = self._class().resume(browser, own_code)
        self.members_changed.emit(None)
        return member

    def leave(self, browser: str) -> None:
        """Nobody sits at this browser any more."""
        if self._roster is not None and self._roster.leave(browser) is not None:
            self.members_changed.emit(None)

    def prove(self, browser: str, pin: str) -> str:
        """Become the instructor at this browser; a sentence if that failed, else nothing."""
        refusal = self._people.prove(browser, pin)
        if not refusal:
            self.members_changed.emit(None)
        return refusal

    def rename(self, browser: str, name: str) -> Person:
        """Another name for who works alone."""
        if isinstance(self._people, Roster):
            raise ClassroomRefusal(NAME_STAYS)
        return as_person(self._people.rename(browser, name))

    def is_instructor(self, browser: str) -> bool:
        return self._people.is_instructor(browser)

    def require_instructor(self, by: str) -> Member:
        """Who acts, if that is the instructor."""
        member = self.member(by)
        if member is None or not self.is_instructor(by):
            raise ClassroomRefusal(NOT_INSTRUCTOR)
        return member

    def came(self, browser: str) -> None:
        """A page was opened."""
        self._presence.came(browser)
        self.members_changed.emit(None)

    def went(self, browser: str) -> None:
        """A page was closed."""
        self._presence.went(browser)
        self.members_changed.emit(None)

    def online(self, member_id: str) -> bool:
        """Whether a page of his is open."""
        return member_id in self.online_ids()

    def online_ids(self) -> frozenset[str]:
        """Members with an open page."""
        members = (self.member(browser) for browser in self._presence.browsers())
        return frozenset(member.id for member in members if member is not None)

    def record(self, member: Member, event: Event) -> None:
        """Save what somebody did; it is on disk when this returns."""
        self._require_open()
        if refusal := self._work.why_not(member.id):
            raise ClassroomRefusal(refusal)
        self._people.keep(member)
        self._work.record(member.id, event)
        self.progress_changed.emit(member)

    def progress(self, member: Member) -> Progress:
        return self._work.progress(member.id)

    def seed(self, member: Member, lesson: str, step: int) -> int:
        """Of his numbers in a step: other ones in each attempt."""
        return seed_of_attempt(member.seed, self.progress(member).of(lesson, step).attempt)

    def raise_hand(self, browser: str) -> None:
        """The student at this browser asks for help."""
        self.record(self._here(browser), raised())

    def lower_hand(self, browser: str) -> None:
        self.record(self._here(browser), lowered())

    def set_pace(self, by: str, mode: str, lesson: str = "", step: int = 0, message: str = "") -> None:
        """Let everybody go "free", "up_to" a step, take "all_at" one, or have them "paused" with a message."""
        self.require_instructor(by)
        self._go(new_pace(self._pace, mode, lesson, step, message))

    def go_on(self, by: str) -> None:
        """End a pause: the pace before it comes back."""
        self.require_instructor(by)
        self._go(self._pace.go_on())

    def lower(self, by: str, member_id: str) -> None:
        """The raised hand was seen."""
        self.require_instructor(by)
        self.record(self.student(member_id), lowered())

    def remove(self, by: str, member_id: str) -> None:
        """A student has to join anew; what he did stays in the export."""
        if self.require_instructor(by).id == member_id:
            raise ClassroomRefusal("You cannot remove yourself: leave instead.")
        member = self._class().remove(member_id)
        self.show_no_more_of(member_id)
        self.removed.emit(member)
        self.members_changed.emit(None)

    def rename_member(self, by: str, member_id: str, name: str) -> None:
        self.require_instructor(by)
        self._class().rename(member_id, name)
        self.members_changed.emit(None)

    def close_door(self, by: str) -> None:
        """Nobody joins any more; who is a member may still come back."""
        self._set_door(by, is_open=False)

    def open_door(self, by: str) -> None:
        self._set_door(by, is_open=True)

    def close_class(self, by: str) -> None:
        """The class is over. The next start of the server opens another one in the same file."""
        self.require_instructor(by)
        self._class()
        self._save(replace(self._row, closed_at=self._wall()))
        self.show_nothing()
        self.closed.emit(None)

    def _class(self) -> Roster:
        if self._roster is None:
            raise ClassroomRefusal("There is no class here: start Delta Lab with --classroom.")
        return self._roster

    def _require_open(self) -> None:
        if not self.is_open:
            raise ClassroomRefusal(CLOSED)

    def _here(self, browser: str) -> Member:
        member = self.member(browser)
        if member is None:
            raise ClassroomRefusal("Join the class first.")
        return member

    def _go(self, pace: Pace) -> None:
        self._save(replace(self._row, pace=json.dumps(pace_as_data(pace))))
        self._pace = pace
        self.pace_changed.emit(pace)

    def _set_door(self, by: str, *, is_open: bool) -> None:
        self.require_instructor(by)
        self._class()
        self._save(replace(self._row, door_open=is_open))
        self.door_changed.emit(is_open)

    def _save(self, row: ClassRow) -> None:
        self.store.save_class(row)
        self._row = row


def open_row(store: Store, *, in_class: bool, name: str, now: float) -> ClassRow:
    """The class that is open in this file, or another one."""
    still_open = [row for row in store.classes() if row.solo is not in_class and row.closed_at is None]
    if still_open:
        return still_open[-1]
    code = new_class_code() if in_class else ""
    title = clean_message(name)[:60] or time.strftime("Class of %Y-%m-%d", time.localtime(now))
    return store.add_class(ClassRow(0, not in_class, title if in_class else "", code, secrets.token_bytes(32), now))
