"""A number that is typed, or pulled on a logarithmic scale; its lowest end means zero."""

from __future__ import annotations

import math
from collections.abc import Callable

import viser

from app.ui.viser_adapter import element_id, show_value

PER_DECADE = 40
"""Steps of the slider."""

PULLED_DIGITS = 3
"""Significant digits of a value that was pulled."""
SHOWN_DIGITS = 6
"""Of one that was computed."""


class LogSlider:
    """A field with its slider below. `changed` is called for what a person enters."""

    def __init__(
        self,
        gui: viser.GuiApi,
        label: str,
        value: float,
        decades: tuple[int, int],
        changed: Callable[[float], None],
        hint: str | None = None,
    ) -> None:
        self._low, high = decades
        self._steps = PER_DECADE * (high - self._low)
        most = 10.0 ** (high + 1)
        self._field = gui.add_number(label, value, min=0.0, max=most, step=10.0 ** (self._low - 1), hint=hint)
        marks = tuple((PER_DECADE * (k - self._low), f"{10.0**k:g}") for k in range(self._low, high + 1))
        self._slider = gui.add_slider(
            f"{label}, slider", 0, self._steps, 1, self._position(value), marks=((0, "0"), *marks[1:])
        )
        gui.add_html(_hide_number(element_id(self._slider)))

        @self._field.on_update
        async def _(event: viser.GuiEvent[viser.GuiNumberHandle[float]]) -> None:
            show_value(self._slider, self._position(event.target.value))
            changed(event.target.value)

        @self._slider.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[int]]) -> None:
            value = self._value(event.target.value)
            show_value(self._field, value)
            changed(value)

    def show(self, value: float) -> None:
        """Show a value that did not come from here."""
        show_value(self._field, _rounded(value, SHOWN_DIGITS))
        show_value(self._slider, self._position(value))

    @property
    def visible(self) -> bool:
        return self._field.visible

    @visible.setter
    def visible(self, visible: bool) -> None:
        self._field.visible = self._slider.visible = visible

    def _position(self, value: float) -> int:
        if value <= 0.0:
            return 0
        return min(max(round(PER_DECADE * (math.log10(value) - self._low)), 0), self._steps)

    def _value(self, position: int) -> float:
        return _rounded(10.0 ** (self._low + position / PER_DECADE), PULLED_DIGITS) if position > 0 else 0.0


def _rounded(value: float, digits: int) -> float:
    return float(f"{value:.{digits}g}") if math.isfinite(value) else 0.0


def _hide_number(slider_id: str) -> str:
    """The slider's own number is a position on the scale and means nothing; nor is its label needed twice."""
    return (
        f'<style>[id="{slider_id}"] + * {{ display: none !important; }}'
        f' [id="{slider_id}"] .mantine-Slider-label {{ display: none; }}'
        f' label[for="{slider_id}"] {{ opacity: 0; }}</style>'
    )
