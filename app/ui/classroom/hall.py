"""All pages of a class: whose they are, and what goes from one of them to the others."""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Callable, Iterator

from app.classroom.classroom import Classroom
from app.classroom.pace import OverlayKind, Spotlight
from app.ui.classroom.class_page import ClassPage
from app.ui.classroom.crowd import Crowd
from app.ui.classroom.invitation import Invitation
from app.ui.classroom.lines import Line
from app.ui.classroom.spotlight import Spotlight as Lamp
from app.ui.session import Session
from app.ui.shape_cache import ShapeCache

KEY_USED = "This link has been used already: give the PIN."


class Hall:
    """One a server."""

    def __init__(
        self, classroom: Classroom, pin: str, shapes: ShapeCache, invitation: Callable[[], Invitation]
    ) -> None:
        self.classroom = classroom
        self._pin = pin
        self._invitation = invitation
        self.pages: list[ClassPage] = []
        self._lamp = Lamp(self._shown_session, self._viewers, shapes)
        self._key = secrets.token_urlsafe()
        self.crowd = Crowd(self._lines)
        classroom.spotlight_changed.connect(self._turn_lamp)
        classroom.overlay_changed.connect(self.crowd.follow)

    @property
    def invitation(self) -> Invitation:
        return self._invitation()

    @property
    def instructor_url(self) -> str:
        """Opens the instructor's page without the PIN, once: for the browser of this computer."""
        invitation = self.invitation
        host = "localhost" if invitation.only_here or invitation.everywhere else invitation.host
        return f"http://{host}:{invitation.port}/?instructor={self._key}"

    def open_instructor(self, browser: str, key: str) -> str:
        """Make a browser the instructor's that has the key of `instructor_url`, which is worth nothing from then on.
        Returns why not, or nothing."""
        if self.classroom.is_instructor(browser):
            return ""
        if not hmac.compare_digest(key.encode(), self._key.encode()):
            return KEY_USED
        self._key = secrets.token_urlsafe()
        return self.classroom.prove(browser, self._pin)

    def enter(self, page: ClassPage) -> None:
        """A page was opened."""
        self.pages.append(page)

    def leave(self, page: ClassPage) -> None:
        self.pages.remove(page)

    def _lines(self, kind: OverlayKind) -> list[Line]:
        """What the students' pages show now, one line each, without names."""
        found: dict[str, Line] = {}
        for page in self.pages:
            member = page.member
            line = page.line(kind) if member is not None and not member.instructor else None
            if member is not None and line is not None:
                found[member.id] = line
        return list(found.values())

    def _shown_session(self) -> Session | None:
        """Of the newest page of whoever is shown."""
        return next((page.session for page in reversed(self.pages) if self._is_shown(page)), None)

    def _viewers(self) -> Iterator[ClassPage]:
        return (page for page in self.pages if not self._is_shown(page) and page.member is not None)

    def _is_shown(self, page: ClassPage) -> bool:
        shown = self.classroom.spotlight
        return shown is not None and page.member is not None and page.member.id == shown.member_id

    def _turn_lamp(self, shown: Spotlight | None) -> None:
        if shown is None:
            self._lamp.end()
        else:
            self._lamp.begin()
        for page in self.pages:
            if shown is None or self._is_shown(page):
                page.end_guest()
