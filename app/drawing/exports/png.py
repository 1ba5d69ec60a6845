"""A picture of strokes: what will be drawn, in which order."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.exports.strokes import Sheet, Stroke, checked_sheet, checked_strokes, from_corner, hops

PEN_MM = 0.5
MAX_PIXELS = 50_000_000
HOP_COLOUR = (200, 200, 200)
DARKEST, BRIGHTEST = 0, 205
"""Of the colour map's 255: the yellow beyond does not show on white."""

SHIFT = 4
"""Fractional bits of OpenCV's coordinates."""


def write_preview_png(strokes: Sequence[Stroke], sheet_mm: Sheet, px_per_mm: float = 4.0) -> bytes:
    """PNG of the whole sheet: strokes from blue (first) to orange (last), moves of the lifted pen thin and grey."""
    sheet = checked_sheet(sheet_mm)
    if not px_per_mm > 0.0 or sheet[0] * sheet[1] * px_per_mm**2 > MAX_PIXELS:
        raise DrawingError(f"A preview with {px_per_mm:g} pixels a mm has none or too many; choose another number.")
    width, height = (max(round(side * px_per_mm), 1) for side in sheet)
    picture = np.full((height, width, 3), 255, np.uint8)
    drawn = [from_corner(stroke, sheet) for stroke in checked_strokes(strokes)]
    for hop in hops(drawn):
        cv2.polylines(picture, [_to_pixels(hop, px_per_mm)], False, HOP_COLOUR, 1, cv2.LINE_AA, SHIFT)
    for stroke, colour in zip(drawn, _colours(len(drawn)), strict=True):
        _draw(picture, _to_pixels(stroke, px_per_mm), colour, PEN_MM * px_per_mm)
    return cv2.imencode(".png", picture)[1].tobytes()


def _draw(picture: NDArray[np.uint8], points: NDArray[np.int32], colour: tuple[int, ...], pen_px: float) -> None:
    """A line about as wide as the pen, or a dot."""
    thickness = max(round(pen_px), 1)
    if (points == points[0]).all():  # OpenCV shows nothing of a line of no length
        points, thickness = points[:2] + np.array([[0, 0], [1, 0]], np.int32), max(thickness, 2)
    cv2.polylines(picture, [points], False, colour, thickness, cv2.LINE_AA, SHIFT)


def _to_pixels(points: Stroke, px_per_mm: float) -> NDArray[np.int32]:
    """(n, 2) in fractions of pixels; the corner of the sheet is the corner of a pixel, not its centre."""
    return np.round((points * px_per_mm - 0.5) * 2**SHIFT).astype(np.int32)


def _colours(count: int) -> list[tuple[int, ...]]:
    """BGR, one a stroke."""
    if not count:
        return []
    values = np.linspace(DARKEST, BRIGHTEST, count).round().astype(np.uint8)
    return [tuple(colour) for colour in cv2.applyColorMap(values[:, None], cv2.COLORMAP_PLASMA)[:, 0].tolist()]
