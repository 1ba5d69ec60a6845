"""The tab Motion of one browser, put together: what the robot shall do on the right, what comes of it on the left."""

from __future__ import annotations

import asyncio
from typing import Protocol

from app.ui.compare.room import CompareRoom
from app.ui.motion.belts_view import BeltsView
from app.ui.motion.maps import MapRoom
from app.ui.motion.path_view import PathView
from app.ui.motion.surroundings import MotionSurroundings
from app.ui.panels.motion.course_panel import CoursePanel
from app.ui.panels.motion.cycle_panel import CyclePanel
from app.ui.panels.motion.motion_csv import offer_csv
from app.ui.panels.motion.motion_plots import STALE_STYLE, MotionPlots
from app.ui.panels.motion.peaks_table import PeaksTable
from app.ui.panels.motion.play_bar import PlayBar
from app.ui.panels.motion.verdict_panel import VerdictPanel
from app.ui.plots import PLOT_STYLE


class Annex(Protocol):
    """A room inside this one: a folder of settings on the right, a tab of results on the left, something in 3-D."""

    def add_settings(self) -> None: ...
    def add_results(self) -> None: ...
    def show(self) -> None:
        """The tab Motion is in front."""
        ...

    def hide(self) -> None: ...
    def close(self) -> None: ...


class MotionRoom:
    """Built when the tab is opened for the first time."""

    def __init__(self, surroundings: MotionSurroundings) -> None:
        self._surroundings = surroundings
        self._client = surroundings.client
        self._bench = surroundings.bench
        self.desk = surroundings.desks.motion
        self._path = PathView(self._client.scene, self.desk)
        self._panel = self._bench.add_panel()
        self._bars: list[PlayBar] = []
        self._belts = BeltsView(self._client.scene, self.desk)
        self._annexes: list[tuple[str, Annex]] = [
            ("Compare", CompareRoom(surroundings)),
            ("Map", MapRoom(surroundings)),
        ]
        self._front = self._closed = False
        self.desk.playback.playing_changed.connect(lambda _: self._show_handles())
        self._bench.shown.connect(lambda panel: self._come_to_front(panel is self._panel))

    async def build(self) -> None:
        """Panel by panel: others get their turn between them."""
        self._client.gui.add_html(PLOT_STYLE + STALE_STYLE)
        for furnish in (self._add_settings, self._add_plan, self._add_annexes):
            furnish()
            self._client.flush()
            await asyncio.sleep(0)
            if self._closed:
                return
        self.show()
        self.desk.planned.connect(lambda _: self._client.flush())
        self.desk.refused.connect(lambda _: self._client.flush())
        self.desk.open()

    def show(self) -> None:
        self._bench.show(self._panel)

    def close(self) -> None:
        self._closed = True
        for bar in self._bars:
            bar.close()
        self._belts.close()
        for _, annex in self._annexes:
            annex.close()

    def _come_to_front(self, front: bool) -> None:
        """Or make room for another lab: then nothing here moves the robot any more."""
        self._path.visible(front)
        self._belts.visible(front)
        if not front:
            self.desk.playback.pause()
        self._front = front
        for _, annex in self._annexes:
            annex.show() if front else annex.hide()

    def _show_handles(self) -> None:
        """While the robot moves by itself, its handles would hide what it does."""
        if self._front:
            self._surroundings.gizmo.visible(not self.desk.playback.playing)

    def _add_settings(self) -> None:
        gui, desk = self._client.gui, self.desk
        with self._surroundings.tab:
            if self._bench.on_a_phone:
                self._add_playing()
            CoursePanel(gui, desk, tell=self._bench.on_a_phone)
            CyclePanel(gui, desk)

    def _add_plan(self) -> None:
        gui, desk = self._client.gui, self.desk
        with self._panel.add_tab("Plan"):
            if not self._bench.on_a_phone:
                self._add_playing()
            PeaksTable(gui, desk)
            MotionPlots(gui, desk)
            offer_csv(self._client, desk, self._surroundings.slow(None))

    def _add_annexes(self) -> None:
        for label, annex in self._annexes:
            with self._surroundings.tab:
                annex.add_settings()
            with self._panel.add_tab(label):
                annex.add_results()

    def _add_playing(self) -> None:
        gui, desk = self._client.gui, self.desk
        VerdictPanel(gui, desk)
        bar = PlayBar(gui, desk.playback, lambda: desk.motion)
        desk.settings_changed.connect(lambda _: bar.fit())
        self._bars.append(bar)
