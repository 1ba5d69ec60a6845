"""Straight lines in two directions: the darker the picture, the more of the interleaved lines are drawn."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from app.drawing.rasterise.mode import PENS, Parameter, RasterMode
from app.drawing.rasterise.runs import places, runs
from app.drawing.rasterise.tone import drive_for, inked_where, sample, sample_mask, softened, wanted_cover
from app.drawing.rasterise.types import Field, Mask, Stroke

TURN = np.array([0, 2, 1, 3])
"""In which turn each of four neighbouring lines appears: always halfway between those already there."""

STEPS_A_PEN = 2
SEEN = 1.0
"""Blur before the picture is read, in pen widths."""


def draw(tone: Field, pen: float, pitch: float = 1.3, angle: float = 45.0) -> list[Stroke]:
    """PIXEL strokes; the smallest distance of lines in pen widths, their first direction in degrees."""
    cover = softened(wanted_cover(tone), SEEN * pen)
    drive = drive_for(lay, cover, pitch=pitch, angle=angle)
    return lay(drive, inked_where(tone, pen), pen, pitch=pitch, angle=angle)


def lay(drive: Field, inked: Mask, pen: float, *, pitch: float, angle: float) -> list[Stroke]:
    """The lines of one direction, then those across it."""
    first = math.radians(angle)
    along = _direction(drive, inked, pen, pitch, first, 0)
    return along + _direction(drive, inked, pen, pitch, first + math.pi / 2, 1)


def thresholds(count: int, direction: int) -> NDArray[np.float64]:
    """(count,) drives from which each line is drawn; the two directions take turns.

    The second four lines come half a turn later than the first, which halves the steps between tones.
    """
    line = np.arange(count)
    return (2 * TURN[line % 4] + direction + 0.25 + 0.5 * (line // 4 % 2)) / (2 * len(TURN))


def _direction(drive: Field, inked: Mask, pen: float, pitch: float, angle: float, direction: int) -> list[Stroke]:
    height, width = drive.shape
    way = np.array([math.cos(angle), math.sin(angle)])
    across = places(abs(width * way[1]) + abs(height * way[0]), pitch * pen)
    feet = np.outer(across, (-way[1], way[0])) + ((width - 1) / 2, (height - 1) / 2)
    line, along = _inside(feet, way, (width, height), pen / STEPS_A_PEN)
    points = feet[line] + along[:, None] * way
    dark = sample(drive, *points.T) >= thresholds(len(across), direction)[line]
    first, last = runs(dark & sample_mask(inked, *points.T), line, gap=STEPS_A_PEN, shortest=2 * STEPS_A_PEN + 1)
    back = line[first] % 2 == 1
    return list(np.stack([points[np.where(back, last, first)], points[np.where(back, first, last)]], axis=1))


def _inside(
    feet: NDArray[np.float64], way: NDArray[np.float64], size: tuple[int, int], step: float
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Samples (n,) of the lines through `feet` (m, 2) within the picture: the line's number, the way from its foot."""
    with np.errstate(divide="ignore", invalid="ignore"):
        borders = np.stack([(-0.5 - feet) / way, (np.array(size) - 0.5 - feet) / way])
    enter, leave = np.fmax.reduce(borders.min(axis=0), axis=1), np.fmin.reduce(borders.max(axis=0), axis=1)
    count = np.maximum(0, np.floor((leave - enter) / step)).astype(np.int64) + (leave >= enter)
    line = np.repeat(np.arange(len(feet)), count)
    return line, enter[line] + (np.arange(len(line)) - np.repeat(np.cumsum(count) - count, count)) * step


HATCH = RasterMode(
    "Hatching",
    "Straight lines in two directions, more of them where the picture is darker. Easiest on the motors.",
    (
        Parameter("pitch", "Smallest distance of lines", 1.3, 1.0, 4.0, 0.1, PENS),
        Parameter("angle", "Direction", 45.0, 0.0, 90.0, 5.0, "°"),
    ),
    draw,
)
