"""Who is who without a class: every browser is somebody of its own, and nobody logs in."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

from app.classroom.codes import browser_hash
from app.classroom.errors import ClassroomRefusal
from app.classroom.limits import Clock
from app.classroom.names import clean_name
from app.classroom.people import Member, Pin, new_member_id, new_seed
from app.classroom.store.rows import BrowserRow, ClassRow, MemberRow
from app.classroom.store.store import Store
from app.recent import Recent

REMEMBERED = 500
LARGEST = 2000
"""Browsers whose work is kept. A visitor who does nothing leaves nothing."""

FULL = "This server keeps no more students' work: start it with --data and a new file."


@dataclass(frozen=True)
class _Guest:
    row: MemberRow
    kept: bool
    instructor: bool = False


class SoloPeople:
    """Everybody who works alone; written to the store with the first thing he does."""

    def __init__(self, store: Store, row: ClassRow, pin: Pin, wall: Clock = time.time) -> None:
        self._store = store
        self._class = row
        self._pin = pin
        self._wall = wall
        self._guests: Recent[str, _Guest] = Recent(REMEMBERED)
        self._hashes: Recent[str, str] = Recent(REMEMBERED)
        self._count = store.count_members(row.id)
        self._kept = self._count

    def member(self, browser: str) -> Member:
        """Who sits at this browser; somebody new becomes the next guest."""
        guest = self._guest(browser_hash(browser))
        return Member(guest.row.id, guest.row.name, guest.row.seed, guest.instructor)

    def find(self, member_id: str) -> Member | None:
        """A member whose browser was here lately."""
        key = self._hashes.get(member_id)
        guest = None if key is None else self._guests.get(key)
        return None if guest is None else Member(guest.row.id, guest.row.name, guest.row.seed, guest.instructor)

    def rename(self, browser: str, name: str) -> Member:
        """Call somebody by another name; without a letter the old one stays."""
        key = browser_hash(browser)
        guest = self._guest(key)
        guest = replace(guest, row=replace(guest.row, name=clean_name(name) or guest.row.name))
        if guest.kept:
            self._store.save_member(guest.row)
        self._guests.put(key, guest)
        return self.member(browser)

    def prove(self, browser: str, pin: str) -> str:
        """Make somebody the instructor until the server stops; a sentence if that failed, else nothing."""
        refusal = self._pin.refusal(browser, pin)
        if not refusal:
            key = browser_hash(browser)
            self._guests.put(key, replace(self._guest(key), instructor=True))
        return refusal

    def is_instructor(self, browser: str) -> bool:
        guest = self._guests.get(browser_hash(browser))
        return guest is not None and guest.instructor

    def keep(self, member: Member) -> None:
        """See to it that the store knows him.

        Raises:
            ClassroomRefusal: it keeps too many already.
        """
        key = self._hashes.get(member.id)
        guest = None if key is None else self._guests.get(key)
        if key is None or guest is None:
            if self._store.member(member.id) is None:
                raise ClassroomRefusal("You were away for too long: reload the page.")
            return
        if guest.kept:
            return
        if self._kept >= LARGEST:
            raise ClassroomRefusal(FULL)
        self._store.add_member(guest.row, BrowserRow(key, guest.row.id))
        self._kept += 1
        self._guests.put(key, replace(guest, kept=True))

    def _guest(self, key: str) -> _Guest:
        guest = self._guests.get(key) or self._stored(key) or self._new()
        self._guests.put(key, guest)
        self._hashes.put(guest.row.id, key)
        return guest

    def _stored(self, key: str) -> _Guest | None:
        browser = self._store.browser(self._class.id, key)
        row = None if browser is None else self._store.member(browser.member_id)
        return None if row is None else _Guest(row, kept=True)

    def _new(self) -> _Guest:
        self._count += 1
        row = MemberRow(new_member_id(), self._class.id, f"Guest {self._count}", new_seed(), self._wall())
        return _Guest(row, kept=False)
