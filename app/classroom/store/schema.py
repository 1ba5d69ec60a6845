"""The tables, as a list of steps from an empty file to what this version of the app needs."""

from __future__ import annotations

APPLICATION_ID = 0x444C4142
"""Stands in the file's header ("DLAB"): nobody else's file is taken for ours."""

_FIRST = (
    """CREATE TABLE class (
        id INTEGER PRIMARY KEY,
        solo INTEGER NOT NULL,
        name TEXT NOT NULL,
        code TEXT NOT NULL,
        secret BLOB NOT NULL,
        opened_at REAL NOT NULL,
        closed_at REAL,
        door_open INTEGER NOT NULL DEFAULT 1,
        pace TEXT NOT NULL DEFAULT ''
    )""",
    """CREATE TABLE member (
        id TEXT PRIMARY KEY,
        class INTEGER NOT NULL REFERENCES class (id),
        name TEXT NOT NULL,
        seed INTEGER NOT NULL,
        joined_at REAL NOT NULL,
        removed_at REAL
    )""",
    """CREATE TABLE browser (
        class INTEGER NOT NULL REFERENCES class (id),
        hash TEXT NOT NULL,
        member TEXT NOT NULL REFERENCES member (id) ON DELETE CASCADE,
        instructor INTEGER NOT NULL DEFAULT 0,
        PRIMARY KEY (class, hash)
    )""",
    """CREATE TABLE event (
        id INTEGER PRIMARY KEY,
        member TEXT NOT NULL REFERENCES member (id) ON DELETE CASCADE,
        at REAL NOT NULL,
        kind TEXT NOT NULL,
        lesson TEXT NOT NULL,
        step INTEGER NOT NULL,
        detail TEXT NOT NULL
    )""",
    "CREATE INDEX event_of_member ON event (member)",
)
_EVIDENCE_APART = (  # progress is read from all events, and does not need to read through plots
    """CREATE TABLE evidence (
        event INTEGER PRIMARY KEY REFERENCES event (id) ON DELETE CASCADE,
        plots TEXT NOT NULL
    )""",
    """INSERT INTO evidence
        SELECT id, json_extract(detail, '$.evidence') FROM event
        WHERE json_extract(detail, '$.evidence') IS NOT NULL""",
    "UPDATE event SET detail = json_remove(detail, '$.evidence')",
)

MIGRATIONS = (_FIRST, _EVIDENCE_APART)
"""Statements that lead from version n to n + 1; never change one that a release has had, add another."""

VERSION = len(MIGRATIONS)
