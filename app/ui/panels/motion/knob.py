"""A slider for one field of some settings, in the unit that people read."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import viser

from app.ui.viser_adapter import show_value


class Knob:
    """`change(name=value)` is called for what a person sets.

    Args:
        bounds: lowest, highest and step, as read; integers for a field that counts.
        name: of the field.
        factor: from the field's unit to the one that is read.
    """

    def __init__(
        self,
        gui: viser.GuiApi,
        label: str,
        bounds: tuple[float, float, float],
        name: str,
        factor: float,
        change: Callable[..., Any],
        hint: str | None = None,
    ) -> None:
        low, high, step = bounds
        self.name = name
        self._factor = factor
        self._counts = isinstance(step, int)
        self._slider = gui.add_slider(label, low, high, step, low, hint=hint)

        @self._slider.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            value = event.target.value
            change(**{name: round(value) if self._counts else value / factor})

    def show(self, value: float) -> None:
        """Show a value of the field; beyond the slider's end it shows the end."""
        shown = value if self._counts else round(value * self._factor, 6)
        show_value(self._slider, min(max(shown, self._slider.min), self._slider.max))

    def reach(self, highest: float) -> None:
        """End the slider at this value of the field."""
        high = round(highest * self._factor)
        if high != self._slider.max:
            show_value(self._slider, min(self._slider.value, high))
            self._slider.max = high

    @property
    def visible(self) -> bool:
        return self._slider.visible

    @visible.setter
    def visible(self, visible: bool) -> None:
        if self._slider.visible != visible:
            self._slider.visible = visible
