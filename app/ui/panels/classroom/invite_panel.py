"""How students come in, and how the class ends."""

from __future__ import annotations

import html

import viser

from app.ui import downloads
from app.ui.classroom.instructor_desk import InstructorDesk
from app.ui.classroom.invitation import ONLY_HERE, Invitation
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.text import problem, small


class InvitePanel:
    """The tab `Invite`."""

    def __init__(self, client: viser.ClientHandle, desk: InstructorDesk) -> None:
        self._client = client
        self._desk = desk
        client.gui.add_html(invitation_html(desk.hall.invitation))
        self._said = client.gui.add_html("")
        self._grid = ButtonGrid(client, "Class", self._do, desk.tell)
        classroom = desk.classroom
        self._leave = [
            classroom.door_changed.connect(lambda _: self.look()),
            classroom.closed.connect(lambda _: self.look()),
        ]
        self.look()

    def close(self) -> None:
        for leave in self._leave:
            leave()

    def look(self) -> None:
        """Show whether the class is open."""
        classroom = self._desk.classroom
        door, over = classroom.door_open, "" if classroom.is_open else "The class is closed."
        word = over or ("The door is open: whoever has the code may join." if door else "The door is closed.")
        if small(word) != self._said.content:
            self._said.content = small(word)
        sure = self._desk.asks("close")
        self._grid.show(
            [
                Cell(
                    "door", "Close the door" if door else "Open the door", "Who has joined stays and may return", over
                ),
                Cell("export", "Export CSV", "Everybody's progress and all events, in a ZIP file"),
                Cell("close", "Really close?" if sure else "Close class", "Nothing is saved any more", over, "risky"),
            ]
        )

    def _do(self, key: str) -> None:
        desk, classroom = self._desk, self._desk.classroom
        if key == "door":
            deed = classroom.close_door if classroom.door_open else classroom.open_door
            desk.do(lambda: deed(desk.browser))
        elif key == "export":
            desk.do(lambda: downloads.send(self._client, *desk.export()))
        elif desk.sure("close"):
            desk.do(lambda: classroom.close_class(desk.browser))
        self.look()


def invitation_html(invitation: Invitation) -> str:
    """Link, code and QR code, large enough for a projector."""
    link, code = html.escape(invitation.link), html.escape(invitation.code)
    warning = problem(ONLY_HERE) if invitation.only_here else ""
    drawn = f'<div style="max-width:300px;margin:0 auto">{invitation.svg()}</div>'
    return (
        f'<div style="padding:8px 12px;text-align:center">{drawn}'
        f'<div style="font-size:1.05em;overflow-wrap:anywhere;margin-top:6px">{link}</div>'
        f'<div style="font-size:1.5em;font-weight:700;letter-spacing:.15em">{code}</div></div>{warning}'
    )
