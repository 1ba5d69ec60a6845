"""From a pixel staircase to what a robot can follow: onto the ridge, smooth, with few points."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from app.drawing.vectorise.chains import Line

MOST_SHIFT_PX = 1.0
ALONG = 3
"""Points to either side from which the direction of a line is taken."""

REACH = 4.0
"""The Gaussian ends at so many deviations."""


class Flock:
    """Many lines as one array, so that every point can be given its neighbours along its own line at once."""

    def __init__(self, lines: Sequence[Line]) -> None:
        self.points = np.concatenate(lines)
        size = np.array([len(line) for line in lines])
        self._stops = np.cumsum(size)
        self._first, self._last = np.repeat(self._stops - size, size), np.repeat(self._stops - 1, size)
        self._closed = (self.points[self._first] == self.points[self._last]).all(axis=1)

    def mean(self, weights: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n, 2) for each point the weighted sum of those about it along its line, itself in the middle.

        Beyond an open end the line goes on, turned about that end; a closed one goes round.
        """
        reach = len(weights) // 2
        total = np.zeros_like(self.points)
        for step, weight in enumerate(weights.tolist(), -reach):
            total += weight * self._stepped(step)
        return total

    def _stepped(self, step: int) -> NDArray[np.float64]:
        first, last = self._first, self._last
        at = np.arange(len(first)) + step
        inside = np.minimum(np.maximum(at, first), last)
        found = self.points[inside]
        beyond = np.flatnonzero(at != inside)
        to, start, stop = at[beyond], first[beyond], last[beyond]
        around = self.points[start + (to - start) % np.maximum(stop - start, 1)]
        turned = 2.0 * found[beyond] - self.points[np.clip(2 * inside[beyond] - to, start, stop)]
        found[beyond] = np.where(self._closed[beyond, None], around, turned)
        return found

    def lines(self) -> list[Line]:
        return np.split(self.points, self._stops[:-1])


def onto_ridge(flock: Flock, height: NDArray[np.float32]) -> None:
    """Move every point across its line to the top of a parabola through `height` (h, w), by at most a pixel."""
    along = flock.mean(np.sign(np.arange(-ALONG, ALONG + 1)))
    across = along[:, ::-1] * (1.0, -1.0) / np.maximum(np.hypot(*along.T), 1e-9)[:, None]
    below, here, above = (_sampled(height, flock.points + step * across) for step in (-1, 0, 1))
    bend = below - 2.0 * here + above
    shift = np.where(bend < 0.0, 0.5 * (below - above) / np.minimum(bend, -1e-9), 0.0)
    flock.points = flock.points + np.clip(shift, -MOST_SHIFT_PX, MOST_SHIFT_PX)[:, None] * across


def smooth(flock: Flock, sigma: float) -> None:
    """Gaussian along each line, deviation in points; the ends of open lines stay."""
    if sigma <= 0.0:
        return
    reach = round(REACH * sigma)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    flock.points = flock.mean(weights / weights.sum())


def simplify(line: Line, tolerance: float) -> Line:
    """Douglas and Peucker: the points without which the line would move by more than `tolerance`."""
    if len(line) < 3 or tolerance <= 0.0:
        return line
    closed = bool((line[0] == line[-1]).all())
    # on a closed line OpenCV's open variant loses the seam
    fewer = cv2.approxPolyDP((line[:-1] if closed else line).astype(np.float32), tolerance, closed)[:, 0].astype(float)
    return np.concatenate([fewer, fewer[:1]]) if closed else fewer


def _sampled(height: NDArray[np.float32], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Bilinear; the picture goes on beyond its borders."""
    x, y = points.T
    limits = (height.shape[0] - 1, height.shape[1] - 1)
    return map_coordinates(height, [np.clip(y, 0, limits[0]), np.clip(x, 0, limits[1])], order=1, output=np.float64)
