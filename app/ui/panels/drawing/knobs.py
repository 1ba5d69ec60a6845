"""Sliders and choices for the parameters of a mode, made from their table."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import viser

from app.drawing.modes import AUTO
from app.drawing.rasterise.mode import Parameter
from app.ui.viser_adapter import show_value

FINE = frozenset({"shortest_mm", "join_mm", "smooth_px", "tolerance_mm"})
"""What few need; it is folded away."""

Turn = Callable[..., None]


class Knobs:
    """The controls of one mode at a time; `turn(name=value)` hears of every change."""

    def __init__(self, gui: viser.GuiApi, turn: Turn) -> None:
        self._gui = gui
        self._turn = turn
        self._main = gui.add_folder(None)
        self._fine = gui.add_folder("Fine tuning", expand_by_default=False)
        self._built_for: tuple[Parameter, ...] = ()
        self._knobs: list[Knob] = []

    def show(self, parameters: Sequence[Parameter], values: Mapping[str, Any]) -> None:
        """Controls for these parameters, at these values or else at their own."""
        if tuple(parameters) != self._built_for:
            self._built_for = tuple(parameters)
            for knob in self._knobs:
                knob.remove()
            self._knobs = [self._add(parameter) for parameter in parameters]
            self._fine.visible = any(parameter.name in FINE for parameter in parameters)
        for knob in self._knobs:
            parameter = knob.parameter
            knob.show(values.get(parameter.name, AUTO if parameter.auto else parameter.default))

    def _add(self, parameter: Parameter) -> Knob:
        with self._fine if parameter.name in FINE else self._main:
            return Knob(self._gui, parameter, self._turn)


class Knob:
    """One parameter: a slider, or a dropdown for few values; with a tick before it where it may be automatic."""

    def __init__(self, gui: viser.GuiApi, parameter: Parameter, turn: Turn) -> None:
        self.parameter = parameter
        self._turn = turn
        unit = f" ({parameter.unit})" if parameter.unit else ""
        label, hint = f"{parameter.label}{unit}", parameter.explanation or None
        self._auto: viser.GuiCheckboxHandle | None = None
        if parameter.auto:
            self._auto = gui.add_checkbox(f"{parameter.label}: automatic", True, hint=hint)
        self._choice: viser.GuiDropdownHandle[str] | None = None
        self._slider: viser.GuiSliderHandle[float] | None = None
        if parameter.choices:
            options = tuple(f"{choice:g}" for choice in parameter.choices)
            self._choice = gui.add_dropdown(label, options, initial_value=f"{parameter.default:g}", hint=hint)
        else:
            low, high, step, value = map(whole, (parameter.low, parameter.high, parameter.step, parameter.default))
            self._slider = gui.add_slider(label, low, high, step, value, hint=hint)
        self._listen()

    def show(self, value: Any) -> None:
        """Show a value, or `auto`."""
        automatic = value == AUTO
        if self._auto is not None:
            show_value(self._auto, automatic)
        if self._slider is not None:
            self._slider.visible = not automatic
            if not automatic:
                # not `whole`: an input that holds an integer takes no fractions any more
                show_value(self._slider, float(min(max(value, self.parameter.low), self.parameter.high)))
        if self._choice is not None and not automatic:
            show_value(self._choice, f"{value:g}")

    def remove(self) -> None:
        for handle in (self._auto, self._slider, self._choice):
            if handle is not None:
                handle.remove()

    def _listen(self) -> None:
        name = self.parameter.name
        if self._auto is not None:

            @self._auto.on_update
            async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
                begin = self._slider.value if self._slider is not None else self.parameter.default
                self._turn(**{name: AUTO if event.target.value else begin})

        if self._slider is not None:

            @self._slider.on_update
            async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
                self._turn(**{name: event.target.value})

        if self._choice is not None:

            @self._choice.on_update
            async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
                self._turn(**{name: float(event.target.value)})


def whole(value: float) -> float:
    """An integer where it is one: viser then shows no decimals."""
    return int(value) if float(value).is_integer() else value
