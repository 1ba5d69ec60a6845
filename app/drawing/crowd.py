"""A drawing of too many strokes is refused, with settings that make it coarser."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from app.drawing.errors import TooManyStrokes
from app.drawing.modes import MAX_STROKES, PAPER
from app.drawing.rasterise import RASTER_MODES

Settings = Mapping[str, Any]

VERY_MANY = 50_000
SMOOTH, VERY_SMOOTH, LARGEST_SMOOTH = 9, 15, 31
WIDTH_PX = 300.0
"""Where not even the largest blur was enough."""

SHORTEST_MM, LONGEST_SHORTEST_MM = 5.0, 20.0
ROWS_APART = 2.5
"""Up to so many times too many rows are put further apart; only then the picture is smoothed, too."""


def too_many(count: int, mode: str, settings: Settings) -> TooManyStrokes:
    """The refusal of a picture that gives `count` strokes in a mode with these settings (those that are set)."""
    coarser = coarser_settings(count, mode, settings)
    advice = " and ".join(f"{name} to {value:g}" for name, value in coarser.items())
    return TooManyStrokes(
        f"This picture gives {in_words(count)} strokes, more than the {in_words(MAX_STROKES)} that make sense: "
        f"{f'set {advice} for a coarser drawing' if advice else 'draw it smaller or with a wider pen'}.",
        count,
        coarser,
    )


def coarser_settings(count: int, mode: str, settings: Settings) -> dict[str, float]:
    """What to change in a mode that gives `count` strokes to have far fewer; nothing if it has no such setting."""
    if mode == "stipple":
        return {"dots": MAX_STROKES / 2}
    if mode in RASTER_MODES:
        return _fewer_rows(count, mode, settings)
    if mode == PAPER:
        return _smoother(count, settings)
    shortest = min(max(SHORTEST_MM, 2.0 * settings.get("shortest_mm", 0.0)), LONGEST_SHORTEST_MM)
    return {**_smoother(count, settings), "shortest_mm": shortest}


def in_words(count: int) -> str:
    """Two digits are enough: 41 000."""
    step = 10 ** max(len(str(count)) - 2, 0)
    return f"{-(-count // step) * step:,}".replace(",", " ")  # rounded up: never less than it is


def _smoother(count: int, settings: Settings) -> dict[str, float]:
    smooth = int(settings.get("smooth", 1))
    if smooth >= LARGEST_SMOOTH:
        return {"width": WIDTH_PX}
    least = VERY_SMOOTH if count > VERY_MANY else SMOOTH
    return {"smooth": float(max(least, min(2 * smooth + 1, LARGEST_SMOOTH)))}


def _fewer_rows(count: int, mode: str, settings: Settings) -> dict[str, float]:
    pitch = next((each for each in RASTER_MODES[mode].parameters if each.name == "pitch"), None)
    if pitch is None:
        return {}
    present, excess = settings.get("pitch", pitch.default), count / MAX_STROKES
    if mode == "threshold_rows" and excess > ROWS_APART:
        return {**_smoother(count, settings), "pitch": min(2.0 * present, pitch.high)}
    return {"pitch": min(round(1.2 * max(excess, 1.0) * present, 1), pitch.high)}
