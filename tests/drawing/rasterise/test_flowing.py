"""Streamlines, dots and the one line: that they follow the picture."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import KDTree

from app.drawing.rasterise import rasterise
from app.drawing.rasterise.points import hilbert, points_of
from app.drawing.rasterise.tour import shortened
from tests.drawing.rasterise.walk import walked
from tests.support.paper import flat


def length(way):
    return np.linalg.norm(np.diff(way, axis=0), axis=1).sum()


def crossings(way):
    """Pairs of segments that cross, by the signs of the areas."""
    a, b = way[:-1], way[1:]

    def side(p, q, r):
        one, other = q - p, r - p
        return np.sign(one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0])

    a1, b1, a2, b2 = a[:, None], b[:, None], a[None], b[None]
    crossed = (side(a1, b1, a2) * side(a1, b1, b2) < 0) & (side(a2, b2, a1) * side(a2, b2, b1) < 0)
    return np.count_nonzero(crossed) // 2


def test_streamlines_go_round_a_ball():
    y, x = np.mgrid[:200, :200] - 99.5
    radius = np.hypot(x, y)
    grey = np.clip(40 + 1.5 * radius, 0, 255).astype(np.uint8)
    off = []
    for stroke in rasterise(grey, "streamlines", 0.25, pen_mm=0.5):
        middle, way = (stroke[1:] + stroke[:-1]) / 2 - 99.5, np.diff(stroke, axis=0)
        far = np.hypot(*middle.T)
        outwards = np.abs((middle * way).sum(axis=1)) / (far * np.hypot(*way.T))
        off.append(outwards[(far > 30) & (far < 80)])
    assert np.mean(np.concatenate(off)) < 0.15


@pytest.mark.parametrize("darkness", [0.3, 0.6])
def test_streamlines_keep_their_distance(darkness):
    """Where cover is c, parallel lines are a pen's width / c apart; none comes nearer than about 0.6 of that."""
    strokes = [walked(stroke) for stroke in rasterise(flat(darkness, 200), "streamlines", 0.25, pen_mm=0.5)]
    number = np.repeat(np.arange(len(strokes)), [len(stroke) for stroke in strokes])
    points = np.concatenate(strokes)
    trees = [KDTree(points[number != own]) for own in range(len(strokes))]
    nearest = np.concatenate([tree.query(stroke)[0] for tree, stroke in zip(trees, strokes, strict=True)])
    apart = 2.0 / (0.8 * darkness)
    assert np.quantile(nearest, 0.01) > 0.5 * apart
    assert np.median(nearest) == pytest.approx(apart, rel=0.2)


def test_streamlines_end_at_their_longest():
    strokes = rasterise(flat(0.4, 300), "streamlines", 0.25, pen_mm=0.5, longest=40)
    lengths = [length(stroke) for stroke in strokes]
    assert max(lengths) <= 40 * 2.0 + 2 and min(lengths) >= 4 * 2.0 - 1e-3


@pytest.mark.parametrize("order", [1, 2, 3, 6])
def test_the_hilbert_curve_visits_every_cell_step_by_step(order):
    cells = hilbert(order)
    assert (np.abs(np.diff(cells, axis=0)).sum(axis=1) == 1).all()
    assert len(np.unique(cells, axis=0)) == 4**order
    assert cells.min() == 0 and cells.max() == 2**order - 1


def test_points_are_as_dense_as_wanted_and_evenly_spread():
    density = np.tile(np.repeat([0.05, 0.2], 50).astype(np.float32), (100, 1))
    points = points_of(density, density > 0, 1.0, 10_000)
    left = np.count_nonzero(points[:, 0] < 49.5)
    assert left == pytest.approx(0.05 * 5000, rel=0.1)
    assert len(points) - left == pytest.approx(0.2 * 5000, rel=0.1)
    nearest = KDTree(points).query(points, 2)[0][:, 1]
    # points thrown at random are on average 0.5 / sqrt(density) from the nearest, a triangular lattice 1.07
    assert np.quantile(nearest[points[:, 0] > 55], 0.05) > 0.65 / np.sqrt(0.2)


def test_no_two_points_lie_together():
    density = np.full((90, 130), 2.0, np.float32)
    points = points_of(density, density > 0, 1.0, 50_000)
    assert len(points) == pytest.approx(2 * 90 * 130, rel=0.01)
    assert KDTree(points).query(points, 2)[0][:, 1].min() > 0.1


def test_too_many_points_get_fewer_everywhere():
    density = np.tile(np.repeat([0.05, 0.2], 50).astype(np.float32), (100, 1))
    points = points_of(density, density > 0, 1.0, 500)
    assert len(points) == 500
    assert np.count_nonzero(points[:, 0] < 49.5) == pytest.approx(100, abs=15)


@given(st.integers(0, 10_000), st.integers(1, 60))
@settings(max_examples=40, deadline=None)
def test_the_short_way_visits_the_same_points_and_is_no_longer(seed, count):
    points = np.random.default_rng(seed).random((count, 2))
    way = shortened(points)
    np.testing.assert_array_equal(np.sort(way.view("f8,f8"), axis=0), np.sort(points.view("f8,f8"), axis=0))
    assert length(way) <= length(np.vstack([points, points[:1]])) + 1e-9


def test_points_on_the_same_spot_are_all_visited():
    points = np.repeat(np.random.default_rng(4).random((30, 2)), 12, axis=0)
    way = shortened(points)
    np.testing.assert_array_equal(np.sort(way.view("f8,f8"), axis=0), np.sort(points.view("f8,f8"), axis=0))


def test_the_short_way_is_short():
    """Random points: the best closed way is 0.7124 sqrt(n A) long (Applegate et al.), 2-opt about 1.05-1.15 of it."""
    points = np.random.default_rng(1).random((1500, 2))
    way = shortened(points[np.argsort(points[:, 0])])
    assert length(way) < 1.2 * 0.7124 * np.sqrt(1500) * (1 + 0.33 / np.sqrt(1500))


def test_the_one_line_hardly_crosses_itself_and_keeps_to_its_number_of_points():
    (line,) = rasterise(flat(0.8, 150), "one_line", 0.25, pen_mm=0.5, points=1000)
    assert len(line) == 1000
    assert crossings(line) <= 3


def test_dots_are_dots():
    dots = np.array(rasterise(flat(0.2, 100), "stipple", 0.25, pen_mm=0.5, dots=300))
    assert dots.shape == (300, 2, 2)
    np.testing.assert_array_equal(dots[:, 0], dots[:, 1])
