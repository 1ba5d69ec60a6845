"""A class as tables for a spreadsheet."""

from __future__ import annotations

import csv
import io
import json
import time
from collections.abc import Iterable, Sequence

from app.classroom.classroom import Classroom
from app.classroom.events import Happened
from app.classroom.outline import step_outline
from app.classroom.progress import progress_of
from app.classroom.store.rows import MemberRow

FORMULA_SIGNS = ("=", "+", "-", "@", "\t", "\r")
"""A cell of text that begins so would be computed by a spreadsheet."""

WHO = ("member", "name", "removed")
EVENT_HEADER = (*WHO, "time", "event", "lesson", "step", "detail")
PROGRESS_HEADER = (
    *WHO,
    "lesson",
    "step",
    "title",
    "attempts",
    "done",
    "predicted",
    "checks",
    "checks_of",
    "acted",
    "tries",
    "right",
    "first_try_right",
    "last_answer",
    "hints",
    "more_right",
    "seconds",
)

Cell = str | float | bool | None


def events_csv(classroom: Classroom) -> str:
    """One row for everything that happened, member by member."""
    store = classroom.store
    return as_csv(
        EVENT_HEADER,
        ([*_who(member), *_event(happened)] for member in classroom.everybody for happened in store.events(member.id)),
    )


def progress_csv(classroom: Classroom) -> str:
    """One row for each member and each step that he has opened."""
    return as_csv(PROGRESS_HEADER, (row for member in classroom.everybody for row in _steps(classroom, member)))


def as_csv(header: Sequence[str], rows: Iterable[Sequence[Cell]]) -> str:
    """A table whose texts stay texts in a spreadsheet."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(header)
    writer.writerows([_cell(value) for value in row] for row in rows)
    return text.getvalue()


def _steps(classroom: Classroom, member: MemberRow) -> Iterable[list[Cell]]:
    progress = progress_of(classroom.store.events(member.id))
    outline = classroom.outline
    for (lesson, number), step in sorted(progress.steps.items()):
        asked = step_outline(outline, lesson, number)
        yield [
            *_who(member),
            lesson,
            number,
            asked.title,
            step.attempt,
            step.done(asked),
            step.predicted,
            len(step.checks),
            asked.checks,
            step.acted,
            step.tries,
            step.right,
            step.first_try_right,
            step.answer,
            step.hints,
            step.more_right,
            round(step.seconds),
        ]


def _who(member: MemberRow) -> list[Cell]:
    return [member.id, member.name, member.removed_at is not None]


def _event(happened: Happened) -> list[Cell]:
    event = happened.event
    when = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(happened.at))
    return [when, event.kind, event.lesson, event.step or None, json.dumps(dict(event.detail))]


def _cell(value: Cell) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)):
        return f"{value:g}" if isinstance(value, float) else str(value)
    return f"'{value}" if value.startswith(FORMULA_SIGNS) else value
