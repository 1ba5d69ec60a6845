"""Lines along the flow of the picture, closer together where it is darker (after Jobard and Lefer 1997)."""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.rasterise.flow import flow_of
from app.drawing.rasterise.mode import PENS, Parameter, RasterMode
from app.drawing.rasterise.simpler import simpler
from app.drawing.rasterise.tone import drive_for, inked_where, softened, wanted_cover
from app.drawing.rasterise.types import Field, Mask, Stroke

STEP = 1.0
"""Pen widths."""

CLOSEST, FARTHEST = 0.85, 16.0
"""Distance of lines in pen widths, at full and at no drive; neighbours begin a little farther away."""

NEAREST = 0.6
"""A line ends where it comes this near to another, relative to the wanted distance."""

SHORTEST = 4.0
"""Pen widths; shorter lines are left out."""

SEED_EVERY = 3
"""Points along a line from which neighbours are begun."""

CELL = 0.5
"""Pen widths; how finely the room taken by lines is remembered."""

LOOP = 8
"""Steps after which a line that comes to a cell again has gone round."""

PIECE = 8
"""Steps of a line that take room of one width."""

MARGIN = math.ceil(FARTHEST / CELL) + 2
"""Cells around the picture."""

AT_ONCE = 500
"""Places for a line that are tried before those that have become crowded are sorted out."""

SEEN = 1.0
"""Blur before the picture is read, in pen widths."""

Seed = tuple[float, float, float]
"""(distance of lines there, x, y): where a line may begin, the darkest first."""


def draw(tone: Field, pen: float, smooth: float = 5.0, longest: float = 150.0) -> list[Stroke]:
    """PIXEL strokes; over how much the flow is smoothed and the longest line, both in pen widths."""
    cover = softened(wanted_cover(tone), SEEN * pen)
    drive = drive_for(_diagonals, cover, longest=longest)
    return _Lines(drive, inked_where(tone, pen), pen, tone, smooth, longest).all()


def _diagonals(drive: Field, inked: Mask, pen: float, *, longest: float) -> list[Stroke]:
    """For the calibration, which has no picture to follow."""
    return _Lines(drive, inked, pen, np.zeros_like(drive), 1.0, longest).all()


