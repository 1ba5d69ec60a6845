"""The paper's laser rows: runs of dark pixels, row by row to and fro."""

from __future__ import annotations

import numpy as np

from app.drawing.rasterise.mode import PENS, Parameter, RasterMode
from app.drawing.rasterise.runs import places, runs
from app.drawing.rasterise.tone import LEAST_TONE
from app.drawing.rasterise.types import Field, Stroke


def draw(tone: Field, pen: float, threshold: float = 50.0, pitch: float = 1.0) -> list[Stroke]:
    """PIXEL strokes of two points; the threshold is a darkness in percent, the distance of rows in pen widths."""
    height = len(tone)
    y = places(height, pitch * pen) + (height - 1) / 2
    pixel_row = np.clip(np.rint(y), 0, height - 1).astype(int)
    # pictures have 256 tones: half a step keeps rounding out of it
    dark = tone[pixel_row] >= max(threshold / 100, LEAST_TONE) - 0.5 / 255
    row, column = np.divmod(np.arange(dark.size), tone.shape[1])
    first, last = runs(dark.ravel(), row)
    back = row[first] % 2 == 1
    ends = np.stack([np.where(back, last, first), np.where(back, first, last)], axis=1)
    return list(np.stack([column[ends], y[row[ends]]], axis=-1))


THRESHOLD_ROWS = RasterMode(
    "Threshold rows",
    "Rows of the dark pixels, to and fro, as the paper's laser burns them. There are no greys.",
    (
        Parameter("threshold", "Darkness that counts", 50.0, 5.0, 95.0, 1.0, "%"),
        Parameter("pitch", "Distance of rows", 1.0, 0.5, 5.0, 0.1, PENS),
    ),
    draw,
)
