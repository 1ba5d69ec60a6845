"""What a way to rasterise is, so that a page can offer it with its sliders."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from app.drawing.rasterise.types import Stroke

PENS = "pen widths"
"""The unit of most lengths, so that a wider pen draws the same picture more coarsely."""


@dataclass(frozen=True)
class Parameter:
    """One slider."""

    name: str
    """Keyword argument of the mode's `draw`."""
    label: str
    default: float
    low: float
    high: float
    step: float
    unit: str = ""


@dataclass(frozen=True)
class RasterMode:
    """One way to draw tones with a pen."""

    title: str
    explanation: str
    parameters: tuple[Parameter, ...]
    draw: Callable[..., list[Stroke]]
    """(tone: Field (h, w), pen: float in pixels, **parameters) -> PIXEL strokes."""

    @property
    def defaults(self) -> dict[str, float]:
        return {parameter.name: parameter.default for parameter in self.parameters}
