"""The live board: who is where, who needs help, and how many are at each step."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import dataclass

from app.classroom.classroom import Classroom
from app.classroom.outline import Outline, step_outline
from app.classroom.people import Member
from app.classroom.progress import Progress


@dataclass(frozen=True)
class BoardRow:
    """One student. Steps count from 1; no lesson: he has not begun."""

    member_id: str
    name: str
    lesson: str
    step: int
    checks: int
    """Met so far in this step."""
    checks_of: int
    seconds: float
    """Spent on this step."""
    stuck_s: float | None
    """For how long he has been stuck; None: he is not."""
    hand_s: float | None
    """For how long his hand has been raised."""
    holds_robot: bool
    online: bool
    share: float
    """0 to 1: of the course."""


@dataclass(frozen=True)
class Bar:
    """Who is at one step."""

    lesson: str
    step: int
    title: str
    names: tuple[str, ...]

    @property
    def count(self) -> int:
        return len(self.names)


def board(classroom: Classroom, holder_key: str = "", now: float | None = None) -> tuple[BoardRow, ...]:
    """All students of a class, who needs help first. `holder_key` is the person who holds the robot on the table."""
    outline, online = classroom.outline, classroom.online_ids()
    when = time.time() if now is None else now
    rows = (
        board_row(member, classroom.progress(member), outline, when, member.id in online, member.id == holder_key)
        for member in classroom.members
    )
    return by_need(rows)


def board_row(
    member: Member, progress: Progress, outline: Outline, now: float, online: bool, holds_robot: bool = False
) -> BoardRow:
    """One student at the time `now`, in s since 1970. Who is away is not stuck."""
    lesson, step = progress.lesson, progress.step
    stuck_since = progress.stuck_since(outline, now) if online else None
    checks_of = step_outline(outline, lesson, step).checks
    return BoardRow(
        member.id,
        member.name,
        lesson,
        step,
        min(len(progress.of(lesson, step).checks), checks_of),
        checks_of,
        progress.seconds_here(now) if online else progress.of(lesson, step).seconds,
        None if stuck_since is None else now - stuck_since,
        None if progress.hand_since is None else now - progress.hand_since,
        holds_robot,
        online,
        progress.share(outline),
    )


def by_need(rows: Iterable[BoardRow]) -> tuple[BoardRow, ...]:
    """Raised hands first, then who is stuck, the longest first; then who is there, then who is away, by name."""
    return tuple(sorted(rows, key=_need))


def histogram(rows: Iterable[BoardRow], outline: Outline) -> tuple[Bar, ...]:
    """How many students are at each step, in the order of the course; only steps at which somebody is."""
    names: dict[tuple[str, int], list[str]] = {}
    for row in rows:
        if row.lesson:
            names.setdefault((row.lesson, row.step), []).append(row.name)
    return tuple(
        Bar(*place, step_outline(outline, *place).title, tuple(sorted(names[place], key=str.casefold)))
        for place in sorted(names)
    )


def _need(row: BoardRow) -> tuple[int, float, str]:
    if row.hand_s is not None:
        return 0, -row.hand_s, row.name.casefold()
    if row.stuck_s is not None:
        return 1, -row.stuck_s, row.name.casefold()
    return (2 if row.online else 3), 0.0, row.name.casefold()
