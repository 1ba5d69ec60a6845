"""What one browser has of the class: the card to join with, pauses, messages, and somebody else's robot."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import TYPE_CHECKING

import viser

from app.classroom.errors import ClassroomRefusal
from app.classroom.pace import Message, OverlayKind
from app.classroom.people import Member
from app.robots import Robot
from app.ui.classroom import class_script
from app.ui.classroom.guest_view import GuestView
from app.ui.classroom.lines import Line
from app.ui.session import Session
from app.ui.state import Stance
from app.ui.viser_adapter import element_id, run_javascript

if TYPE_CHECKING:
    from app.ui.classroom.hall import Hall

MESSAGE_TITLE = "From your instructor"
REMOVED = "Your instructor has taken you out of the class: join again with your name."
CLOSED = "The class is over. Your report can still be downloaded."
LOOK_UP = "Look at the front, please."


class ClassPage:
    """One page. It does not know who it is until its browser has joined."""

    def __init__(
        self, client: viser.ClientHandle, hall: Hall, browser: str, session: Session, guests: GuestView
    ) -> None:
        self.session = session
        self.browser = browser
        self._client = client
        self._hall = hall
        self._classroom = classroom = hall.classroom
        self._guests = guests
        self._furnish: Callable[[], None] | None = None
        self._line: Callable[[OverlayKind], Line | None] = lambda _: None
        self._shown = {"veil": class_script.pause(None), "banner": class_script.banner("")}
        self._shown["picture"] = class_script.picture("")
        self.member: Member | None = None
        """None before somebody has joined here."""
        self._id = ""
        wire = client.gui.add_text("Class said", "", visible=False)
        run_javascript(client, class_script.start(element_id(wire)))
        self._leave = [
            classroom.members_changed.connect(lambda _: self._follow()),
            classroom.removed.connect(self._removed),
            classroom.pace_changed.connect(lambda _: self._show()),
            classroom.spotlight_changed.connect(lambda _: self._show()),
            classroom.closed.connect(lambda _: self._show()),
            classroom.message_sent.connect(self._hear_message),
            classroom.overlay_changed.connect(lambda _: self._show_picture()),
            hall.crowd.changed.connect(lambda _: self._show_picture()),
        ]
        hall.enter(self)
        classroom.came(browser)
        self._follow()

        @wire.on_update
        async def _(event: viser.GuiEvent[viser.GuiTextHandle]) -> None:
            self.hear(event.target.value)

    def close(self) -> None:
        for leave in self._leave:
            leave()
        self._hall.leave(self)
        self._classroom.went(self.browser)

    def hear(self, said: str) -> None:
        """From the card, or from whoever can write to it."""
        try:
            what = json.loads(said)
        except (ValueError, RecursionError):
            return
        if not isinstance(what, dict):
            return
        if refusal := self._try({key: _sound(value) for key, value in what.items() if isinstance(value, str)}):
            self._ask(refusal)
        self._follow()

    def when_instructor(self, furnish: Callable[[], None]) -> None:
        """Call this once, now or as soon as the instructor sits here."""
        self._furnish = furnish
        self._follow()

    def draw_lines(self, line: Callable[[OverlayKind], Line | None]) -> None:
        """Where this page's line in the picture of all comes from."""
        self._line = line

    def line(self, kind: OverlayKind) -> Line | None:
        """What this page shows now; None where it shows nothing of the kind."""
        return self._line(kind)

    def show_guest(self, robot: Robot, stance: Stance) -> None:
        """Show somebody else's robot in place of the page's own."""
        self._guests.show(robot, stance)

    def end_guest(self) -> None:
        self._guests.end()

    def _try(self, said: dict[str, str]) -> str:
        """Returns why not, or nothing."""
        classroom, browser = self._classroom, self.browser
        try:
            match said:
                case {"do": "join", "name": name, "code": code}:
                    classroom.join(browser, name, code)
                case {"do": "resume", "code": code}:
                    classroom.resume(browser, code)
                case {"do": "prove", "pin": pin}:
                    return classroom.prove(browser, pin)
                case {"do": "open", "key": key}:
                    return self._hall.open_instructor(browser, key)
        except ClassroomRefusal as refusal:
            return str(refusal)
        return ""

    def _follow(self) -> None:
        """Who sits here."""
        before, self.member = self.member, self._classroom.member(self.browser)
        if self.member is not None:
            self._id = self.member.id
            self._send("card", class_script.done())
            if self.member.instructor and self._furnish is not None:
                furnish, self._furnish = self._furnish, None
                furnish()
        elif before is not None or "card" not in self._shown:
            self._ask()
        self._show()

    def _removed(self, member: Member) -> None:
        """The others hear of this too, before or after they hear that the members have changed."""
        if member.id == self._id:
            self._id, self.member = "", None
            self._ask(REMOVED)
            self._show()

    def _ask(self, sentence: str = "") -> None:
        """Show the card."""
        self.end_guest()
        self._shown.pop("card", None)
        self._send("card", class_script.ask(sentence))

    def _show(self) -> None:
        """Veil and banner."""
        pace, student = self._classroom.pace, self.member is not None and not self.member.instructor
        self._send("veil", class_script.pause((pace.message or LOOK_UP) if student and pace.paused else None))
        self._send("banner", class_script.banner(*self._banner()))
        self._show_picture()

    def _show_picture(self) -> None:
        """The picture of all, where students see it too; the instructor has it in his panel."""
        overlay, student = self._classroom.overlay, self.member is not None and not self.member.instructor
        wanted = overlay is not None and overlay.for_all and student
        kind = overlay.kind if overlay is not None else ""
        self._send("picture", class_script.picture(self._hall.crowd.picture if wanted else "", kind))

    def _banner(self) -> tuple[str, class_script.Tone]:
        shown, me = self._classroom.spotlight, self.member
        if not self._classroom.is_open:
            return CLOSED, "warning"
        if shown is None or me is None:
            return "", "info"
        if shown.member_id != me.id:
            return f"You see {shown.title}", "info"
        return ("Everybody sees your robot", "warning")

    def _hear_message(self, message: Message) -> None:
        if self.member is not None and not self.member.instructor and message.is_for(self.member.id):
            self._client.add_notification(MESSAGE_TITLE, message.text, color="blue", auto_close_seconds=None)
            self._client.flush()

    def _send(self, part: str, script: str) -> None:
        """Nothing is sent where a part of the page stays as it is."""
        if self._shown.get(part) != script:
            self._shown[part] = script
            run_javascript(self._client, script)
            self._client.flush()


def _sound(text: str) -> str:
    """Without the halves of characters that JSON lets through and nothing else takes."""
    return text.encode(errors="replace").decode()
