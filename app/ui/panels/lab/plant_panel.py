"""The motor and everything that can be wrong with it: each imperfection can be switched on."""

from __future__ import annotations

import html
import math
from dataclasses import dataclass

import viser

from app.control import Motor
from app.control.drives import DRIVES
from app.equations import mathml
from app.ui.lab.desk import ControlDesk
from app.ui.lab.settings import ControlSettings
from app.ui.panels.text import small
from app.ui.viser_adapter import show_value


@dataclass(frozen=True)
class Imperfection:
    """One switch with its slider."""

    name: str
    """Field of `Hardware`."""
    label: str
    """`UNIT` stands for the drive's."""
    switched_on: float
    """Value when it is first switched on, as shown."""
    high: float
    step: float
    low: float = 0.0
    off: float = 0.0
    """Value that means off, in SI."""
    per_si: float = 1.0
    """Shown value of one SI unit."""
    hint: str = ""


IMPERFECTIONS = (
    Imperfection("supply_v", "Supply limit (V)", 12.0, 100.0, 0.5, low=1.0, off=math.inf, hint="100 % pulse width"),
    Imperfection("pwm_steps", "PWM steps", 255, 1023, 1, low=2, hint="8 bits have 255"),
    Imperfection("adc_bits", "Sensor (bits)", 10, 20, 1, low=6, hint="STM32F4: 12 bits, Arduino Uno: 10 bits"),
    Imperfection("noise", "Noise (UNIT)", 0.1, 1.0, 0.01, hint="Standard deviation of the reading"),
    Imperfection("delay_s", "Delay (ms)", 20.0, 200.0, 1.0, per_si=1e3, hint="From computed to applied voltage"),
    Imperfection("coulomb_v", "Dry friction (V)", 0.5, 4.0, 0.05, hint="Voltage at which the motor begins to turn"),
    Imperfection("viscous", "Viscous friction (1/s)", 2.0, 20.0, 0.1, hint="Added to the motor's own damping"),
    Imperfection("inertia_factor", "Inertia (times)", 2.0, 5.0, 0.05, low=0.2, off=1.0, hint="Of arm and load"),
    Imperfection("backlash", "Gear play (UNIT)", 0.5, 5.0, 0.05, hint="Between motor and joint"),
)


class PlantPanel:
    """The folder `Motor and disturbances`."""

    def __init__(self, gui: viser.GuiApi, desk: ControlDesk) -> None:
        self._desk = desk
        with gui.add_folder("Motor and disturbances", expand_by_default=False):
            self._about = gui.add_html("")
            self._rows = [ImperfectionRow(gui, desk, one) for one in IMPERFECTIONS]
        desk.settings_changed.connect(self._follow)
        self._follow(desk.settings)

    def _follow(self, settings: ControlSettings) -> None:
        title = DRIVES[settings.robot].title
        content = small(
            f"<b>{html.escape(title)}</b>{mathml(motor_latex(settings.motor))}<div>{html.escape(settings.motor_origin)}</div>"
        )
        if content != self._about.content:
            self._about.content = content
        for row in self._rows:
            row.show(settings)


class ImperfectionRow:
    """A checkbox, and a slider that is there while it is ticked."""

    def __init__(self, gui: viser.GuiApi, desk: ControlDesk, one: Imperfection) -> None:
        self._one = one
        self._desk = desk
        unit = desk.settings.motor.unit
        label = one.label.replace("UNIT", unit)
        self._switch = gui.add_checkbox(label.split(" (")[0], self._is_on(desk.settings), hint=one.hint)
        self._slider = gui.add_slider(
            label, one.low, one.high, one.step, self._shown(desk.settings), visible=self._is_on(desk.settings)
        )
        self._built_for = unit

        @self._switch.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            self._set(self._slider.value if event.target.value else None)

        @self._slider.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            self._set(event.target.value)

    def show(self, settings: ControlSettings) -> None:
        on = self._is_on(settings)
        show_value(self._switch, on)
        if on:
            show_value(self._slider, self._shown(settings))
        if self._slider.visible != on:
            self._slider.visible = on
        if self._built_for != settings.motor.unit:
            self._built_for = settings.motor.unit
            self._slider.label = self._one.label.replace("UNIT", settings.motor.unit)

    def _set(self, shown: float | None) -> None:
        one = self._one
        value = one.off if shown is None else shown / one.per_si
        self._desk.change(**{one.name: int(value) if one.name in ("pwm_steps", "adc_bits") else value})

    def _is_on(self, settings: ControlSettings) -> bool:
        return getattr(settings.hardware, self._one.name) != self._one.off

    def _shown(self, settings: ControlSettings) -> float:
        value = getattr(settings.hardware, self._one.name) * self._one.per_si
        if not self._is_on(settings):
            value = DRIVES[settings.robot].adc_bits if self._one.name == "adc_bits" else self._one.switched_on
        return type(self._one.step)(min(max(value, self._one.low), self._one.high))


def motor_latex(motor: Motor) -> str:
    """The transfer function with its numbers."""
    droop = f" + {motor.T2:.4g}" if motor.T2 else ""
    unit = rf"\frac{{\mathrm{{{motor.unit}}}}}{{\mathrm{{V}}}}"
    return rf"G(s) = \frac{{{motor.K:.5g}}}{{s^2 + {motor.T1:.5g}\,s{droop}}}\;{unit}"