class _Lines:
    """Lines laid so far, and the room that they take.

    Everything counts in CELLs, so that a step of a line is a few look-ups in flat memory. Around the picture there is
    MARGIN of white, so that nothing has to ask where it ends.
    """

    def __init__(self, drive: Field, inked: Mask, pen: float, tone: Field, smooth: float, longest: float) -> None:
        height, width = drive.shape
        self.cell = CELL * pen
        columns, rows = size = max(1, math.ceil(width / self.cell)), max(1, math.ceil(height / self.cell))
        pens = max(1, math.ceil(width / pen)), max(1, math.ceil(height / pen))
        small = np.asarray(cv2.resize(tone, pens, interpolation=cv2.INTER_AREA), np.float32)
        flow = flow_of(small, smooth, size)
        self.way_x, self.way_y = (np.pad(STEP / CELL * axis, MARGIN, mode="edge").reshape(-1).data for axis in flow)
        pick = _nearest(rows, self.cell, height)[:, None], _nearest(columns, self.cell, width)
        self.apart = np.pad(1 / (CELL * np.maximum(drive[pick] / CLOSEST, 1 / FARTHEST)), MARGIN, mode="edge")
        # 1 where a line would come too near, and where another one should not begin; white paper is both at once
        self.taken = np.pad(np.where(inked[pick], 0, 1).astype(np.uint8), MARGIN, constant_values=1)
        self.crowded = self.taken.copy()
        self.taken_at = self.taken.reshape(-1).data
        self.columns = self.taken.shape[1]
        self.most = max(2, round(longest / STEP))

    def all(self) -> list[Stroke]:
        """Dark lines first, each followed by its neighbours."""
        strokes = []
        for seed in self._everywhere():
            waiting = [seed]
            while waiting:
                _, x, y = heapq.heappop(waiting)
                if self.crowded[int(y), int(x)]:
                    continue
                line = self._line(x, y)
                if (len(line) - 1) * STEP < SHORTEST:
                    self.crowded[int(y), int(x)] = 1
                    continue
                self._take(line)
                strokes.append((line - MARGIN) * self.cell - 0.5)
                for beside in self._beside(line):
                    heapq.heappush(waiting, beside)
        return simpler(strokes, self.cell / CELL)

    def _everywhere(self) -> Iterator[Seed]:
        """Every second free cell of every second row, the darkest first."""
        rows, columns = (2 * at for at in np.nonzero(self.crowded[::2, ::2] == 0))
        darkest_first = np.argsort(self.apart[rows, columns], kind="stable")
        for some in np.array_split(darkest_first, max(1, len(darkest_first) // AT_ONCE)):
            row, column = rows[some], columns[some]
            free = self.crowded[row, column] == 0
            for y, x in zip(row[free].tolist(), column[free].tolist(), strict=True):
                yield 0.0, x + 0.5, y + 0.5

    def _line(self, x: float, y: float) -> NDArray[np.float64]:
        visited: dict[int, int] = {}
        onwards = self._half(x, y, 1, visited, self.most)
        back = self._half(x, y, -1, visited, self.most - len(onwards))
        return np.array([*reversed(back), (x, y), *onwards])

    def _half(self, x: float, y: float, sign: int, visited: dict[int, int], most: int) -> list[tuple[float, float]]:
        """From a start along the flow, until there is no room."""
        way_x, way_y, taken, columns = self.way_x, self.way_y, self.taken_at, self.columns
        at = int(y) * columns + int(x)
        dx, dy = sign * way_x[at], sign * way_y[at]
        points = []
        for count in range(0, sign * most, sign):
            # the direction half a step ahead keeps circles from widening
            at = int(y + dy / 2) * columns + int(x + dx / 2)
            c, s = way_x[at], way_y[at]
            dx, dy = (c, s) if c * dx + s * dy >= 0 else (-c, -s)
            x, y = x + dx, y + dy
            at = int(y) * columns + int(x)
            if taken[at] or abs(visited.setdefault(at, count) - count) > LOOP:
                break
            points.append((x, y))
        return points

    def _take(self, line: NDArray[np.float64]) -> None:
        """Piece by piece, each as wide as its middle wants; what one is rounded by, the next makes up for."""
        firsts = np.arange(0, len(line) - 1, PIECE)
        column, row = line[np.minimum(firsts + PIECE // 2, len(line) - 1)].astype(int).T
        wanted = 2 * np.outer((1.0, NEAREST), self.apart[row, column]) - 1
        widths = np.diff(np.rint(np.cumsum(wanted, axis=1)), axis=1, prepend=0).astype(int).tolist()
        points = np.rint((line - 0.5) * 16).astype(np.int32)
        pieces = [points[first : first + PIECE + 1] for first in firsts.tolist()]
        for room, own in zip((self.crowded, self.taken), widths, strict=True):
            for piece, width in zip(pieces, own, strict=True):
                cv2.polylines(room, [piece], False, 1, width, cv2.LINE_8, 4)

    def _beside(self, line: NDArray[np.float64]) -> list[Seed]:
        """Free places on both sides, where neighbours could begin."""
        points = line[:-1:SEED_EVERY]
        along = line[1::SEED_EVERY] - points
        column, row = points.astype(int).T
        away = (self.apart[row, column] + 0.8)[:, None] * along[:, ::-1] * (-1, 1) * (CELL / STEP)
        x, y = np.concatenate([points + away, points - away]).T
        column, row = x.astype(int), y.astype(int)
        free = self.crowded[row, column] == 0
        apart = self.apart[row[free], column[free]]
        return list(zip(apart.tolist(), x[free].tolist(), y[free].tolist(), strict=True))


def _nearest(count: int, cell: float, side: int) -> NDArray[np.int64]:
    """(count,) the pixel, of `side` pixels, in the middle of each cell."""
    return np.clip(np.rint((np.arange(count) + 0.5) * cell - 0.5), 0, side - 1).astype(np.int64)


STREAMLINES = RasterMode(
    "Streamlines",
    "Lines that follow the shapes, closer together where the picture is darker. The most like a drawing by hand.",
    (
        Parameter("smooth", "Smoothness of the flow", 5.0, 1.0, 20.0, 0.5, PENS),
        Parameter("longest", "Longest line", 150.0, 20.0, 1000.0, 10.0, PENS),
    ),
    draw,
)
