"""The instructor's page: one more side panel. It is made only where the PIN was given."""

from __future__ import annotations

import asyncio

import viser

from app.ui.bench import Bench
from app.ui.classroom.instructor_desk import InstructorDesk
from app.ui.panels.button_grid import STYLE
from app.ui.panels.classroom.board_panel import BoardPanel
from app.ui.panels.classroom.invite_panel import InvitePanel
from app.ui.panels.classroom.pace_panel import PacePanel
from app.ui.panels.classroom.show_panel import ShowPanel
from app.ui.panels.classroom.student_panel import StudentPanel
from app.ui.panels.classroom.table_panel import TablePanel

LOOK_S = 1.0


class InstructorRoom:
    """The panel `Class`, looked at once a second: what has not changed is not sent."""

    def __init__(self, client: viser.ClientHandle, desk: InstructorDesk, bench: Bench) -> None:
        client.gui.add_html(STYLE)
        panel = bench.add_panel(lasting=True)
        with panel.add_tab("Class"):
            self._board = BoardPanel(client, desk)
            self._student = StudentPanel(client, desk)
            self._pace = PacePanel(client, desk)
            self._table = TablePanel(client, desk)
        with panel.add_tab("Show"):
            self._show = ShowPanel(client, desk)
        with panel.add_tab("Invite"):
            self._invite = InvitePanel(client, desk)
        bench.show(panel)
        client.flush()
        self._board.look()
        self._looking = asyncio.get_running_loop().create_task(self._look())

    def close(self) -> None:
        self._looking.cancel()
        for panel in (self._pace, self._show, self._invite):
            panel.close()

    async def _look(self) -> None:
        while True:
            for panel in (self._board, self._student, self._pace, self._table, self._invite):
                panel.look()
            await asyncio.sleep(LOOK_S)
