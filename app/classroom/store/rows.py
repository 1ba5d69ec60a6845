"""What stands in the file, one row each."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ClassRow:
    """A class, or what everybody who works without one belongs to. Times in s since 1970."""

    id: int
    solo: bool
    name: str
    code: str
    secret: bytes
    opened_at: float
    closed_at: float | None = None
    door_open: bool = True
    pace: str = ""


@dataclass(frozen=True)
class MemberRow:
    """Somebody in a class; who was removed keeps his row."""

    id: str
    class_id: int
    name: str
    seed: int
    joined_at: float
    removed_at: float | None = None


@dataclass(frozen=True)
class BrowserRow:
    """Who sits at a browser, of which only a hash is known, and whether the PIN was given there."""

    hash: str
    member_id: str
    instructor: bool = False
