"""Controllers compared, put together: settings in the tab Motion on the right, results on the left."""

from __future__ import annotations

import viser

from app.ui.compare.jobs import comparison_csv
from app.ui.compare.scene import CompareScene
from app.ui.downloads import send
from app.ui.motion.surroundings import MotionSurroundings
from app.ui.panels.compare.effects_panel import EffectsPanel
from app.ui.panels.compare.play_panel import PlayPanel
from app.ui.panels.compare.results_panel import ResultsPanel
from app.ui.panels.compare.run_bar import RunBar
from app.ui.panels.compare.standings import Standings
from app.ui.panels.compare.task_panel import TaskPanel


class CompareRoom:
    """Built with the tab Motion."""

    def __init__(self, surroundings: MotionSurroundings) -> None:
        self._client = surroundings.client
        self._bench = surroundings.bench
        self.desk = surroundings.desks.compare
        self._scene = CompareScene(surroundings, self.desk)
        self._files = surroundings.slow(None)
        self._play: PlayPanel | None = None
        for signal in (self.desk.answered, self.desk.looked):
            signal.connect(lambda _: self._client.flush())

    def add_settings(self) -> None:
        """In the tab on the right."""
        gui = self._client.gui
        with gui.add_folder("Compare controllers", expand_by_default=False):
            TaskPanel(gui, self.desk)
            EffectsPanel(gui, self.desk)
            RunBar(gui, self.desk)
            if self._bench.on_a_phone:
                Standings(gui, self.desk)

    def add_results(self) -> None:
        """In a tab on the left."""
        gui = self._client.gui
        self._play = PlayPanel(gui, self.desk, self._scene)
        ResultsPanel(gui, self.desk)
        self._add_file()
        self.desk.tell_again()

    def show(self) -> None:
        self._scene.visible(True)

    def hide(self) -> None:
        self._scene.visible(False)

    def close(self) -> None:
        self._scene.close()
        if self._play is not None:
            self._play.close()

    def _add_file(self) -> None:
        button = self._client.gui.add_button("Save all runs as CSV", icon=viser.Icon.DOWNLOAD, color="gray")
        button.visible = False
        self.desk.answered.connect(lambda compared: setattr(button, "visible", bool(compared and compared.results)))

        @button.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            compared = self.desk.comparison
            if compared is not None:
                runs = [result.run for result in compared.results.values()]
                name = f"comparison-{compared.settings.robot}-{compared.settings.task}.csv"
                self._files.request(lambda content: send(self._client, name, content), comparison_csv, runs)
