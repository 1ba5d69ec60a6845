"""One line from the middle outwards that swings where the picture is dark: for a robot that cannot lift its pen."""

from __future__ import annotations

import math

import numpy as np

from app.drawing.rasterise.mode import PENS, Parameter, RasterMode
from app.drawing.rasterise.simpler import simpler
from app.drawing.rasterise.squiggle import POINTS_A_WAVE, swing_of, waved
from app.drawing.rasterise.tone import sample, sample_mask
from app.drawing.rasterise.types import Field, Mask, Stroke


def draw(tone: Field, pen: float, pitch: float = 4.0, wave: float = 2.4) -> list[Stroke]:
    """One PIXEL stroke, or none for a white picture; the parameters are in pen widths."""
    return waved(lay, tone, pen, pitch, wave)


def lay(drive: Field, inked: Mask, pen: float, *, pitch: float, wave: float) -> list[Stroke]:
    """The largest circle in the picture, from the first dark point of the spiral to its last."""
    height, width = drive.shape
    apart, step = pitch * pen, wave * pen / POINTS_A_WAVE
    reach = min(height, width) / 2
    length = np.arange(0.0, math.pi * reach**2 / apart + step, step)
    turned = np.sqrt(4 * math.pi * length / apart)
    radius = apart * turned / (2 * math.pi)
    middle_x, middle_y = (width - 1) / 2, (height - 1) / 2
    calm_x, calm_y = middle_x + radius * np.cos(turned), middle_y + radius * np.sin(turned)
    swing = np.minimum(swing_of(sample(drive, calm_x, calm_y), pitch) * pen, radius)
    wavy = np.minimum(radius + swing * np.sin(2 * math.pi * np.arange(len(radius)) / POINTS_A_WAVE), reach)
    path = np.column_stack([middle_x + wavy * np.cos(turned), middle_y + wavy * np.sin(turned)])
    down = np.flatnonzero(sample_mask(inked, calm_x, calm_y))
    return simpler([path[down[0] : down[-1] + 1]], pen) if len(down) > 1 else []


SPIRAL = RasterMode(
    "Spiral",
    "A single line from the middle outwards, wavier where the picture is darker. It never lifts, so white turns grey.",
    (
        Parameter("pitch", "Distance of turns", 4.0, 2.0, 10.0, 0.1, PENS),
        Parameter("wave", "Length of a wave", 2.4, 1.6, 6.0, 0.1, PENS),
    ),
    draw,
)
