"""Reading and writing the file. Whatever a method wrote is committed when it returns."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from app.classroom.errors import ClassroomRefusal
from app.classroom.events import Event, Happened
from app.classroom.store.file import open_file
from app.classroom.store.rows import BrowserRow, ClassRow, MemberRow

_MEMBER = "id, class, name, seed, joined_at, removed_at"
_CLASS = "id, solo, name, code, secret, opened_at, closed_at, door_open, pace"


class Store:
    """One file, or the memory (no path), for one server."""

    def __init__(self, path: Path | None = None) -> None:
        self.path = path
        self._db = open_file(path)

    def close(self) -> None:
        self._db.close()

    def classes(self) -> list[ClassRow]:
        """All, the oldest first."""
        return [_class(row) for row in self._db.execute(f"SELECT {_CLASS} FROM class ORDER BY id")]

    def add_class(self, row: ClassRow) -> ClassRow:
        """Open another class; the number is given here."""
        values = (row.solo, row.name, row.code, row.secret, row.opened_at, row.closed_at, row.door_open, row.pace)
        with self._writing():
            columns = _CLASS.removeprefix("id, ")
            cursor = self._db.execute(f"INSERT INTO class ({columns}) VALUES (?, ?, ?, ?, ?, ?, ?, ?)", values)
        assert cursor.lastrowid is not None
        return replace(row, id=cursor.lastrowid)

    def save_class(self, row: ClassRow) -> None:
        """Keep what may change: name, door, pace, and whether it is closed."""
        values = (row.name, row.closed_at, row.door_open, row.pace, row.id)
        with self._writing():
            self._db.execute("UPDATE class SET name = ?, closed_at = ?, door_open = ?, pace = ? WHERE id = ?", values)

    def members(self, class_id: int) -> list[MemberRow]:
        """All who ever joined, in that order."""
        query = f"SELECT {_MEMBER} FROM member WHERE class = ? ORDER BY joined_at, rowid"
        return [MemberRow(*row) for row in self._db.execute(query, (class_id,))]

    def member(self, member_id: str) -> MemberRow | None:
        row = self._db.execute(f"SELECT {_MEMBER} FROM member WHERE id = ?", (member_id,)).fetchone()
        return None if row is None else MemberRow(*row)

    def count_members(self, class_id: int) -> int:
        return self._db.execute("SELECT count(*) FROM member WHERE class = ?", (class_id,)).fetchone()[0]

    def add_member(self, row: MemberRow, browser: BrowserRow) -> None:
        """Somebody new, and where he sits."""
        values = (row.id, row.class_id, row.name, row.seed, row.joined_at, row.removed_at)
        with self._writing():
            self._db.execute(f"INSERT INTO member ({_MEMBER}) VALUES (?, ?, ?, ?, ?, ?)", values)
            self._bind(row.class_id, browser)

    def save_member(self, row: MemberRow) -> None:
        """Keep his name, and whether he was removed."""
        with self._writing():
            values = (row.name, row.removed_at, row.id)
            self._db.execute("UPDATE member SET name = ?, removed_at = ? WHERE id = ?", values)

    def delete_member(self, member_id: str) -> None:
        """Forget somebody, with all that he did."""
        with self._writing():
            self._db.execute("DELETE FROM member WHERE id = ?", (member_id,))

    def browsers(self, class_id: int) -> list[BrowserRow]:
        query = "SELECT hash, member, instructor FROM browser WHERE class = ? ORDER BY rowid"
        return [_browser(row) for row in self._db.execute(query, (class_id,))]

    def browser(self, class_id: int, browser_hash: str) -> BrowserRow | None:
        query = "SELECT hash, member, instructor FROM browser WHERE class = ? AND hash = ?"
        row = self._db.execute(query, (class_id, browser_hash)).fetchone()
        return None if row is None else _browser(row)

    def bind(self, class_id: int, browser: BrowserRow) -> None:
        """Somebody sits at this browser now."""
        with self._writing():
            self._bind(class_id, browser)

    def unbind(self, class_id: int, browser_hash: str) -> None:
        with self._writing():
            self._db.execute("DELETE FROM browser WHERE class = ? AND hash = ?", (class_id, browser_hash))

    def unbind_member(self, member_id: str) -> None:
        """Nobody sits as this member any more."""
        with self._writing():
            self._db.execute("DELETE FROM browser WHERE member = ?", (member_id,))

    def add_event(self, member_id: str, at: float, event: Event, plots: str = "") -> Happened:
        """Something happened; `plots` is its evidence as JSON."""
        values = (member_id, at, event.kind, event.lesson, event.step, json.dumps(dict(event.detail)))
        with self._writing():
            query = "INSERT INTO event (member, at, kind, lesson, step, detail) VALUES (?, ?, ?, ?, ?, ?)"
            number = self._db.execute(query, values).lastrowid
            if plots:
                self._db.execute("INSERT INTO evidence (event, plots) VALUES (?, ?)", (number, plots))
        assert number is not None
        return Happened(number, at, event)

    def events(self, member_id: str) -> Iterator[Happened]:
        """All that he did, in order; without evidence."""
        query = "SELECT id, at, kind, lesson, step, detail FROM event WHERE member = ? ORDER BY id"
        for number, at, kind, lesson, step, detail in self._db.execute(query, (member_id,)):
            yield Happened(number, at, Event(kind, lesson, step, json.loads(detail)))

    def has_events(self, member_id: str) -> bool:
        return self._db.execute("SELECT 1 FROM event WHERE member = ? LIMIT 1", (member_id,)).fetchone() is not None

    def evidence(self, member_id: str) -> dict[int, list[dict]]:
        """His plots by the number of the event."""
        query = "SELECT event, plots FROM evidence JOIN event ON event.id = event WHERE member = ? ORDER BY event"
        return {number: json.loads(plots) for number, plots in self._db.execute(query, (member_id,))}

    def evidence_bytes(self, member_id: str) -> int:
        query = "SELECT total(length(plots)) FROM evidence JOIN event ON event.id = event WHERE member = ?"
        return int(self._db.execute(query, (member_id,)).fetchone()[0])

    def _bind(self, class_id: int, browser: BrowserRow) -> None:
        values = (class_id, browser.hash, browser.member_id, browser.instructor)
        query = "INSERT OR REPLACE INTO browser (class, hash, member, instructor) VALUES (?, ?, ?, ?)"
        self._db.execute(query, values)

    @contextmanager
    def _writing(self) -> Iterator[None]:
        """All of it or nothing; what the disk refuses is told to whoever wanted to write."""
        try:
            self._db.execute("BEGIN IMMEDIATE")
            try:
                yield
                self._db.execute("COMMIT")
            except BaseException:
                if self._db.in_transaction:
                    self._db.execute("ROLLBACK")
                raise
        except sqlite3.OperationalError as error:
            raise ClassroomRefusal(f"This could not be saved ({error}): tell your instructor.") from error


def _class(row: tuple) -> ClassRow:
    number, solo, name, code, secret, opened_at, closed_at, door_open, pace = row
    return ClassRow(number, bool(solo), name, code, secret, opened_at, closed_at, bool(door_open), pace)


def _browser(row: tuple) -> BrowserRow:
    return BrowserRow(row[0], row[1], bool(row[2]))
