"""Run, progress, cancel."""

from __future__ import annotations

import viser

from app.ui.compare.desk import CompareDesk


class RunBar:
    """The button that starts a comparison, and what stands below it meanwhile."""

    def __init__(self, gui: viser.GuiApi, desk: CompareDesk) -> None:
        self._go = gui.add_button("Compare them", icon=viser.Icon.SCALE, color="blue")
        self._bar = gui.add_progress_bar(0.0, animated=True, visible=False)
        self._cancel = gui.add_button("Cancel the comparison", icon=viser.Icon.X, visible=False)
        self._desk = desk
        desk.series.progressed.connect(self._show_progress)

        @self._go.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            desk.run()

        @self._cancel.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            desk.cancel()

    def _show_progress(self, share: float) -> None:
        busy = self._desk.busy
        self._bar.value = max(100.0 * share, 3.0)
        self._bar.visible = self._cancel.visible = busy
