"""Who is who in a class: joining by name and class code, coming back by one's own code, the instructor by PIN."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

from app.classroom.codes import browser_hash, own_code, plain_code, same_secret
from app.classroom.errors import ClassroomRefusal
from app.classroom.limits import Clock, Limit
from app.classroom.names import clean_name, free_name, name_key
from app.classroom.people import TRIES, Member, Pin, new_member_id, new_seed
from app.classroom.store.rows import BrowserRow, ClassRow, MemberRow
from app.classroom.store.store import Store

CAPACITY = 120
LARGEST = 600
"""Members that a class ever has, with those who were removed."""

BROWSERS_EACH = 8
"""From so many a member may work; the one that came first is forgotten for another."""

JOINS, JOINS_OF_ALL = 5, 200
"""A minute, by one browser and by all: a class of 60 comes in seconds, more is no class."""

WRONG_CODES_OF_ALL = 300
"""Wrong codes a minute by all browsers together: of 20 million class codes one is found in a month."""

INSTRUCTOR = "Instructor"
TOO_MANY = "Too many tries: wait a minute, then try again."
NO_NAME = "Type your name: at least one letter or digit."
WRONG_CODE = "This is not the class code: it stands beside the link that your instructor shows."
WRONG_OWN_CODE = "Nobody here has this code: look again, or join with your name."
DOOR_CLOSED = "The door is closed, nobody joins any more: ask your instructor to open it."
FULL = "The class is full: ask your instructor to remove somebody who is not there."
ALREADY = "You are {name} in this browser: leave first to be somebody else."
GONE = "You are no member of this class any more: join again."


@dataclass(frozen=True)
class Seat:
    """Who sits at a browser."""

    member_id: str
    instructor: bool = False


class Roster:
    """The members of one class. Names are unique among those who are there; a browser is one member or none."""

    def __init__(
        self, store: Store, row: ClassRow, pin: Pin, clock: Clock = time.monotonic, wall: Clock = time.time
    ) -> None:
        self._store = store
        self._class = row
        self._pin = pin
        self._wall = wall
        self._rows = {member.id: member for member in store.members(row.id)}
        self._seats = {browser.hash: Seat(browser.member_id, browser.instructor) for browser in store.browsers(row.id)}
        self._names: dict[str, str] = {}
        self._codes: dict[str, str] = {}
        """Plain code -> member."""
        self._own_codes: dict[str, str] = {}
        """Member -> his code, as he sees it."""
        for member in self._rows.values():
            if member.removed_at is None:
                self._index(member)
        self._joins = Limit(JOINS, JOINS_OF_ALL, clock)
        self._wrong_codes = Limit(TRIES, WRONG_CODES_OF_ALL, clock)
        self._wrong_own_codes = Limit(TRIES, WRONG_CODES_OF_ALL, clock)

    @property
    def students(self) -> tuple[Member, ...]:
        """Who is there, by name; without instructors."""
        instructors = {seat.member_id for seat in self._seats.values() if seat.instructor}
        rows = [row for row in self._present() if row.id not in instructors]
        return tuple(_public(row) for row in sorted(rows, key=lambda row: row.name.casefold()))

    @property
    def everybody(self) -> tuple[MemberRow, ...]:
        """All who ever joined, in that order; who was removed too."""
        return tuple(self._rows.values())

    def member(self, browser: str) -> Member | None:
        """Who sits at this browser; None: he has to join."""
        seat = self._seats.get(browser_hash(browser))
        return None if seat is None else self._told(seat)

    def find(self, member_id: str) -> Member | None:
        """Somebody who is there."""
        row = self._rows.get(member_id)
        if row is None or row.removed_at is not None:
            return None
        return _public(row, any(seat.instructor for seat in self._seats.values() if seat.member_id == member_id))

    def is_instructor(self, browser: str) -> bool:
        seat = self._seats.get(browser_hash(browser))
        return seat is not None and seat.instructor

    def join(self, browser: str, name: str, code: str, *, door_open: bool = True) -> Member:
        """Become a member; who is one already stays the same."""
        key = browser_hash(browser)
        if key in self._seats:
            return self._told(self._seats[key])
        self._check_code(key, code)
        if not door_open:
            raise ClassroomRefusal(DOOR_CLOSED)
        cleaned = self._free(name)
        if self._joins.reached(key):
            raise ClassroomRefusal(TOO_MANY)
        if len(self._names) >= CAPACITY or len(self._rows) >= LARGEST:
            raise ClassroomRefusal(FULL)
        self._joins.note(key)
        return self._add(key, cleaned, instructor=False)

    def resume(self, browser: str, code: str) -> Member:
        """Come back, or work from one more browser, by one's own code."""
        key = browser_hash(browser)
        if self._wrong_own_codes.reached(key):
            raise ClassroomRefusal(TOO_MANY)
        member_id = self._codes.get(plain_code(code))
        if member_id is None:
            self._wrong_own_codes.note(key)
            raise ClassroomRefusal(WRONG_OWN_CODE)
        seat = self._seats.get(key)
        if seat is not None and seat.member_id != member_id:
            raise ClassroomRefusal(ALREADY.format(name=self._rows[seat.member_id].name))
        if seat is None:
            self._make_room(member_id)
            self._sit(key, Seat(member_id))
        return self._told(self._seats[key])

    def leave(self, browser: str) -> Member | None:
        """Nobody sits at this browser any more. Who did nothing yet and sits nowhere else is forgotten."""
        key = browser_hash(browser)
        seat = self._seats.pop(key, None)
        if seat is None:
            return None
        self._store.unbind(self._class.id, key)
        row = self._rows[seat.member_id]
        elsewhere = any(other.member_id == row.id for other in self._seats.values())
        if not elsewhere and not self._store.has_events(row.id):
            self._store.delete_member(row.id)
            self._forget(row)
            del self._rows[row.id]
        return _public(row)

    def prove(self, browser: str, pin: str) -> str:
        """Make this browser the instructor's; a sentence if that failed, else nothing. His other browsers are not,
        and who comes back with his code is not either."""
        refusal = self._pin.refusal(browser, pin)
        if refusal:
            return refusal
        key = browser_hash(browser)
        if key in self._seats:
            self._sit(key, replace(self._seats[key], instructor=True))
        else:
            self._add(key, free_name(INSTRUCTOR, self._names), instructor=True)
        return ""

    def remove(self, member_id: str) -> Member:
        """He has to join anew; what he did stays."""
        row = self._present_row(member_id)
        removed = replace(row, removed_at=self._wall())
        self._store.save_member(removed)
        self._store.unbind_member(member_id)
        self._rows[member_id] = removed
        self._seats = {key: seat for key, seat in self._seats.items() if seat.member_id != member_id}
        self._forget(row)
        return _public(removed)

    def rename(self, member_id: str, name: str) -> Member:
        """Give a member another name that is free."""
        row = self._present_row(member_id)
        renamed = replace(row, name=self._free(name, besides=member_id))
        self._store.save_member(renamed)
        self._forget(row)
        self._rows[member_id] = renamed
        self._index(renamed)
        return _public(renamed)

    def keep(self, member: Member) -> None:
        """See to it that he is still there."""
        if self.find(member.id) is None:
            raise ClassroomRefusal(GONE)

    def _check_code(self, key: str, code: str) -> None:
        if self._wrong_codes.reached(key):
            raise ClassroomRefusal(TOO_MANY)
        if not same_secret(plain_code(code), self._class.code):
            self._wrong_codes.note(key)
            raise ClassroomRefusal(WRONG_CODE)

    def _free(self, name: str, besides: str = "") -> str:
        """The name as it is kept."""
        cleaned = clean_name(name)
        key = name_key(cleaned)
        if not key:
            raise ClassroomRefusal(NO_NAME)
        if key.startswith(name_key(INSTRUCTOR)):
            raise ClassroomRefusal("This name is the instructor's: choose another one.")
        if self._names.get(key, besides) != besides:
            suggestion = free_name(cleaned, self._names)
            raise ClassroomRefusal(f"Somebody here is called {cleaned} already: what about {suggestion}?")
        return cleaned

    def _add(self, key: str, name: str, *, instructor: bool) -> Member:
        member_id = new_member_id()
        while plain_code(own_code(self._class.secret, member_id)) in self._codes:
            member_id = new_member_id()
        row = MemberRow(member_id, self._class.id, name, new_seed(), self._wall())
        self._store.add_member(row, BrowserRow(key, member_id, instructor))
        self._rows[member_id] = row
        self._index(row)
        self._seats[key] = Seat(member_id, instructor)
        return self._told(self._seats[key])

    def _sit(self, key: str, seat: Seat) -> None:
        self._store.bind(self._class.id, BrowserRow(key, seat.member_id, seat.instructor))
        self._seats[key] = seat

    def _make_room(self, member_id: str) -> None:
        mine = [key for key, seat in self._seats.items() if seat.member_id == member_id and not seat.instructor]
        for key in mine[: max(0, len(mine) + 1 - BROWSERS_EACH)]:
            self._store.unbind(self._class.id, key)
            del self._seats[key]

    def _present(self) -> list[MemberRow]:
        return [row for row in self._rows.values() if row.removed_at is None]

    def _present_row(self, member_id: str) -> MemberRow:
        row = self._rows.get(member_id)
        if row is None or row.removed_at is not None:
            raise ClassroomRefusal("This student has left the class: choose somebody else.")
        return row

    def _index(self, row: MemberRow) -> None:
        code = own_code(self._class.secret, row.id)
        self._names[name_key(row.name)] = row.id
        self._codes[plain_code(code)] = row.id
        self._own_codes[row.id] = code

    def _forget(self, row: MemberRow) -> None:
        del self._names[name_key(row.name)]
        del self._codes[plain_code(self._own_codes.pop(row.id))]

    def _told(self, seat: Seat) -> Member:
        """A member as he himself is told."""
        row = self._rows[seat.member_id]
        return Member(row.id, row.name, row.seed, seat.instructor, self._own_codes[row.id])


def _public(row: MemberRow, instructor: bool = False) -> Member:
    return Member(row.id, row.name, row.seed, instructor)
