"""Photographs: Canny's edges traced once, the sketch, and the paper's way beside them."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.prepare import prepare
from app.drawing.vectorise import vectorise
from app.drawing.vectorise.sketch import along_flow
from tests.drawing.vectorise.pictures import (
    MM_PER_PX,
    SHAPE,
    arc,
    f_score,
    inked,
    length,
    photo,
    retraced,
    rms_and_covered,
)

SEEDS = [0, 1, 2]


@pytest.mark.parametrize("seed", SEEDS)
def test_canny_is_drawn_whole_and_once(seed):
    found = vectorise(photo(seed), "canny", MM_PER_PX)
    assert retraced(found.strokes) <= 0.015
    assert f_score(found.strokes, found.edge_mask) >= 0.98


def test_the_paper_draws_nearly_everything_twice():
    """What our measure must notice, or it measures nothing."""
    found = vectorise(prepare(photo(), smooth=7), "paper", MM_PER_PX)
    ours = vectorise(photo(), "canny", MM_PER_PX)
    assert retraced(found.strokes) > 0.35
    assert length(found.strokes) > 1.8 * length(ours.strokes)
    assert all((stroke[0] == stroke[-1]).all() and len(stroke) >= 2 for stroke in found.strokes)


@pytest.mark.parametrize("aperture", [3, 5, 7])
def test_every_aperture_draws_about_as_much(aperture):
    found = vectorise(photo(), "canny", MM_PER_PX, aperture=aperture)
    usual = vectorise(photo(), "canny", MM_PER_PX)
    assert length(found.strokes) == pytest.approx(length(usual.strokes), rel=0.35)


def test_higher_thresholds_draw_less_and_the_highest_nothing():
    found = [vectorise(photo(), "canny", MM_PER_PX, low=high / 2, high=high) for high in (40, 80, 160, 9999)]
    inks = [length(drawn.strokes) for drawn in found]
    assert inks == sorted(inks, reverse=True) and inks[0] > 2 * inks[2] and inks[3] == 0.0


def test_the_sketch_draws_a_dark_line_once_where_canny_draws_its_sides():
    ring = inked([arc(256, 256, 150)], 4)
    sketch, canny = (vectorise(ring, mode, MM_PER_PX).strokes for mode in ("sketch", "canny"))
    assert length(canny) == pytest.approx(2 * 2 * np.pi * 150, rel=0.05)
    assert length(sketch) == pytest.approx(2 * np.pi * 150, rel=0.05)
    rms, covered = rms_and_covered(sketch, [arc(256, 256, 150)])
    assert rms < 0.35 and covered > 0.97


@pytest.mark.parametrize("seed", SEEDS)
def test_a_sketch_of_a_photo(seed):
    found = vectorise(photo(seed), "sketch", MM_PER_PX)
    assert 5 < len(found.strokes) < 400 and retraced(found.strokes) <= 0.015
    fewer = vectorise(photo(seed), "sketch", MM_PER_PX, strong=0.02, weak=0.05)
    assert length(fewer.strokes) < 0.8 * length(found.strokes)


def test_the_sketch_ignores_light_lines():
    assert vectorise(255 - inked([arc(256, 256, 150)], 3), "canny", MM_PER_PX).strokes
    light = vectorise(255 - inked([arc(256, 256, 150)], 3), "sketch", MM_PER_PX).strokes
    on_it = [stroke for stroke in light if abs(np.hypot(*(stroke - 256).T).mean() - 150) < 1]
    assert not on_it


def test_the_same_at_twice_the_size():
    """Detail grows with the picture: a larger file is not another drawing."""
    noise = np.random.default_rng(5).normal(0, 6, SHAPE)
    grainy = np.clip(photo() + noise, 0, 255).astype(np.uint8)
    small = vectorise(grainy, "canny", MM_PER_PX)
    large = vectorise(prepare(grainy, width=1024), "canny", MM_PER_PX / 2)
    assert MM_PER_PX / 2 * length(large.strokes) == pytest.approx(MM_PER_PX * length(small.strokes), rel=0.15)


def test_the_flow_may_point_either_way_from_pixel_to_pixel():
    """A tensor knows an axis, not a direction; along any the mean of the squared way is the variance."""
    x = np.tile(np.arange(60, dtype=np.float32), (20, 1))
    either = np.random.default_rng(2).choice([-1.0, 1.0], x.shape).astype(np.float32)
    way = along_flow(x * x, either, np.zeros_like(x), 3.0) - x * x
    same = along_flow(x * x, np.ones_like(x), np.zeros_like(x), 3.0) - x * x
    np.testing.assert_allclose(way[:, 10:-10], same[:, 10:-10], rtol=1e-3)
    assert 5.0 < same[10, 30] < 9.0
