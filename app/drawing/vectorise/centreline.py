"""The middle of every line of a drawing, with its dots."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.vectorise.chains import Line
from app.drawing.vectorise.detail import blurred
from app.drawing.vectorise.ink import depth_of, find_ink
from app.drawing.vectorise.tracing import Finish, trace_strokes

RIDGE = 0.35
"""Blur of the ink on whose crest the middle line runs, in usual widths: more would shrink small circles."""

SMALLEST_DOT = 0.5
"""Diameter, in usual widths of the ink."""


def centrelines(grey: NDArray[np.uint8], mm_per_px: float, finish: Finish) -> tuple[list[Line], NDArray[np.bool_]]:
    """(strokes in pixels, what was taken for ink (h, w)) of a drawing (h, w)."""
    ink, darkness = find_ink(grey)
    if not ink.any():
        return [], ink
    depth = depth_of(ink)
    half_width = np.maximum(depth - 0.5, 0.5)
    usual = 2.0 * float(np.median(depth[ink]))  # of the depths across a line, the median is half the largest
    ridge = blurred(darkness, max(RIDGE * usual, 1.0))
    strokes = trace_strokes(ink, ridge, mm_per_px, finish, half_width)
    return strokes + _dots(ink, strokes, np.pi / 4.0 * (SMALLEST_DOT * 2.0 * usual) ** 2), ink


def _dots(ink: NDArray[np.bool_], strokes: list[Line], smallest: float) -> list[Line]:
    """Two equal points in the middle of every blob of ink that no stroke passes, if it is not just a speck."""
    _, labels, facts, middle = cv2.connectedComponentsWithStats(ink.astype(np.uint8))
    blob = np.asarray(labels, np.intp)
    passed = np.zeros(len(facts), bool)
    passed[0] = True
    for stroke in strokes:
        x, y = np.rint(stroke).astype(int).T
        passed[blob[np.clip(y, 0, ink.shape[0] - 1), np.clip(x, 0, ink.shape[1] - 1)]] = True
    dots = ~passed & (facts[:, cv2.CC_STAT_AREA] >= smallest)
    return [np.array([centre, centre]) for centre in middle[dots]]
