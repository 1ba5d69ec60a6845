"""Strokes with no more points than the pen can show: less to plan, to send and to write."""

from __future__ import annotations

from collections.abc import Iterable

from app.drawing.rasterise.types import Stroke
from app.drawing.vectorise.smoothing import simplify

TOLERANCE = 0.05
"""Pen widths by which a line may move. Twice as much makes corners of waves, at which a robot slows down."""


def simpler(strokes: Iterable[Stroke], pen: float) -> list[Stroke]:
    """PIXEL strokes with fewer of their points, under a pen `pen` pixels wide."""
    return [simplify(stroke, TOLERANCE * pen) for stroke in strokes]
