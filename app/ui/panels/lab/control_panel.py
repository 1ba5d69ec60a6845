"""The tab `Control`: everything that can be set in the control lab."""

from __future__ import annotations

from collections.abc import Callable

import viser

from app.ui.lab.desk import ControlDesk
from app.ui.lab.settings import ControlSettings
from app.ui.lab.traps import TRAPS, entered, traps_for
from app.ui.panels.lab.gains_panel import GainsPanel
from app.ui.panels.lab.plant_panel import PlantPanel
from app.ui.panels.lab.program_panel import ExperimentPanel, ProgramPanel
from app.ui.panels.options import show_options
from app.ui.panels.text import small

NO_TRAP = "Choose one …"


class ControlPanel:
    """Gains, program, motor, and the classic traps."""

    def __init__(
        self,
        gui: viser.GuiApi,
        desk: ControlDesk,
        run_all: Callable[[str], None],
        below_gains: Callable[[], None] = lambda: None,
    ) -> None:
        self._desk = desk
        self._run_all = run_all
        gui.add_html(small("The other panel has the plots, runs on the robot, and a test of the motor."))
        ExperimentPanel(gui, desk)
        GainsPanel(gui, desk)
        below_gains()
        self._add_baseline(gui)
        ProgramPanel(gui, desk)
        PlantPanel(gui, desk)
        self._add_traps(gui)
        desk.settings_changed.connect(self._follow)

    def _add_baseline(self, gui: viser.GuiApi) -> None:
        buttons = gui.add_button_group("Baseline", ("Keep this", "Forget"), hint="Keep these curves to compare with")
        reset = gui.add_button("Reset the lab", icon=viser.Icon.RESTORE, color="gray")

        @buttons.on_click
        async def _(_: object) -> None:
            self._desk.keep_baseline(buttons.value == "Keep this")

        @reset.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            show_options(self._trap, self._trap.options, NO_TRAP)
            self._advice.content = ""
            self._desk.reset()

    def _add_traps(self, gui: viser.GuiApi) -> None:
        with gui.add_folder("Walk into a trap"):
            options = (NO_TRAP, *traps_for(self._desk.settings.robot))
            self._trap = gui.add_dropdown("Trap", options, initial_value=NO_TRAP)
            self._advice = gui.add_html("")

        @self._trap.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._enter(event.target.value)

    def _enter(self, name: str) -> None:
        trap = TRAPS.get(name)
        self._advice.content = small(trap.text) if trap else ""
        if trap is None:
            return
        self._desk.take(entered(name, self._desk.settings))
        if trap.runs:
            self._run_all(name)

    def _follow(self, settings: ControlSettings) -> None:
        options = (NO_TRAP, *traps_for(settings.robot))
        if self._trap.options != options:
            show_options(self._trap, options, NO_TRAP)
            self._advice.content = ""
