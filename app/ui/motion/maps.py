"""Maps of the workspace in the tab Motion: settings on the right, numbers on the left, a coloured slice in 3-D."""

from __future__ import annotations

import asyncio
import importlib

from app.ui.motion.map_view import MapView
from app.ui.motion.surroundings import MotionSurroundings
from app.ui.pacing import Paced
from app.ui.panels.motion.map_results_panel import MapResultsPanel
from app.ui.panels.motion.map_settings_panel import MapSettingsPanel

FOLLOW_S = 0.1


class MapRoom:
    """See the module."""

    def __init__(self, surroundings: MotionSurroundings) -> None:
        self._client = surroundings.client
        self._bench = surroundings.bench
        self.desk = surroundings.desks.maps
        self._view = MapView(self._client.scene, self.desk)
        self._results: MapResultsPanel | None = None
        self._front = False
        self._pace = Paced(self._follow_tool, FOLLOW_S)
        surroundings.session.stance_changed.connect(lambda _: self._tool_moved())
        self.desk.answered.connect(lambda _: self._client.flush())
        self._getting_ready = False
        self.desk.changed.connect(lambda _: self._get_ready())

    def add_settings(self) -> None:
        """In the tab."""
        MapSettingsPanel(self._client.gui, self.desk, with_colors=self._bench.on_a_phone)

    def add_results(self) -> None:
        """In a tab of the bench."""
        self._results = MapResultsPanel(self._client.gui, self.desk)
        self.desk.tell_again()

    def show(self) -> None:
        """The tab is in front."""
        self._front = True
        self._view.visible(True)

    def hide(self) -> None:
        self._front = False
        self._view.visible(False)

    def close(self) -> None:
        self._pace.cancel()
        if self._results is not None:
            self._results.close()

    def _tool_moved(self) -> None:
        if self._front and self.desk.picture is not None:
            self._pace.request()

    def _follow_tool(self) -> None:
        self._view.follow_tool()
        if self._results is not None:
            self._results.follow_tool()

    def _get_ready(self) -> None:
        """viser packs pictures with OpenCV, which takes a while to load: not on the event loop."""
        if self.desk.on and not self._getting_ready:
            self._getting_ready = True
            asyncio.get_running_loop().run_in_executor(None, importlib.import_module, "cv2")
