"""The tab `Run`: the whole robot under its controllers, played in 3-D, plotted, kept to compare."""

from __future__ import annotations

import numpy as np
import viser

from app.robots import ROBOTS
from app.simulation import Run
from app.ui import theme
from app.ui.compute import Worker
from app.ui.downloads import send
from app.ui.lab.desk import ControlDesk
from app.ui.lab.jobs import run_csv
from app.ui.lab.run_book import RunBook
from app.ui.panels.lab.playback_panel import PlaybackPanel
from app.ui.panels.lab.run_settings_panel import RunSettingsPanel
from app.ui.panels.lab.runs_table import runs_table
from app.ui.panels.options import show_options
from app.ui.playback import Playback
from app.ui.plots import DASHED, Axes, Curve, Plot
from app.ui.run_view import RunView

ALL = "All drives"
NO_RUN = "None yet"
STRETCHES = {"Whole run": (0.0, np.inf), "First 5 s": (0.0, 5.0), "After 5 s": (5.0, np.inf)}
POINTS = 350


class RunPanel:
    """Everything about runs of one browser."""

    def __init__(
        self, client: viser.ClientHandle, desk: ControlDesk, book: RunBook, playback: Playback, worker: Worker
    ) -> None:
        """
        Args:
            playback: has the run that is shown already when this panel hears of it.
        """
        self._client = client
        self._book = book
        self._worker = worker
        gui = client.gui
        self._view = RunView(client.scene)
        RunSettingsPanel(gui, desk, book)
        with gui.add_folder("Playback"):
            self._playback_panel = PlaybackPanel(gui, playback, self._view)
        self._plots = RunPlots(gui)
        self._choice = gui.add_dropdown("Run shown", _options(NO_RUN), visible=False)
        self._table = gui.add_html("")
        self._save = gui.add_button("Save this run as CSV", icon=viser.Icon.DOWNLOAD, visible=False)
        self._forget = gui.add_button("Forget all runs", icon=viser.Icon.ERASER, visible=False)
        book.selected.connect(self._show)
        self._listen()
        if book.run is not None:
            self._show(book.run)

    def close(self) -> None:
        self._playback_panel.close()

    def _listen(self) -> None:
        @self._choice.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            number = int(event.target.value.split(".")[0])
            self._book.select(self._book.runs[number - 1])

        @self._save.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            if self._book.run is not None:
                name = f"run-{self._book.run.robot}.csv"
                self._worker.request(lambda content: send(self._client, name, content), run_csv, self._book.run)

        @self._forget.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            self._book.clear()

    def _show(self, run: Run | None) -> None:
        self._playback_panel.load(run)
        self._view.show(run)
        self._plots.show(run)
        self._list(run)
        for element in (self._choice, self._save, self._forget):
            element.visible = run is not None

    def _list(self, run: Run | None) -> None:
        self._table.content = runs_table(self._book.runs, run)
        options = tuple(f"{number}. {one.title}" for number, one in enumerate(self._book.runs, 1)) or (NO_RUN,)
        show_options(self._choice, options, options[self._book.runs.index(run)] if run is not None else NO_RUN)


class RunPlots:
    """Angle, error and control signal of all drives, or of one."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._gui = gui
        self._run: Run | None = None
        self._drive = gui.add_dropdown("Drive", _options(ALL), visible=False)
        self._stretch = gui.add_dropdown("Shown", tuple(STRETCHES), visible=False)
        self._folder = gui.add_folder("Drives", visible=False)
        self._plots: list[Plot] = []
        self._built_for: tuple[str, str, str] | None = None

        @self._drive.on_update
        async def _(_: object) -> None:
            self._draw()

        @self._stretch.on_update
        async def _(_: object) -> None:
            self._draw()

    def show(self, run: Run | None) -> None:
        self._run = run
        for element in (self._drive, self._stretch, self._folder):
            element.visible = run is not None
        if run is not None:
            self._build(run)
            self._draw()

    def _build(self, run: Run) -> None:
        """Plots for the drives of this robot; they stay while the robot and its units do."""
        key = (run.robot, run.joint_unit, run.effort_unit)
        if key == self._built_for:
            return
        self._built_for = key
        names = ROBOTS[run.robot].build.joint_names
        show_options(self._drive, (ALL, *names), ALL)
        for plot in self._plots:
            plot.remove()
        actual = [Curve(name, theme.leg_color(k)) for k, name in enumerate(names)]
        wanted = [Curve(f"{name} wanted", theme.leg_color(k), 1.5, DASHED) for k, name in enumerate(names)]
        unit = run.joint_unit
        with self._folder:
            self._plots = [
                Plot(self._gui, Axes("Time (s)", f"Joint position ({unit})"), actual + wanted, "Joints", 230),
                Plot(self._gui, Axes("Time (s)", f"Error ({unit})"), actual, "Error: wanted minus actual", 190),
                Plot(self._gui, Axes("Time (s)", f"Control signal ({run.effort_unit})"), actual, "Control signal", 190),
            ]

    def _draw(self) -> None:
        run = self._run
        if run is None:
            return
        chosen = run.outline(POINTS, *STRETCHES[self._stretch.value])
        if len(chosen) < 2:  # the run is shorter than this stretch
            chosen = run.outline(POINTS)
        names = ROBOTS[run.robot].build.joint_names
        one = names.index(self._drive.value) if self._drive.value in names else None
        hidden = np.array([one is not None and k != one for k in range(len(names))])
        t, factor = run.t[chosen], run.joint_factor
        tables = (run.q[chosen] * factor, run.q_ref[chosen] * factor, run.joint_error[chosen], run.u[chosen])
        actual, wanted, error, control = (np.where(hidden, np.nan, table).T for table in tables)
        for plot, curves in zip(self._plots, ((*actual, *wanted), error, control), strict=True):
            plot.show(t, *curves)


def _options(*names: str) -> tuple[str, ...]:
    """Options of a dropdown that will have others later."""
    return names
