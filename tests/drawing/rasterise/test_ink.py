"""The simulated ink against samples of the paper, each with its distance from the strokes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from app.drawing.rasterise import ink_cover, render_ink
from tests.support.paper import ink


@pytest.mark.parametrize("pen", [0.7, 1.6, 4.0, 9.0])
@pytest.mark.parametrize("degrees", [0, 14, 30, 45, 60, 90, 120])
def test_a_line_has_the_area_of_the_pens_track(pen, degrees):
    way = 50 * np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees))])
    line = np.array([[60.3, 20.2], [60.3, 20.2] + way])
    wanted = 50 * pen + math.pi * pen**2 / 4
    assert ink_cover([line], (90, 130), pen).sum() == pytest.approx(wanted, rel=0.04)


@pytest.mark.parametrize("pen", [0.7, 1.6, 4.0, 9.0])
def test_a_dot_is_a_disc(pen):
    dot = np.array([[20.4, 20.1], [20.4, 20.1]])
    assert ink_cover([dot], (40, 40), pen).sum() == pytest.approx(math.pi * pen**2 / 4, rel=0.08)


NO_EXPLANATION = [Phase.explicit, Phase.reuse, Phase.generate, Phase.shrink]

points = st.lists(st.tuples(st.floats(0, 29), st.floats(0, 19)), min_size=2, max_size=5).map(np.array)


@given(st.lists(points, min_size=1, max_size=4), st.sampled_from([0.8, 2.0, 3.7]))
@settings(max_examples=30, deadline=None, phases=NO_EXPLANATION)
def test_ink_lies_where_it_is_near_enough_to_a_stroke(strokes, pen):
    found, wanted = ink_cover(strokes, (20, 30), pen), ink(strokes, (20, 30), pen, fine=round(20 / pen))
    assert np.abs(found - wanted).max() < 0.5
    # a share of the width along the lines, and a little at their ends and at the border
    assert abs(found.sum() - wanted.sum()) < 0.05 * wanted.sum() + 0.15 * pen + 0.1


def test_ink_that_overlaps_counts_once():
    line = np.array([[5.0, 10.0], [25.0, 10.0]])
    once, thrice = ink_cover([line], (20, 30), 3.0), ink_cover([line, line[::-1], line], (20, 30), 3.0)
    np.testing.assert_array_equal(once, thrice)


def test_a_sheet_has_its_middle_at_zero_and_y_upwards():
    dot = np.array([[30.0, 15.0], [30.0, 15.0]])
    picture = render_ink([dot], (100.0, 60.0), 2.0, px_per_mm=5.0)
    assert picture.shape == (300, 500) and picture.dtype == np.uint8
    rows, columns = np.nonzero(picture < 128)
    assert rows.mean() == pytest.approx((30 - 15) * 5 - 0.5, abs=0.5)
    assert columns.mean() == pytest.approx((50 + 30) * 5 - 0.5, abs=0.5)
    assert (1 - picture / 255).sum() == pytest.approx(math.pi * 5**2, rel=0.08)


def test_bare_paper_and_strokes_beside_it():
    beside = np.array([[500.0, 500.0], [700.0, 700.0]])
    assert (render_ink([], (20.0, 10.0), 0.5) == 255).all()
    assert (render_ink([beside], (20.0, 10.0), 0.5) == 255).all()
    assert render_ink([np.zeros((2, 2))], (0.1, 0.1), 0.5).shape == (1, 1)
