"""Drawings whose lines are known, a made-up photograph, and measures of what was drawn of them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from app.drawing.vectorise.chains import Line

Grey = NDArray[np.uint8]
SHAPE = (512, 512)
MM_PER_PX = 160 / 512


def arc(x: float, y: float, a: float, b: float | None = None, start: float = 0.0, stop: float = 360.0) -> Line:
    """Part of an ellipse, degrees."""
    t = np.radians(np.linspace(start, stop, 400))
    return np.column_stack([x + a * np.cos(t), y + (a if b is None else b) * np.sin(t)])


def polygon(*points: tuple[float, float]) -> Line:
    return np.array(points, dtype=float)


def circles_and_cross() -> list[Line]:
    circles = [arc(256, 256, radius) for radius in (40, 80, 120, 160, 200)]
    return [*circles, polygon((30, 40), (480, 470)), polygon((490, 60), (25, 440))]


def spiral() -> list[Line]:
    t = np.linspace(0.0, 16.0 * np.pi, 4000)
    return [np.column_stack([256 + (10 + 4.2 * t) * np.cos(t), 256 + (10 + 4.2 * t) * np.sin(t)])]


def grid() -> list[Line]:
    upright = [polygon((40 + 36 * k, 20), (40 + 36 * k, 490)) for k in range(12)]
    return upright + [polygon((20, 45 + 38 * k), (495, 45 + 38 * k)) for k in range(12)]


def cartoon() -> list[Line]:
    """A face: 16 strokes."""
    eyes = [arc(x, 200, 38) for x in (180, 332)] + [arc(x, 205, 13) for x in (180, 332)]
    brows = [arc(x, 140, 45, 14, 190, 350) for x in (180, 332)]
    whiskers = [polygon((256 + s * 216, y), (256 + s * 248, y + 20)) for s in (-1, 1) for y in (300, 332)]
    rest = [arc(256, 330, 90, 50, 10, 170), arc(256, 420, 30, 12, 200, 340), arc(256, 40, 30, 20, 90, 400)]
    nose = polygon((256, 230), (240, 290), (270, 295))
    return [arc(256, 256, 200), *eyes, *brows, *whiskers, *rest, nose, polygon((100, 490), (412, 490))]


def logo() -> list[Line]:
    """Borders of a disc with a star cut out and a drop in it."""
    t = np.radians(np.arange(11) * 36 - 90)
    radius = np.where(np.arange(11) % 2 == 0, 130, 60)
    star = np.column_stack([256 + radius * np.cos(t), 256 + radius * np.sin(t)])
    return [arc(256, 256, 200), star, arc(256, 256, 25, 40)]


def inked(lines: Sequence[Line], width: int = 5) -> Grey:
    """Drawn with a pen so many pixels wide."""
    picture = np.full(SHAPE, 255, np.uint8)
    for line in lines:
        cv2.polylines(picture, [np.rint(16 * line).astype(np.int32)], False, (0,), width, cv2.LINE_AA, 4)
    return picture


def filled(borders: Sequence[Line]) -> Grey:
    """Black inside, the borders smooth; where two overlap it is white again."""
    fine = 8
    picture = np.full((fine * SHAPE[0], fine * SHAPE[1]), 255, np.uint8)
    cv2.fillPoly(picture, [np.rint(fine * (border + 0.5) - 0.5).astype(np.int32) for border in borders], (0,))
    return np.asarray(cv2.resize(picture, SHAPE, interpolation=cv2.INTER_AREA), np.uint8)


@cache
def photo(seed: int = 0) -> Grey:
    """Fallen leaves, the usual model of a photograph: shaded ellipses of many sizes over each other, and noise."""
    random = np.random.default_rng(seed)
    tone = np.full(SHAPE, 130.0)
    for _ in range(150):
        size = 12.0 * random.random() ** -0.6
        leaf = np.zeros(SHAPE, np.uint8)
        middle, turn = random.integers(0, 512, 2).tolist(), 180.0 * random.random()
        cv2.ellipse(leaf, middle, (int(size), int(size * (0.4 + 0.6 * random.random()))), turn, 0, 360, (1,), -1)
        y, x = np.nonzero(leaf)
        slope_x, slope_y = random.uniform(-0.3, 0.3, 2)
        shade = slope_x * (x - middle[0]) + slope_y * (y - middle[1])
        tone[y, x] = np.clip(random.uniform(20, 235) + shade, 0, 255)
    tone = cv2.GaussianBlur(tone, (0, 0), 0.8) + 3.0 * random.standard_normal(SHAPE)
    return np.clip(tone, 0, 255).astype(np.uint8)


def length(strokes: Sequence[Line]) -> float:
    return sum(float(np.hypot(*np.diff(stroke, axis=0).T).sum()) for stroke in strokes)


def walked(line: Line, step: float = 0.25) -> Line:
    """Points so far apart along a line."""
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
    at = np.linspace(0.0, along[-1], int(along[-1] / step) + 2)
    return np.column_stack([np.interp(at, along, line[:, 0]), np.interp(at, along, line[:, 1])])


def everything(strokes: Sequence[Line]) -> Line:
    return np.concatenate([walked(stroke) for stroke in strokes])


def rms_and_covered(strokes: Sequence[Line], truth: Sequence[Line]) -> tuple[float, float]:
    """(distance of what was drawn from what should be, share of that within 1.5 pixels of what was drawn)."""
    drawn, wanted = everything(strokes), everything(truth)
    off = KDTree(wanted).query(drawn)[0]
    return float(np.sqrt(np.mean(off**2))), float(np.mean(KDTree(drawn).query(wanted)[0] <= 1.5))


def retraced(strokes: Sequence[Line], near: float = 1.0, apart: float = 6.0) -> float:
    """Share of the ink within a pixel of ink drawn earlier, more than 6 pixels of pen way before."""
    points = everything(strokes)
    when = np.concatenate([1000.0 * k + 0.25 * np.arange(len(walked(line))) for k, line in enumerate(strokes)])
    when += np.repeat(np.cumsum([0.0] + [length([line]) for line in strokes[:-1]]), [len(walked(s)) for s in strokes])
    pairs = KDTree(points).query_pairs(near, output_type="ndarray")
    again = np.zeros(len(points), bool)
    again[pairs[np.abs(when[pairs[:, 0]] - when[pairs[:, 1]]) > apart].max(axis=1)] = True
    return float(again.mean())


def f_score(strokes: Sequence[Line], edges: NDArray[np.bool_], near: float = 1.5) -> float:
    """Harmonic mean of the share of ink near an edge pixel, and that of edge pixels near ink."""
    ink, pixels = everything(strokes), np.argwhere(edges)[:, ::-1]
    precision = np.mean(KDTree(pixels).query(ink)[0] <= near)
    recall = np.mean(KDTree(ink).query(pixels)[0] <= near)
    return float(2 * precision * recall / (precision + recall))
