"""The tab `Compare`: quality against speed, one drawing on four robots, and a delta against a serial arm."""

from __future__ import annotations

import viser

from app.ui.compute import Worker
from app.ui.drawing.desk import DrawingDesk
from app.ui.panels.drawing.arm_panel import ArmPanel
from app.ui.panels.drawing.robots_panel import RobotsPanel
from app.ui.panels.drawing.sweep_panel import SweepPanel
from app.ui.series import Series


class ComparePanel:
    """Three folders and their common progress."""

    def __init__(self, client: viser.ClientHandle, desk: DrawingDesk, series: Series, worker: Worker) -> None:
        gui = client.gui
        self._bar = gui.add_progress_bar(0.0, visible=False)
        self._cancel = gui.add_button("Cancel", icon=viser.Icon.X, visible=False)
        SweepPanel(client, desk, series)
        RobotsPanel(gui, desk, series)
        ArmPanel(gui, desk, worker)
        series.progressed.connect(lambda share: self._show(series.busy, share))

        @self._cancel.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            series.cancel()

    def _show(self, busy: bool, share: float) -> None:
        self._bar.visible = self._cancel.visible = busy
        self._bar.value = 100.0 * share
