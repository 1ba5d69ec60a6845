"""A picture of strokes: what will be drawn, in which order, and what cannot."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.exports.strokes import SheetSize, Stroke, checked_sheet, checked_strokes, from_corner, hops

PEN_MM = 0.5
MAX_PIXELS = 50_000_000

Colour = tuple[int, int, int]
"""Blue, green, red."""

EDGE: Colour = (170, 170, 170)
MARGIN: Colour = (225, 225, 225)
HOP: Colour = (200, 200, 200)
STRAY: Colour = (0, 94, 213)
OUTSIDE: Colour = (17, 51, 204)
DARKEST, BRIGHTEST = 0, 205
"""Of the colour map's 255: the yellow beyond does not show on white."""

SPOT_PX = 3.0
"""Width at least of what is out of reach."""

COMPRESSION = (cv2.IMWRITE_PNG_COMPRESSION, 1)
"""The fastest: a preview is made at every move of a slider."""

SHIFT = 4
"""Fractional bits of OpenCV's coordinates."""

DOT = np.array([[-(2**SHIFT) // 2, 0], [2**SHIFT // 2, 0]], np.int32)
"""OpenCV shows nothing of a line of no length: a dot is one of a pixel."""

Line = NDArray[np.int32]
"""(n, 2) in fractions of pixels."""


def write_preview_png(
    strokes: Sequence[Stroke],
    sheet_mm: SheetSize,
    px_per_mm: float = 4.0,
    pen_mm: float = PEN_MM,
    outside: Sequence[NDArray[np.bool_]] | None = None,
    stray: bool = False,
    margin_mm: float | None = None,
) -> bytes:
    """PNG of the whole sheet with a thin edge: strokes as wide as the pen, from blue (first) to orange (last).

    Args:
        outside: (n,) for each stroke, which of its points are out of reach; they are red.
        stray: whether the pen draws between the strokes too, in orange; if not, its ways are thin and grey.
        margin_mm: of the sheet, shown as a thin frame.
    """
    sheet = checked_sheet(sheet_mm)
    picture = _paper(sheet, px_per_mm, margin_mm)
    drawn = checked_strokes(strokes)
    lines, moves = (_to_pixels(some, sheet, px_per_mm) for some in (drawn, list(hops(drawn))))
    width = pen_mm * px_per_mm
    _draw(picture, moves, STRAY if stray else HOP, width if stray else 1.0)
    for colour, group in groupby(zip(_colours(len(lines)), lines, strict=True), key=lambda pair: pair[0]):
        _draw(picture, [line for _, line in group], colour, width)
    if outside is not None:
        _draw(picture, _out_of_reach(lines, outside), OUTSIDE, max(width, SPOT_PX))
    return cv2.imencode(".png", picture, COMPRESSION)[1].tobytes()


def _paper(sheet: SheetSize, px_per_mm: float, margin_mm: float | None) -> NDArray[np.uint8]:
    """(h, w, 3) white, with its edge, and its margin if there is room inside."""
    if not px_per_mm > 0.0 or sheet[0] * sheet[1] * px_per_mm**2 > MAX_PIXELS:
        raise DrawingError(f"A preview with {px_per_mm:g} pixels a mm has none or too many; choose another number.")
    width, height = (max(round(side * px_per_mm), 1) for side in sheet)
    picture = np.full((height, width, 3), 255, np.uint8)
    inset = round((margin_mm or 0.0) * px_per_mm)
    if 0 < 2 * inset < min(width, height):
        cv2.rectangle(picture, (inset, inset), (width - 1 - inset, height - 1 - inset), MARGIN)
    cv2.rectangle(picture, (0, 0), (width - 1, height - 1), EDGE)
    return picture


def _to_pixels(strokes: list[Stroke], sheet: SheetSize, px_per_mm: float) -> list[Line]:
    """The corner of the sheet is the corner of a pixel, not its centre."""
    if not strokes:
        return []
    points = from_corner(np.concatenate(strokes), sheet) * px_per_mm - 0.5
    ends = np.cumsum([len(stroke) for stroke in strokes])
    return [_shown(line) for line in np.split(np.round(points * 2**SHIFT).astype(np.int32), ends[:-1])]


def _shown(line: Line) -> Line:
    return line[:1] + DOT if (line == line[0]).all() else line


def _out_of_reach(lines: list[Line], outside: Sequence[NDArray[np.bool_]]) -> list[Line]:
    """A spot on every point out of reach, and what lies between two of them."""
    if [len(line) for line in lines] != [len(marks) for marks in outside]:
        raise DrawingError("What is out of reach belongs to another drawing; check the reach again.")
    shown = []
    for line, marks in zip(lines, outside, strict=True):
        if not marks.any():
            continue
        segments = np.stack([line[:-1], line[1:]], axis=1)
        shown += [*(line[marks][:, None] + DOT), *segments[marks[:-1] & marks[1:]]]
    return shown


def _draw(picture: NDArray[np.uint8], lines: list[Line], colour: Colour, width: float) -> None:
    """Lines of about this width in pixels."""
    if lines:
        cv2.polylines(picture, lines, False, colour, _thickness(width), cv2.LINE_AA, SHIFT)


def _thickness(width: float) -> int:
    """What makes OpenCV's smooth lines nearest to a width: 1 makes them 1.4 wide, 2 3.4, 3 and 4 5.5, 5 and 6 7.5."""
    wider = max(round((width - 1.4) / 2.0), 0)
    return wider + 1 if wider < 2 else 2 * wider - 1


def _colours(count: int) -> list[Colour]:
    """One a stroke."""
    if not count:
        return []
    values = np.linspace(DARKEST, BRIGHTEST, count).round().astype(np.uint8)
    return [
        (blue, green, red)
        for blue, green, red in cv2.applyColorMap(values[:, None], cv2.COLORMAP_PLASMA)[:, 0].tolist()
    ]
