"""What the robot is to do: path, size, pace, start."""

from __future__ import annotations

from dataclasses import replace

import viser

from app.motion import PATHS
from app.ui.lab.desk import ControlDesk
from app.ui.lab.run_book import RunBook
from app.ui.lab.settings import STARTS, ControlSettings
from app.ui.viser_adapter import show_value

START_NAMES = {title: start for start, title in STARTS.items()}
PATH_NAMES = {path.title: name for name, path in PATHS.items()}


class RunSettingsPanel:
    """The top of the tab `Run`."""

    def __init__(self, gui: viser.GuiApi, desk: ControlDesk, book: RunBook) -> None:
        self._desk = desk
        self._book = book
        run = desk.settings.run
        self._path = gui.add_dropdown("Path", tuple(PATH_NAMES), initial_value=PATHS[run.tour.path].title)
        self._size = gui.add_slider("Radius (mm)", 10.0, 150.0, 1.0, 1e3 * run.tour.size_m)
        self._lap = gui.add_number("Lap time (s)", run.tour.lap_s, min=1.0, max=300.0, step=0.5)
        self._start = gui.add_dropdown("Start", tuple(START_NAMES), initial_value=STARTS[run.start])
        self._clockwise = gui.add_checkbox("Clockwise", run.tour.clockwise)
        self._paper = gui.add_checkbox(
            "As in the paper", run.as_in_paper, hint="The paper's own simulation: from rest, ±100 % taken for volts"
        )
        self._go = gui.add_button("Run on the robot", icon=viser.Icon.PLAYER_PLAY, color="blue")
        self._bar = gui.add_progress_bar(100.0, animated=True, visible=False)
        self._cancel = gui.add_button("Cancel", icon=viser.Icon.X, visible=False)
        self._listen()
        desk.settings_changed.connect(self._follow)
        book.busy_changed.connect(self._show_busy)
        self._follow(desk.settings)

    def _listen(self) -> None:
        desk = self._desk

        @self._path.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.set_run(path=PATH_NAMES[event.target.value])

        @self._size.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.set_run(size_m=event.target.value / 1e3)

        @self._lap.on_update
        async def _(event: viser.GuiEvent[viser.GuiNumberHandle[float]]) -> None:
            desk.set_run(lap_s=event.target.value)

        @self._start.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.set_run(start=START_NAMES[event.target.value], as_in_paper=False)

        @self._clockwise.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            desk.set_run(clockwise=event.target.value)

        @self._paper.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            paper = event.target.value
            desk.set_run(as_in_paper=paper, **({"start": "rest"} if paper else {}))

        @self._go.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            self._book.request(desk.settings)

        @self._cancel.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            self._book.cancel()

    def _show_busy(self, busy: bool) -> None:
        self._go.disabled = busy
        self._bar.visible = self._cancel.visible = busy

    def _follow(self, settings: ControlSettings) -> None:
        run = settings.run
        show_value(self._path, PATHS[run.tour.path].title)
        show_value(self._size, round(1e3 * run.tour.size_m))
        show_value(self._lap, run.tour.lap_s)
        show_value(self._start, STARTS[run.start])
        show_value(self._clockwise, run.tour.clockwise)
        show_value(self._paper, run.as_in_paper)
        if self._paper.visible != (settings.robot == "par4"):
            self._paper.visible = settings.robot == "par4"


def variants(settings: ControlSettings, runs: tuple[tuple[str, str], ...]) -> list[ControlSettings]:
    """The same experiment with other tunings and starts."""
    return [replace(settings, tuning=tuning, run=replace(settings.run, start=start)) for tuning, start in runs]
