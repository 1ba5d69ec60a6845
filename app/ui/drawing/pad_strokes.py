"""The strokes on a drawing pad: as its page sends them, and as the server keeps them. No widgets here."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError

Points = NDArray[np.float64]

MAX_STROKES = 500
MAX_POINTS = 20_000
UNITS_PER_MM = 10
"""A page speaks in whole tenths of a millimetre."""

_PIECE = re.compile(r"([0-9]{1,9}) (more|last)((?: -?[0-9]{1,5},-?[0-9]{1,5})+)")
_FULL = f"The pad holds {MAX_STROKES} strokes of {MAX_POINTS:,} points in all: undo or clear some before you draw on."


class Piece(NamedTuple):
    """What one message brings: a stroke, or a part of one that is too long for a message."""

    number: int
    """The page counts its messages."""
    last: bool
    """Whether the stroke ends here."""
    points_mm: Points
    """(n, 2), origin in the middle of the sheet, y up, n >= 1."""


class Stroke(NamedTuple):
    """A stroke (n, 2) in mm, and the number of the piece that ended it; the page knows it by that."""

    number: int
    points_mm: Points


def read_piece(text: str) -> Piece | None:
    """`"17 last 10,-20 30,40"` as a piece; None for anything else, which no pad sends."""
    match = _PIECE.fullmatch(text)
    if match is None:
        return None
    number, mark, points = match.groups()
    pairs = [pair.split(",") for pair in points.split()]
    return Piece(int(number), mark == "last", np.array(pairs, dtype=np.float64) / UNITS_PER_MM)


class PadStrokes:
    """The strokes so far. Pieces are put together, and kept within limits whoever sends them."""

    def __init__(self) -> None:
        self.kept: list[Stroke] = []
        self.heard = 0
        """Number of the newest piece that came."""
        self._begun: list[Points] = []
        self._begun_points = 0

    def take(self, piece: Piece, sheet_mm: tuple[float, float]) -> bool:
        """Add a piece, clamped to a sheet of this width and height; returns whether it ends a stroke.

        Raises `DrawingError` at the end of a stroke that is too much.
        """
        self.heard = piece.number
        self._begun_points += len(piece.points_mm)
        fits = len(self.kept) < MAX_STROKES and self._begun_points <= self._room()
        if fits:
            half = 0.5 * np.array(sheet_mm)
            self._begun.append(np.clip(piece.points_mm, -half, half))
        if not piece.last:
            return False
        begun, self._begun, self._begun_points = self._begun, [], 0
        if not fits:
            raise DrawingError(_FULL)
        self.kept.append(Stroke(piece.number, _stroke(np.concatenate(begun))))
        return True

    def undo(self) -> Stroke | None:
        """Take the newest stroke away and return it, if there is one."""
        return self.kept.pop() if self.kept else None

    def load(self, strokes: Iterable[Points]) -> None:
        """Replace all strokes, in mm; they are numbered downwards from -1, which no page does."""
        self.kept = [Stroke(-k, np.array(points, dtype=np.float64)) for k, points in enumerate(strokes, 1)]

    def _room(self) -> int:
        return MAX_POINTS - sum(len(stroke.points_mm) for stroke in self.kept)


def _stroke(points_mm: Points) -> Points:
    """Without repeated points; a dot is two equal ones."""
    moved = np.any(np.diff(points_mm, axis=0) != 0.0, axis=1)
    stroke = points_mm[np.concatenate([[True], moved])]
    return stroke if len(stroke) > 1 else np.repeat(stroke, 2, axis=0)
