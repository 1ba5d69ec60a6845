"""The control lab of one browser, put together: settings on the right, plots and runs on the left."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

import viser

from app.control.motor import Motor
from app.simulation import Run
from app.ui.bench import Bench
from app.ui.compute import Worker
from app.ui.hardware.access import RobotAccess
from app.ui.lab.desk import ControlDesk
from app.ui.lab.run_book import RunBook
from app.ui.lab.settings import changed, default_settings
from app.ui.lab.traps import TRAPS
from app.ui.panels.lab.board_panel import BoardPanel
from app.ui.panels.lab.control_panel import ControlPanel
from app.ui.panels.lab.motor_panel import MotorPanel
from app.ui.panels.lab.run_panel import RunPanel
from app.ui.panels.lab.run_settings_panel import variants
from app.ui.panels.lab.study_panel import FrequencyPlots, ResponsePlot, StepPlots
from app.ui.playback import Playback
from app.ui.plots import PLOT_STYLE
from app.ui.session import Session
from app.ui.tab_bell import on_tab_opened

PHONE_PLOT_PX = 140
"""On a phone the plots are a section further down, so the response also stands above the sliders, and stays there."""


class ControlRoom:
    """Built when the tab `Control` is opened for the first time: whoever only drags the robot does not pay for it."""

    def __init__(
        self,
        client: viser.ClientHandle,
        session: Session,
        tab: viser.GuiTabHandle,
        bench: Bench,
        quick: Worker,
        slow: Callable[[Callable[[], None] | None], Worker],
        tell: Callable[[str], None],
        access: RobotAccess,
    ) -> None:
        self._client = client
        self._session = session
        self._tab = tab
        self._bench = bench
        self._quick = quick
        self._slow = slow
        self._tell = tell
        self._access = access
        self._runs: RunPanel | None = None
        self._panel: viser.PanelHandle | None = None
        self._desk: ControlDesk | None = None
        self._book: RunBook | None = None
        self._building = self._closed = False
        on_tab_opened(client, "Control", self._open)

    @property
    def run(self) -> Run | None:
        """The run that is shown."""
        return None if self._book is None else self._book.run

    def use_motor(self, robot: str, motor: Motor, origin: str) -> str:
        """Take an identified motor, now or when the tab is opened; returns why not, or nothing."""
        session = self._session
        if robot != session.robot_name:
            return "The page shows another robot than the one with this motor: show that one first."
        if self._desk is not None:
            self._desk.change(motor=motor, motor_origin=origin)
        else:
            settings = session.control or default_settings(robot)
            if settings.robot != robot:
                settings = default_settings(robot)
            session.control = changed(settings, motor=motor, motor_origin=origin)
        return ""

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
        client, session = self._client, self._session
        client.gui.add_html(PLOT_STYLE)
        desk = self._desk = ControlDesk(session, self._quick)
        book = self._book = RunBook(session, self._slow(lambda: book.failed()), self._tell)
        panel = self._bench.add_panel()
        for furnish in (
            lambda: self._add_settings(desk, book),
            lambda: self._add_plots(panel, desk),
            lambda: self._add_runs(panel, desk, book),
            lambda: self._add_motor(panel, desk),
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
        with panel.add_tab("Step", viser.Icon.CHART_LINE):
            StepPlots(self._client, desk)
        with panel.add_tab("Frequency", viser.Icon.WAVE_SINE):
            FrequencyPlots(self._client, desk)

    def _add_runs(self, panel: viser.PanelHandle, desk: ControlDesk, book: RunBook) -> None:
        with panel.add_tab("Run", viser.Icon.PLAYER_PLAY):
            self._runs = RunPanel(self._client, desk, book, Playback(self._session), self._slow(None))

    def _add_motor(self, panel: viser.PanelHandle, desk: ControlDesk) -> None:
        with panel.add_tab("Motor", viser.Icon.ENGINE):
            motor = MotorPanel(self._client, desk, self._slow(lambda: motor.failed()))
