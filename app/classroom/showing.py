"""What the instructor puts before everybody: somebody's robot, a picture of all, a message."""

from __future__ import annotations

from abc import ABC, abstractmethod

from app.classroom.errors import ClassroomRefusal
from app.classroom.pace import OVERLAYS, Message, Overlay, OverlayKind, Spotlight, clean_message
from app.classroom.people import Member
from app.signal import Signal


class Showing(ABC):
    """What is shown lasts until it is ended or the server stops."""

    def __init__(self) -> None:
        self.spotlight_changed: Signal[Spotlight | None] = Signal()
        self.overlay_changed: Signal[Overlay | None] = Signal()
        self.message_sent: Signal[Message] = Signal()
        self.spotlight: Spotlight | None = None
        self.overlay: Overlay | None = None

    @abstractmethod
    def require_instructor(self, by: str) -> Member:
        """Who acts at the browser `by`, if that is the instructor."""

    @abstractmethod
    def find(self, member_id: str) -> Member | None:
        """Somebody who is there."""

    def student(self, member_id: str) -> Member:
        """Somebody who must be there."""
        member = self.find(member_id)
        if member is None:
            raise ClassroomRefusal("This student has left the class: choose somebody else.")
        return member

    def show(self, by: str, member_id: str, anonymous: bool = False) -> None:
        """Put a student's robot on every page."""
        self.require_instructor(by)
        member = self.student(member_id)
        self._spot(Spotlight(member.id, "a classmate's robot" if anonymous else f"{member.name}'s robot"))

    def show_mine(self, by: str) -> None:
        """Put the instructor's own robot on every page."""
        self._spot(Spotlight(self.require_instructor(by).id, "your instructor's robot", mine=True))

    def end_spotlight(self, by: str) -> None:
        self.require_instructor(by)
        self._spot(None)

    def show_overlay(self, by: str, kind: OverlayKind, for_all: bool = False) -> None:
        """Put everybody's plots into one picture."""
        self.require_instructor(by)
        if kind not in OVERLAYS:
            raise ClassroomRefusal("There is no such picture of all: choose step responses or tool paths.")
        self._overlay(Overlay(kind, bool(for_all)))

    def end_overlay(self, by: str) -> None:
        self.require_instructor(by)
        self._overlay(None)

    def send(self, by: str, text: str, member_id: str | None = None) -> None:
        """Say something to one student, or to all."""
        self.require_instructor(by)
        cleaned = clean_message(text)
        if not cleaned:
            raise ClassroomRefusal("Type a message first.")
        self.message_sent.emit(Message(cleaned, None if member_id is None else self.student(member_id).id))

    def show_nothing(self) -> None:
        """End the spotlight and the picture of all."""
        self._spot(None)
        self._overlay(None)

    def show_no_more_of(self, member_id: str) -> None:
        """End the spotlight on somebody who leaves."""
        if self.spotlight is not None and self.spotlight.member_id == member_id:
            self._spot(None)

    def _spot(self, spotlight: Spotlight | None) -> None:
        if spotlight != self.spotlight:
            self.spotlight = spotlight
            self.spotlight_changed.emit(spotlight)

    def _overlay(self, overlay: Overlay | None) -> None:
        if overlay != self.overlay:
            self.overlay = overlay
            self.overlay_changed.emit(overlay)
