"""The control lab of one browser, put together: settings on the right, plots and runs on the left."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

import viser

from app.ui.bench import Bench
from app.ui.compute import Worker
from app.ui.desks import Desks
from app.ui.hardware.access import RobotAccess
from app.ui.lab.desk import ControlDesk
from app.ui.lab.run_book import RunBook
from app.ui.lab.traps import TRAPS
from app.ui.panels.lab.board_panel import BoardPanel
from app.ui.panels.lab.control_panel import ControlPanel
from app.ui.panels.lab.motor_panel import MotorPanel
from app.ui.panels.lab.run_panel import RunPanel
from app.ui.panels.lab.run_settings_panel import variants
from app.ui.panels.lab.study_panel import FrequencyPlots, ResponsePlot, StepPlots
from app.ui.plots import PLOT_STYLE
from app.ui.tabs import Tabs

PHONE_PLOT_PX = 140
"""On a phone the plots are a section further down, so the response also stands above the sliders, and stays there."""


class ControlRoom:
    """Built when the tab `Control` is opened for the first time: whoever only drags the robot does not pay for it."""

    def __init__(
        self,
        client: viser.ClientHandle,
        tabs: Tabs,
        tab: viser.GuiTabHandle,
        bench: Bench,
        desks: Desks,
        slow: Callable[[Callable[[], None] | None], Worker],
        access: RobotAccess,
    ) -> None:
        self._client = client
        self._tab = tab
        self._bench = bench
        self._desks = desks
        self._slow = slow
        self._access = access
        self._runs: RunPanel | None = None
        self._panel: viser.PanelHandle | None = None
        self._building = self._closed = False
        tabs.listen("Control", self._open)

    def close(self) -> None:
        self._closed = True
        if self._runs is not None:
            self._runs.close()

    async def _open(self) -> None:
        if self._panel is not None:
            self._bench.show(self._panel)
        elif not self._building:
            self._building = True
            await self._build()

    async def _build(self) -> None:
        """Panel by panel: others get their turn between them."""
        client, desk, book = self._client, self._desks.control, self._desks.runs
        client.gui.add_html(PLOT_STYLE)
        panel = self._bench.add_panel()
        for furnish in (
            lambda: self._add_settings(desk, book),
            lambda: self._add_plots(panel, desk),
            lambda: self._add_runs(panel, desk, book),
            lambda: self._add_motor(panel),
        ):
            furnish()
            client.flush()
            await asyncio.sleep(0)
            if self._closed:
                return
        self._panel = panel
        self._bench.show(panel)
        desk.answered.connect(lambda _: client.flush())
        desk.open()

    def _add_settings(self, desk: ControlDesk, book: RunBook) -> None:
        client = self._client

        def run_all(trap: str) -> None:
            book.request(*variants(desk.settings, TRAPS[trap].runs))

        with self._tab:
            if self._bench.on_a_phone:
                ResponsePlot(client.gui, desk, PHONE_PLOT_PX)
            ControlPanel(client.gui, desk, run_all, lambda: self._add_board(desk))

    def _add_board(self, desk: ControlDesk) -> None:
        board = BoardPanel(self._client, desk, self._slow(lambda: board.failed()))
        self._access.when_needed(board.furnish)

    def _add_plots(self, panel: viser.PanelHandle, desk: ControlDesk) -> None:
        with panel.add_tab("Step"):
            StepPlots(self._client, desk)
        with panel.add_tab("Frequency"):
            FrequencyPlots(self._client, desk)

    def _add_runs(self, panel: viser.PanelHandle, desk: ControlDesk, book: RunBook) -> None:
        with panel.add_tab("Run"):
            self._runs = RunPanel(self._client, desk, book, self._desks.run_playback, self._slow(None))

    def _add_motor(self, panel: viser.PanelHandle) -> None:
        with panel.add_tab("Motor"):
            MotorPanel(self._client, self._desks.motor)
