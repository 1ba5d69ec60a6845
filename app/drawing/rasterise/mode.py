"""What a way to rasterise is, so that a page can offer it with its sliders."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from app.drawing.rasterise.types import Stroke

PENS = "pen widths"
"""The unit of most lengths, so that a wider pen draws the same picture more coarsely."""


@dataclass(frozen=True)
class Parameter:
    """One slider, or one choice."""

    name: str
    """Keyword argument of the mode's `draw`."""
    label: str
    default: float
    low: float
    high: float
    step: float
    """Values are `low` plus so many steps."""
    unit: str = ""
    auto: bool = False
    """Whether it may be "auto", and is by default: then `default` is only where a slider may begin."""
    choices: tuple[float, ...] = ()
    """The only values, if they are few."""
    explanation: str = ""
    """What it does to the drawing, in a sentence."""


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
