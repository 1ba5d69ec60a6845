"""One line that winds more closely where the picture is darker: a short way through dense points."""

from __future__ import annotations

import numpy as np

from app.drawing.rasterise.mode import Parameter, RasterMode
from app.drawing.rasterise.points import points_of
from app.drawing.rasterise.tone import drive_for, inked_where, wanted_cover
from app.drawing.rasterise.tour import shortened
from app.drawing.rasterise.types import Field, Mask, Stroke

DENSEST = 1.2
"""Points per square of the pen's width at full drive."""

NO_LIMIT = 1_000_000


def draw(tone: Field, pen: float, points: float = 10_000.0) -> list[Stroke]:
    """One PIXEL stroke through at most `points` points, or none for a white picture."""
    drive = drive_for(lay, wanted_cover(tone))
    return lay(drive, inked_where(tone, pen), pen, most=int(points))


def lay(drive: Field, inked: Mask, pen: float, *, most: int = NO_LIMIT) -> list[Stroke]:
    """The way through n evenly spread points of an area A is about sqrt(n A) long: ink goes with the root of n."""
    way = shortened(points_of(DENSEST * drive**2, inked, pen, most))
    if len(way) == 1:
        way = np.repeat(way, 2, axis=0)
    return [way] if len(way) else []


ONE_LINE = RasterMode(
    "One line",
    "A single line that winds more closely where the picture is darker. It never lifts, and crosses white on its way.",
    (Parameter("points", "Most points", 10_000.0, 500.0, 20_000.0, 500.0),),
    draw,
)
