"""Rows that swing more widely where the picture is darker: the best picture per second, with hardly a lift."""

from __future__ import annotations

import numpy as np

from app.drawing.rasterise.mode import PENS, Parameter, RasterMode
from app.drawing.rasterise.runs import places, runs
from app.drawing.rasterise.simpler import simpler
from app.drawing.rasterise.tone import Lay, drive_for, inked_where, sample, sample_mask, softened, wanted_cover
from app.drawing.rasterise.types import Field, Mask, Stroke

POINTS_A_WAVE = 12
CALM = 0.125
"""Drive at which rows begin to swing."""

SPARSE = 1 / 32
"""Drive below which every other row is lifted: where half the rows are nearer to the wanted cover than all."""

SEEN = 0.3
"""Blur before the picture is read, relative to the distance of rows."""


def draw(tone: Field, pen: float, pitch: float = 4.0, wave: float = 2.4) -> list[Stroke]:
    """PIXEL strokes; the distance of rows and the length of a wave are in pen widths."""
    return waved(lay, tone, pen, pitch, wave)


def waved(lay: Lay, tone: Field, pen: float, pitch: float, wave: float) -> list[Stroke]:
    """What `lay` makes of a picture (h, w) with lines `pitch` apart that swing in waves, both in pen widths."""
    cover = softened(wanted_cover(tone), SEEN * pitch * pen)
    drive = drive_for(lay, cover, pitch=pitch, wave=wave)
    return lay(drive, inked_where(tone, pen), pen, pitch=pitch, wave=wave)


def lay(drive: Field, inked: Mask, pen: float, *, pitch: float, wave: float) -> list[Stroke]:
    """Rows, alternately to the right and to the left."""
    height, width = drive.shape
    step = wave * pen / POINTS_A_WAVE
    x = np.arange(-0.5, width - 0.5, step)
    y = places(height, pitch * pen)[:, None] + (height - 1) / 2
    strength = sample(drive, x, y)
    swing = swing_of(strength, pitch) * pen * np.sin(2 * np.pi * np.arange(len(x)) / POINTS_A_WAVE)
    wavy = np.clip(y + swing, -0.5, height - 0.5)
    wavy = np.where(sample_mask(inked, x, wavy), wavy, y)
    odd = np.arange(len(y))[:, None] % 2 == 1
    down = sample_mask(inked, x, y) & ~(odd & (strength < SPARSE))
    # a gap as narrow as the pen would be closed by its round ends; a run as short would be a dot
    narrow = max(1, round(pen / step))
    points = np.stack(np.broadcast_arrays(x, wavy), axis=-1).reshape(-1, 2)
    row = np.repeat(np.arange(len(y)), len(x))
    strokes = []
    for first, last in zip(*runs(down.ravel(), row, gap=narrow, shortest=narrow + 1), strict=True):
        stroke = points[first : last + 1]
        strokes.append(stroke if row[first] % 2 == 0 else stroke[::-1])
    return simpler(strokes, pen)


def swing_of(drive: Field, pitch: float) -> Field:
    """Amplitude in pen widths."""
    return np.clip((drive - CALM) / (1 - CALM), 0.0, 1.0) * (pitch / 2)


SQUIGGLE = RasterMode(
    "Squiggle rows",
    "Rows of waves, higher where the picture is darker. The best likeness for the time, with few lifts.",
    (
        Parameter("pitch", "Distance of rows", 4.0, 2.0, 10.0, 0.1, PENS),
        Parameter("wave", "Length of a wave", 2.4, 1.6, 6.0, 0.1, PENS),
    ),
    draw,
)
