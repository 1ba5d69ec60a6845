"""Quality against speed: one setting is changed step by step, and every drawing is timed and looked at."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from app.drawing.compare.drawn import deviation_um, drawn_strokes, likeness, likeness_to_strokes
from app.drawing.compose import Composition, Look, compose
from app.drawing.errors import DrawingError
from app.drawing.modes import DRAWING_MODES
from app.drawing.order import ink_mm
from app.drawing.source import Source
from app.drawing.toolpath import PenSettings, Placement, plan_toolpath
from app.robots import Robot
from app.robots.robot import Array

SCALE, SPEED = "scale", "speed_mm_s"

SWEEPS: dict[str, tuple[str, ...]] = {
    "auto": ("shortest_mm", "smooth_px", "width", SCALE, SPEED),
    "sketch": ("strong", "weak", "shortest_mm", "join_mm", "smooth_px", "width", SCALE, SPEED),
    "canny": ("high", "shortest_mm", "join_mm", "smooth_px", "width", SCALE, SPEED),
    "centreline": ("shortest_mm", "join_mm", "smooth_px", "width", SCALE, SPEED),
    "outline": ("shortest_mm", "join_mm", "smooth_px", "width", SCALE, SPEED),
    "paper": ("high", "smooth", "width", SCALE, SPEED),
    "squiggle": ("pitch", "wave", SCALE, SPEED),
    "hatch": ("pitch", SCALE, SPEED),
    "streamlines": ("longest", SCALE, SPEED),
    "spiral": ("pitch", "wave", SCALE, SPEED),
    "one_line": ("points", SCALE, SPEED),
    "threshold_rows": ("pitch", "threshold", SCALE, SPEED),
    "stipple": ("dots", SCALE, SPEED),
    "portrait": ("weight", "strong", "shortest_mm", "width", SCALE, SPEED),
    "strokes": (SCALE, SPEED),
}
"""Mode -> settings that change its time or its look; `strokes` stands for every source without a picture."""

RANGES: dict[str, tuple[float, float]] = {
    SCALE: (0.4, 1.0),
    SPEED: (20.0, 320.0),
    "width": (200.0, 1000.0),
    "smooth": (1.0, 13.0),
    "high": (50.0, 400.0),
    "points": (1000.0, 16_000.0),
    "dots": (250.0, 4000.0),
}
"""Where a slider's own range would be a waste of time."""

LOGARITHMIC = frozenset({SPEED, "width", "high", "pitch", "longest", "points", "dots"})
"""Settings of which each value is so many times the one before."""

AROUND = 4.0
"""Of a slider's default, the most that is tried."""


@dataclass(frozen=True)
class SweepPoint:
    """One drawing of a sweep; what could not be drawn has NaN, no strokes and its reason."""

    value: float
    """Of the setting."""
    time_s: float = math.nan
    """Of the whole toolpath."""
    similarity: float = math.nan
    """0 to 1, how like the picture the ink looks from a little away; with strokes, how like their own ink."""
    ink_mm: float = math.nan
    """Length drawn, stray ink included."""
    strokes: int = 0
    reason: str = ""
    """Why it could not be drawn, one sentence."""
    deviation_um: float = math.nan
    """Root mean square distance of what is drawn from the strokes."""


def sweep_point(
    source: Source, look: Look, robot: Robot, placement: Placement, pen: PenSettings, parameter: str, value: float
) -> SweepPoint:
    """Draw the source with one setting changed, and measure what the pen really leaves on the paper.

    The picture is the source's own, before it is prepared: so it stays the same when its preparation is swept.

    parameter: one of the mode's, "scale" or "speed_mm_s" (of the pen).
    """
    try:
        if parameter == SPEED:
            pen = replace(pen, speed_mm_s=value)
        else:
            look = _changed(look, parameter, value)
        return _measured(source, look, robot, placement, pen, value)
    except DrawingError as error:
        return SweepPoint(value, reason=str(error))


def sweep_values(mode: str, parameter: str, n: int = 7) -> list[float]:
    """Up to `n` ascending values of a setting that are worth trying; they are all on its slider."""
    if parameter in (SCALE, SPEED):
        return [float(f"{value:.2g}") for value in _spread(parameter, *RANGES[parameter], n)]
    sliders = DRAWING_MODES[mode].parameters if mode in DRAWING_MODES else ()
    slider = next((each for each in sliders if each.name == parameter), None)
    if slider is None:
        raise DrawingError(f"The mode {mode} has no setting {parameter}; choose another one to sweep.")
    if slider.choices:
        return list(slider.choices)
    low, high = RANGES.get(parameter, (slider.default / AROUND, slider.default * AROUND))
    if parameter not in LOGARITHMIC and parameter not in RANGES:
        low = slider.low
    values = _spread(parameter, max(low, slider.low), min(high, slider.high), n)
    steps = np.unique(np.rint((values - slider.low) / slider.step))
    return [round(float(slider.low + step * slider.step), 9) for step in steps]


def _changed(look: Look, parameter: str, value: float) -> Look:
    if parameter == SCALE:
        return replace(look, scale=value)
    return replace(look, parameters={**look.parameters, parameter: value})


def _measured(
    source: Source, look: Look, robot: Robot, placement: Placement, pen: PenSettings, value: float
) -> SweepPoint:
    composition = compose(source, look)
    toolpath = plan_toolpath(composition.strokes, robot, placement, pen)
    drawn = drawn_strokes(toolpath, placement)
    return SweepPoint(
        value,
        toolpath.duration_s,
        _likeness(source, composition, drawn, look.pen_mm),
        ink_mm(drawn),
        len(composition.strokes),
        deviation_um=deviation_um(toolpath, placement, composition.strokes),
    )


def _likeness(source: Source, composition: Composition, drawn: list[Array], pen_mm: float) -> float:
    if source.grey is None or composition.prepared is None:
        return likeness_to_strokes(composition.strokes, drawn, pen_mm)
    mm_per_px = composition.mm_per_px * composition.prepared.shape[1] / source.grey.shape[1]
    return likeness(source.grey, drawn, mm_per_px, pen_mm)


def _spread(parameter: str, low: float, high: float, n: int) -> Array:
    """(n,) from low to high."""
    return np.geomspace(low, high, n) if parameter in LOGARITHMIC else np.linspace(low, high, n)
