"""How large a source becomes on its sheet, and where its points come to lie."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.toolpath.placement import Sheet, fit_to_sheet

Array = NDArray[np.float64]
Size = tuple[float, float]

LARGEST_MM = 5000.0
LARGEST_SCALE = 10.0
FINEST = 0.4
"""Width of a pixel in pen widths: what is finer nobody sees on the paper."""


def room_mm(sheet_mm: Size, margin_mm: float, scale: float) -> Size:
    """Width and height that a drawing may have: `scale` times what the margins leave of the sheet."""
    width, height = (side - 2.0 * margin_mm for side in sheet_mm)
    if not (margin_mm >= 0.0 and 0.0 < width < LARGEST_MM and 0.0 < height < LARGEST_MM):
        raise DrawingError(
            f"A sheet of {sheet_mm[0]:g} x {sheet_mm[1]:g} mm with margins of {margin_mm:g} mm has no room to draw on; "
            "choose a larger sheet or smaller margins."
        )
    if not 0.0 < scale <= LARGEST_SCALE:
        raise DrawingError(f"A scale of {scale:g} is not possible; choose one above 0, up to {LARGEST_SCALE:g}.")
    return scale * width, scale * height


def pixel_mm(shape: tuple[int, ...], room: Size) -> float:
    """Side of a pixel of a picture (h, w) that fills the room in mm."""
    return min(room[0] / shape[1], room[1] / shape[0])


def seen_width(shape: tuple[int, ...], room: Size, pen_mm: float) -> int | None:
    """Pixels across a picture (h, w) that show all that the pen can draw of it; None if it has no more than that."""
    shrink = pixel_mm(shape, room) / (FINEST * pen_mm)
    return max(round(shrink * shape[1]), 1) if shrink < 1.0 else None


def on_sheet(pixels: Sequence[Array], shape: tuple[int, ...], mm_per_px: float) -> list[Array]:
    """Pixel strokes of a picture (h, w) in sheet millimetres, the picture in the middle, y up."""
    middle = np.array([(shape[1] - 1) / 2, (shape[0] - 1) / 2])
    return [mm_per_px * (np.asarray(stroke, dtype=float) - middle) * np.array([1.0, -1.0]) for stroke in pixels]


def in_pixels(strokes_mm: Sequence[Array], shape: tuple[int, ...], mm_per_px: float) -> list[Array]:
    """Sheet strokes in the pixels of a picture (h, w) in the middle of the sheet: the inverse of `on_sheet`."""
    middle = np.array([(shape[1] - 1) / 2, (shape[0] - 1) / 2])
    return [stroke / mm_per_px * (1.0, -1.0) + middle for stroke in strokes_mm]


def fitted(strokes: Sequence[Array], room: Size) -> list[Array]:
    """Strokes of any size, y up, in sheet millimetres: as large as the room allows, in the middle of the sheet."""
    return fit_to_sheet(strokes, Sheet("chosen", *room), 0.0)


def leaves_sheet(strokes: Sequence[Array], sheet_mm: Size) -> bool:
    """Whether any point of sheet strokes lies beside the paper."""
    reach = np.abs(np.concatenate(strokes)).max(axis=0)
    return bool((reach > np.array(sheet_mm) / 2.0 + 1e-6).any())
