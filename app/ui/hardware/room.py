"""The tab Hardware of one browser, put together: what drives the robot on the right, what it reports on the left."""

from __future__ import annotations

import asyncio

from app.ui.hardware.offers import Shelf
from app.ui.hardware.surroundings import HardwareSurroundings
from app.ui.panels.button_grid import STYLE
from app.ui.panels.hardware.calibration_panel import CalibrationPanel
from app.ui.panels.hardware.connection_panel import ConnectionPanel
from app.ui.panels.hardware.control_panel import ControlPanel
from app.ui.panels.hardware.drive_panel import DrivePanel
from app.ui.panels.hardware.faults_panel import FaultsPanel
from app.ui.panels.hardware.health_panel import HealthPanel
from app.ui.panels.hardware.jog_panel import JogPanel
from app.ui.panels.hardware.live_panel import LivePanel
from app.ui.panels.hardware.motors_panel import MotorsPanel
from app.ui.panels.hardware.picture_panel import PicturePanel
from app.ui.panels.hardware.program_panel import ProgramPanel
from app.ui.panels.hardware.record_panel import RecordPanel
from app.ui.panels.hardware.settings_panel import SettingsPanel
from app.ui.plots import PLOT_STYLE


class HardwareRoom:
    """Built when the tab is opened for the first time."""

    def __init__(self, surroundings: HardwareSurroundings) -> None:
        self._around = surroundings
        bench = surroundings.bench
        self.desk = surroundings.access.desk
        self._shelf = Shelf(lambda: surroundings.desks.planned_drawing, lambda: surroundings.desks.run)
        self._panel = bench.add_panel()
        self._program: ProgramPanel | None = None
        self._live: LivePanel | None = None
        self._health: HealthPanel | None = None
        self._closed = False
        bench.shown.connect(lambda panel: self._see(panel is self._panel))

    async def build(self) -> None:
        """Panel by panel: others get their turn between them."""
        client = self._around.client
        client.gui.add_html(PLOT_STYLE + STYLE)
        for furnish in (self._add_driving, self._add_work, self._add_reports, self._add_experiments):
            furnish()
            client.flush()
            await asyncio.sleep(0)
            if self._closed:
                return
        self.desk.status_changed.connect(lambda _: client.flush())
        self.show()

    def show(self) -> None:
        self._around.bench.show(self._panel)
        if self._program is not None:
            self._program.look()

    def close(self) -> None:
        self._closed = True
        if self._health is not None:
            self._health.close()

    def _add_driving(self) -> None:
        client, desk, around = self._around.client, self.desk, self._around
        with around.tab:
            ConnectionPanel(client, desk, around.quick())
            ControlPanel(client, desk)
            MotorsPanel(client, desk)
            JogPanel(client, desk)
            PicturePanel(client, desk, around.access.mirror)

    def _add_work(self) -> None:
        client, desk, around = self._around.client, self.desk, self._around
        with around.tab:
            self._program = program = ProgramPanel(client, desk, self._shelf, around.slow(lambda: program.failed()))
            SettingsPanel(client, desk)

    def _add_reports(self) -> None:
        client, desk = self._around.client, self.desk
        with self._panel.add_tab("Live"):
            self._live = LivePanel(client, desk)
            FaultsPanel(client, desk)
            self._health = HealthPanel(client, desk)

    def _add_experiments(self) -> None:
        client, desk, around = self._around.client, self.desk, self._around
        with self._panel.add_tab("Record"):
            record = RecordPanel(client, desk, around.desks.twin, around.slow(lambda: record.failed()))
        with self._panel.add_tab("Drive"):
            drive = DrivePanel(client, desk, around.slow(lambda: drive.failed()), around.desks.use_motor)
        with self._panel.add_tab("Calibrate"):
            calibration = CalibrationPanel(client, desk, around.slow(lambda: calibration.failed()))

    def _see(self, visible: bool) -> None:
        for panel in (self._live, self._health):
            if panel is not None:
                panel.visible = visible
