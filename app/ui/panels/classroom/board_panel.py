"""The live board: it is looked at once a second, and sent when it has changed."""

from __future__ import annotations

import viser

from app.classroom.board import BoardRow, histogram
from app.ui.classroom.instructor_desk import InstructorDesk
from app.ui.panels.classroom.board_table import STYLE, bars, board_table, summary
from app.ui.viser_adapter import element_id


class BoardPanel:
    """Who is where, and who needs help. A press on a name chooses him."""

    def __init__(self, client: viser.ClientHandle, desk: InstructorDesk) -> None:
        self._desk = desk
        gui = client.gui
        gui.add_html(STYLE)
        self._wire = gui.add_text("Student pressed", "", visible=False)
        self._summary = gui.add_html("")
        self._table = gui.add_html("")
        with gui.add_folder("Where everybody is", expand_by_default=False):
            self._bars = gui.add_html("")
        desk.chosen_changed.connect(lambda _: self.look())

        @self._wire.on_update
        async def _(event: viser.GuiEvent[viser.GuiTextHandle]) -> None:
            desk.choose(event.target.value.partition(" ")[0])

    def look(self) -> None:
        """Show how things are now."""
        rows = self._desk.rows()
        chosen = self._desk.chosen
        self._show(rows, chosen.id if chosen is not None else "")

    def _show(self, rows: tuple[BoardRow, ...], chosen: str) -> None:
        outline = self._desk.classroom.outline
        for shown, content in (
            (self._summary, summary(rows)),
            (self._table, board_table(rows, chosen, element_id(self._wire))),
            (self._bars, bars(histogram(rows, outline))),
        ):
            if shown.content != content:
                shown.content = content
