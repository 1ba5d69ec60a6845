"""What the instructor shows and allows: the pace, whose robot is seen, an overlay of all, messages."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, get_args

from app.classroom.errors import ClassroomRefusal

Mode = Literal["free", "up_to", "all_at", "paused"]
MODES = frozenset(get_args(Mode))
OverlayKind = Literal["step_response", "tool_path"]
OVERLAYS = frozenset(get_args(OverlayKind))
LONGEST_MESSAGE = 500


@dataclass(frozen=True)
class Pace:
    """How far a student may go. Lessons are in the order of their keys, steps count from 1."""

    mode: Mode = "free"
    lesson: str = ""
    step: int = 0
    message: str = ""
    before: Pace | None = None
    """While paused: what comes after the pause."""

    @property
    def paused(self) -> bool:
        return self.mode == "paused"

    @property
    def limit(self) -> tuple[str, int] | None:
        """The last lesson and step that is open; None: all are. A pause keeps the limit before it."""
        if self.before is not None:
            return self.before.limit
        return (self.lesson, self.step) if self.mode in ("up_to", "all_at") else None

    def allows(self, lesson: str, step: int) -> bool:
        """Whether a step may be opened."""
        return self.limit is None or (lesson, step) <= self.limit

    def pause(self, message: str) -> Pace:
        """Everybody stops; another message does not forget what was before."""
        before = self.before if self.paused else self
        return Pace("paused", message=message, before=before)

    def go_on(self) -> Pace:
        """The pace before the pause."""
        return self.before or self


def new_pace(now: Pace, mode: str, lesson: str = "", step: int = 0, message: str = "") -> Pace:
    """What the instructor has chosen.

    Raises:
        ClassroomRefusal: there is no such pace.
    """
    text = clean_message(message)
    if mode == "paused":
        return now.pause(text)
    if mode == "free":
        return Pace(message=text)
    if mode not in MODES or not lesson or step < 1:
        raise ClassroomRefusal("Choose the lesson and the step up to which the class may go.")
    return Pace("up_to" if mode == "up_to" else "all_at", lesson[:100], int(step), text)


def pace_as_data(pace: Pace) -> dict[str, object]:
    """For the store."""
    before = None if pace.before is None else pace_as_data(pace.before)
    return {**pace.__dict__, "before": before}


def pace_of(data: dict) -> Pace:
    """From the store."""
    pace = Pace(**data)
    return replace(pace, before=None if data["before"] is None else pace_of(data["before"]))


@dataclass(frozen=True)
class Spotlight:
    """Whose robot all see, and what the page may call it: not whose it is, where the instructor wished so."""

    member_id: str
    title: str
    mine: bool = False
    """It is the instructor's own."""


@dataclass(frozen=True)
class Overlay:
    """Everybody's latest plot of one kind in one picture, without names."""

    kind: OverlayKind
    for_all: bool = False
    """Students see it too."""


@dataclass(frozen=True)
class Message:
    """From the instructor to one member, or to all (None)."""

    text: str
    member_id: str | None = None

    def is_for(self, member_id: str) -> bool:
        return self.member_id in (None, member_id)


def clean_message(text: str) -> str:
    """Short, printable, line breaks kept."""
    lines = text[: 2 * LONGEST_MESSAGE].splitlines()
    printable = ("".join(c if c.isprintable() else " " for c in line).strip() for line in lines)
    return "\n".join(printable).strip()[:LONGEST_MESSAGE]
