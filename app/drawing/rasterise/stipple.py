"""Dots, denser where the picture is darker. Every dot is a lift, so that a robot takes long."""

from __future__ import annotations

import numpy as np

from app.drawing.rasterise.mode import Parameter, RasterMode
from app.drawing.rasterise.points import points_of
from app.drawing.rasterise.tone import drive_for, inked_where, wanted_cover
from app.drawing.rasterise.types import Field, Mask, Stroke

DENSEST = 2.0
"""Dots per square of the pen's width at full drive."""

NO_LIMIT = 1_000_000


def draw(tone: Field, pen: float, dots: float = 5000.0) -> list[Stroke]:
    """PIXEL strokes of two equal points, at most `dots`; with fewer than the tones need, all tones get lighter."""
    drive = drive_for(lay, wanted_cover(tone))
    return lay(drive, inked_where(tone, pen), pen, most=int(dots))


def lay(drive: Field, inked: Mask, pen: float, *, most: int = NO_LIMIT) -> list[Stroke]:
    """Dots in the order of a curve that fills the plane."""
    points = points_of(DENSEST * drive, inked, pen, most)
    return list(np.repeat(points[:, None], 2, axis=1))


STIPPLE = RasterMode(
    "Dots",
    "Dots, denser where the picture is darker. Slow, because the pen is lifted for each; small pictures only.",
    (Parameter("dots", "Most dots", 5000.0, 100.0, 20_000.0, 100.0),),
    draw,
)
