"""The tab Draw of one browser, put together: what and how to draw on the right, the drawing on the left."""

from __future__ import annotations

import asyncio

from app.ui.drawing.scene import DrawingScene
from app.ui.drawing.surroundings import Surroundings
from app.ui.panels.drawing.compare_panel import ComparePanel
from app.ui.panels.drawing.export_panel import ExportPanel
from app.ui.panels.drawing.laser_panel import LaserPanel
from app.ui.panels.drawing.look_panel import LookPanel
from app.ui.panels.drawing.pen_panel import PenPanel
from app.ui.panels.drawing.play_panel import PlayPanel
from app.ui.panels.drawing.preview_panel import PreviewPanel
from app.ui.panels.drawing.run_panel import RunPanel
from app.ui.panels.drawing.sheet_panel import SheetPanel
from app.ui.panels.drawing.source_panel import SourcePanel
from app.ui.plots import PLOT_STYLE
from app.ui.series import Series

PHONE_PICTURE = "20vh"
"""Height of the drawing that also stands above the settings on a phone, where the panels are far apart."""


class DrawingRoom:
    """Built when the tab is opened for the first time."""

    def __init__(self, surroundings: Surroundings) -> None:
        client, session, desks, gizmo, stage, self._tab, self._bench, access, self._quick, self._slow = surroundings
        self._client = client
        self._access = access
        self.desk, self._player = desks.drawing, desks.player
        self._scene = DrawingScene(client, session, gizmo, stage, self.desk, self._player)
        self._panel = self._bench.add_panel()
        self._plays: list[PlayPanel] = []
        self._closed = False
        self._bench.shown.connect(lambda panel: self._scene.visible(panel is self._panel))

    async def build(self) -> None:
        """Panel by panel: others get their turn between them."""
        self._client.gui.add_html(PLOT_STYLE)
        for furnish in (self._add_drawing, self._add_settings, self._add_comparisons):
            furnish()
            self._client.flush()
            await asyncio.sleep(0)
            if self._closed:
                return
        self.show()
        for signal in (self.desk.sketched, self.desk.planned, self.desk.moved):
            signal.connect(lambda _: self._client.flush())
        self.desk.open()

    def show(self) -> None:
        self._bench.show(self._panel)

    def close(self) -> None:
        self._closed = True
        self._scene.close()
        for play in self._plays:
            play.close()

    def _add_settings(self) -> None:
        client, desk = self._client, self.desk
        with self._tab:
            if self._bench.on_a_phone:
                PreviewPanel(client.gui, desk, height=PHONE_PICTURE, table=False)
                self._add_playing()
            SourcePanel(client, desk)
            LookPanel(client.gui, desk)
            SheetPanel(client.gui, desk, self._scene.placing, self._scene.look)
            PenPanel(client.gui, desk)

    def _add_drawing(self) -> None:
        client, desk = self._client, self.desk
        with self._panel.add_tab("Drawing"):
            PreviewPanel(client.gui, desk)
            if not self._bench.on_a_phone:
                self._add_playing()
            LaserPanel(client.gui, desk)
            ExportPanel(client, desk, self._slow(None))

    def _add_playing(self) -> None:
        self._plays.append(PlayPanel(self._client.gui, self.desk, self._player))
        on_robot = RunPanel(self._client, self.desk, self._slow(lambda: on_robot.failed()), self._show_progress)
        self._access.when_needed(on_robot.furnish)

    def _show_progress(self, share: float) -> None:
        """Ink as far as the robot on the table has come."""
        self._scene.show_ink(share * self._player.duration_s)

    def _add_comparisons(self) -> None:
        with self._panel.add_tab("Compare"):
            series = Series(self._slow(lambda: series.failed()))
            ComparePanel(self._client, self.desk, series, self._quick())
