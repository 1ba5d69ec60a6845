"""The experiment, and the program that the controller becomes on its board."""

from __future__ import annotations

from typing import get_args

import viser

from app.control.sampled_pid import AntiWindup, Method
from app.ui.lab.desk import ControlDesk
from app.ui.lab.settings import ControlSettings
from app.ui.viser_adapter import show_value


class ExperimentPanel:
    """Height and length of the step."""

    def __init__(self, gui: viser.GuiApi, desk: ControlDesk) -> None:
        self._desk = desk
        settings = desk.settings
        self._unit = settings.motor.unit
        self._height = gui.add_slider(f"Set-point ({self._unit})", 1.0, 90.0, 1.0, settings.setpoint)
        self._length = gui.add_slider("Time shown (s)", 0.2, 20.0, 0.1, settings.duration_s)
        desk.settings_changed.connect(self._follow)

        @self._height.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.change(setpoint=event.target.value)

        @self._length.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.change(duration_s=event.target.value)

    def _follow(self, settings: ControlSettings) -> None:
        show_value(self._height, settings.setpoint)
        show_value(self._length, settings.duration_s)
        if settings.motor.unit != self._unit:
            self._unit = settings.motor.unit
            self._height.label = f"Set-point ({self._unit})"


class ProgramPanel:
    """The folder `Program on the board`."""

    def __init__(self, gui: viser.GuiApi, desk: ControlDesk) -> None:
        self._desk = desk
        with gui.add_folder("Program on the board", expand_by_default=False):
            self._build(gui, desk.settings)
        desk.settings_changed.connect(self._follow)

    def _build(self, gui: viser.GuiApi, settings: ControlSettings) -> None:
        sampling, pid = settings.sampling, settings.pid
        self._period = gui.add_slider(
            "Period (ms)", 1.0, 200.0, 1.0, 1e3 * sampling.period_s, hint="Time between two runs of the controller"
        )
        self._method = gui.add_dropdown("Sampled by", get_args(Method), initial_value=sampling.method)
        self._windup = gui.add_dropdown("Anti-windup", get_args(AntiWindup), initial_value=sampling.anti_windup)
        self._on_measurement = gui.add_checkbox(
            "Derivative on measurement", pid.c == 0.0, hint="No kick when the set-point jumps"
        )
        self._weight = gui.add_slider(
            "Set-point weight b", 0.0, 1.0, 0.05, pid.b, hint="Of the proportional part: less means less overshoot"
        )
        self._listen()

    def _listen(self) -> None:
        @self._period.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            self._desk.change(period_s=event.target.value / 1e3)

        @self._method.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._desk.change(method=event.target.value)

        @self._windup.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._desk.change(anti_windup=event.target.value)

        @self._on_measurement.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            self._desk.change(c=0.0 if event.target.value else 1.0)

        @self._weight.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            self._desk.change(b=event.target.value)

    def _follow(self, settings: ControlSettings) -> None:
        show_value(self._period, round(1e3 * settings.sampling.period_s, 3))
        show_value(self._method, settings.sampling.method)
        show_value(self._windup, settings.sampling.anti_windup)
        show_value(self._on_measurement, settings.pid.c == 0.0)
        show_value(self._weight, settings.pid.b)
