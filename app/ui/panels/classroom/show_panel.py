"""What everybody sees at once: the instructor's robot, and one picture of all."""

from __future__ import annotations

import html

import viser

from app.classroom.pace import OverlayKind
from app.ui.classroom.crowd_picture import KINDS
from app.ui.classroom.instructor_desk import InstructorDesk
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.text import small


class ShowPanel:
    """The tab `Show`."""

    def __init__(self, client: viser.ClientHandle, desk: InstructorDesk) -> None:
        self._desk = desk
        gui = client.gui
        self._said = gui.add_html("")
        self._grid = ButtonGrid(client, "Show", self._do, desk.tell, columns=2)
        with gui.add_folder("Picture of the whole class"):
            self._for_all = gui.add_checkbox("On every page", False, hint="Students see it too; it has no names")
            self._pictures = ButtonGrid(client, "Picture", self._choose, desk.tell)
            self._picture = gui.add_html("")
        classroom = desk.classroom
        self._leave = [
            classroom.spotlight_changed.connect(lambda _: self.look()),
            classroom.overlay_changed.connect(lambda _: self.look()),
            desk.hall.crowd.changed.connect(self._draw),
        ]
        self.look()
        self._draw(desk.hall.crowd.picture)

        @self._for_all.on_update
        async def _(_: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            if classroom.overlay is not None:
                self._choose(classroom.overlay.kind)

    def close(self) -> None:
        for leave in self._leave:
            leave()

    def look(self) -> None:
        """Show what is shown."""
        classroom = self._desk.classroom
        shown, overlay = classroom.spotlight, classroom.overlay
        said = small("Everybody sees their own robot.")
        if shown is not None:
            said = small(f"Shown: <b>{html.escape(shown.title)}</b>")
        if said != self._said.content:
            self._said.content = said
        self._grid.show(
            [
                Cell("mine", "Show my robot", "On every page, in place of each student's own", tone="main"),
                Cell("end", "End showing", "Everybody has their own robot again", "" if shown else "Nothing is shown."),
            ]
        )
        cells = [Cell(kind, KINDS[kind].title, "One line a student") for kind in KINDS]
        self._pictures.show([*cells, Cell("none", "Hide", "", "" if overlay else "Nothing is shown.")])

    def _do(self, key: str) -> None:
        desk, classroom = self._desk, self._desk.classroom
        if key == "mine":
            desk.do(lambda: classroom.show_mine(desk.browser))
        else:
            desk.do(lambda: classroom.end_spotlight(desk.browser))

    def _choose(self, key: str) -> None:
        desk, classroom = self._desk, self._desk.classroom
        if key == "none":
            desk.do(lambda: classroom.end_overlay(desk.browser))
        else:
            desk.do(lambda: classroom.show_overlay(desk.browser, kind_of(key), self._for_all.value))

    def _draw(self, picture: str) -> None:
        if picture != self._picture.content:
            self._picture.content = picture


def kind_of(key: str) -> OverlayKind:
    """The kind of picture that a button is for."""
    return next(kind for kind in KINDS if kind == key)
