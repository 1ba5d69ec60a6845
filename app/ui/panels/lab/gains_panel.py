"""How the gains are found, and the gains themselves."""

from __future__ import annotations

import html

import viser

from app.control.tuning.methods import METHODS, TUNER, methods_for
from app.equations import formulas
from app.ui import theme
from app.ui.lab.desk import ControlDesk
from app.ui.lab.jobs import Answer
from app.ui.lab.settings import BY_HAND, ControlSettings
from app.ui.panels.lab.log_slider import LogSlider
from app.ui.panels.lab.metrics_table import shown
from app.ui.panels.options import show_options
from app.ui.panels.text import small
from app.ui.viser_adapter import show_value

DECADES = {"kp": (-2, 2), "ki": (-2, 3), "kd": (-3, 1), "n": (0, 3)}
"""Lowest and highest power of ten on each slider."""

HINTS = {
    "kp": "Proportional: pushes in proportion to the error",
    "ki": "Integral: pushes for as long as an error remains",
    "kd": "Derivative: brakes when the error shrinks quickly",
    "n": "Cut-off of the derivative's filter: lower is calmer under noise",
}


class GainsPanel:
    """The folder `Controller`."""

    def __init__(self, gui: viser.GuiApi, desk: ControlDesk) -> None:
        self._gui = gui
        self._desk = desk
        self._built_for: ControlSettings | None = None
        self._folder = gui.add_folder("Controller")
        self._sliders: dict[str, LogSlider] = {}
        desk.settings_changed.connect(self._follow)
        desk.answered.connect(self._explain)
        with self._folder:
            self._build()

    def _build(self) -> None:
        gui, settings = self._gui, self._desk.settings
        self._method = gui.add_dropdown("Tuning", self._options(), initial_value=settings.tuning)
        self._about = gui.add_html("")
        self._speed = gui.add_slider(
            "Response time (s)", 0.02, 1.0, 0.01, min(max(settings.response_time_s, 0.02), 1.0), hint="2 / crossover"
        )
        self._calm = gui.add_slider("Calm", 0.1, 1.0, 0.01, settings.transient, hint="Phase margin, in parts of 90°")
        for name in DECADES:
            self._sliders[name] = self._add_gain(name)
        self._listen()
        self._follow(settings)

    def _add_gain(self, name: str) -> LogSlider:
        value = getattr(self._desk.settings.pid, name)
        return LogSlider(
            self._gui,
            self._label(name),
            value,
            DECADES[name],
            lambda value: self._desk.change(**{name: max(value, 1e-3) if name == "n" else value}),
            HINTS[name],
        )

    def _label(self, name: str) -> str:
        return {"kp": "kp", "ki": "ki", "kd": "kd", "n": "N (rad/s)"}[name]

    def _options(self) -> tuple[str, ...]:
        return (BY_HAND, *methods_for(self._desk.settings.motor))

    def _listen(self) -> None:
        @self._method.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._desk.change(tuning=event.target.value)

        @self._speed.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            self._desk.change(response_time_s=event.target.value)

        @self._calm.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            self._desk.change(transient=event.target.value)

    def _follow(self, settings: ControlSettings) -> None:
        show_options(self._method, self._options(), settings.tuning)
        for name, slider in self._sliders.items():
            slider.show(getattr(settings.pid, name))
        show_value(self._speed, settings.response_time_s)
        show_value(self._calm, settings.transient)
        if self._speed.visible != (settings.tuning == TUNER):
            self._speed.visible = self._calm.visible = settings.tuning == TUNER
        self._explain(self._desk.answer)

    def _explain(self, answer: Answer | None) -> None:
        method = METHODS.get(self._desk.settings.tuning)
        unit = self._desk.settings.motor.unit
        text = method.explanation if method else f"Your own gains, in volts per {unit}."
        pid = self._desk.settings.pid
        content = small(html.escape(text)) + (small(formulas(method.latex)) if method and method.latex else "")
        if answer is not None and answer.note and answer.settings.tuning == self._desk.settings.tuning:
            color = theme.css(theme.WARNING) if answer.refused else "inherit"
            content += small(f'<b style="color:{color}">{html.escape(answer.note)}</b>')
        content += small(f"Ideal form: Ti = {shown(pid.Ti)} s, Td = {shown(pid.Td)} s")
        if content != self._about.content:
            self._about.content = content
