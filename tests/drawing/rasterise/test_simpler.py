"""Strokes with few points, which the pen cannot tell from those with many."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import KDTree

from app.drawing.rasterise import rasterise
from app.drawing.rasterise.simpler import TOLERANCE, simpler
from tests.drawing.rasterise.walk import walked
from tests.support.paper import flat


@pytest.mark.parametrize("pen", [1.0, 2.5, 20.0])
def test_a_wave_keeps_its_shape_with_fewer_points(pen):
    x = np.arange(0.0, 200.0, 0.2)
    wave = pen * np.column_stack([x, 2 * np.sin(2 * np.pi * x / 2.4)])
    (fewer,) = simpler([wave], pen)
    off = KDTree(walked(fewer, 0.01 * pen)).query(wave)[0]
    assert off.max() <= 1.1 * TOLERANCE * pen
    assert len(fewer) < 0.7 * len(wave)
    np.testing.assert_allclose(fewer[[0, -1]], wave[[0, -1]], atol=1e-3)


def test_dots_and_straight_lines_are_two_points():
    dot, line = np.full((2, 2), 7.3), np.column_stack([np.linspace(0, 90, 50), np.full(50, 3.25)])
    assert [len(stroke) for stroke in simpler([dot, line], 2.0)] == [2, 2]


def test_rows_that_do_not_swing_are_two_points():
    rows = rasterise(flat(0.12, 200), "squiggle", 0.25, pen_mm=0.5)
    assert rows and all(len(row) == 2 for row in rows)


def test_the_spiral_bends_with_few_points():
    (spiral,) = rasterise(flat(0.1, 300), "spiral", 0.25, pen_mm=0.5)
    length = np.hypot(*np.diff(spiral, axis=0).T).sum()
    assert len(spiral) < length / (1.5 * 2.0), "more than one and a half pens apart on average"
