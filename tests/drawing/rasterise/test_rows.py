"""Squiggles, hatching, spirals and the paper's rows: how their lines lie."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.drawing.rasterise import rasterise, similarity
from app.drawing.rasterise.runs import runs
from tests.drawing.rasterise.walk import walked
from tests.support.paper import face, flat


@given(st.lists(st.text(alphabet=".#", min_size=6, max_size=6), min_size=1, max_size=4), st.integers(0, 3))
def test_runs_are_those_that_a_reader_would_mark(pictures, gap):
    """A run is a stretch of one line from # to #, without more than `gap` dots in a row."""
    wanted = []
    for number, picture in enumerate(pictures):
        dark = [at for at, mark in enumerate(picture) if mark == "#"]
        for at in dark:
            if wanted and wanted[-1][0] == number and at - wanted[-1][2] - 1 <= gap:
                wanted[-1] = (number, wanted[-1][1], at)
            else:
                wanted.append((number, at, at))
    wanted = [run for run in wanted if run[2] - run[1] + 1 >= 2]
    down = np.array([mark == "#" for mark in "".join(pictures)])
    first, last = runs(down, np.arange(len(down)) // 6, gap, shortest=2)
    assert list(zip(first // 6, first % 6, last % 6, strict=True)) == wanted


@pytest.mark.parametrize("side", [320, 512])
def test_a_squiggled_face_is_like_the_face(side):
    grey = face(side)
    strokes = rasterise(grey, "squiggle", 160 / side)
    assert similarity(grey, strokes, 160 / side, 0.5) >= 0.86
    assert len(strokes) < 200


@pytest.mark.parametrize("mode", ["hatch", "squiggle"])
def test_a_tone_is_liker_to_the_face_than_the_papers_rows(mode):
    grey = face(320)
    rows = similarity(grey, rasterise(grey, "threshold_rows", 0.5), 0.5, 0.5)
    assert similarity(grey, rasterise(grey, mode, 0.5), 0.5, 0.5) > rows + 0.3


def test_squiggles_swing_more_where_it_is_darker_and_lie_a_pitch_apart():
    grey = np.full((80, 300), 128, np.uint8)
    grey[:, 150:] = 20
    strokes = rasterise(grey, "squiggle", 0.25, pen_mm=0.5, pitch=4.0, wave=2.4)
    middles = [(stroke[:, 1].max() + stroke[:, 1].min()) / 2 for stroke in strokes]
    np.testing.assert_allclose(np.diff(middles), 8.0, atol=0.5)
    for number, stroke in enumerate(strokes):
        light, dark = stroke[stroke[:, 0] < 130, 1], stroke[stroke[:, 0] > 170, 1]
        assert np.ptp(dark) > 1.3 * np.ptp(light) > 0
        assert (stroke[-1, 0] > stroke[0, 0]) == (number % 2 == 0)


def test_squiggles_have_the_wanted_wave():
    strokes = rasterise(flat(0.8, 200), "squiggle", 0.25, pen_mm=0.5, wave=3.0)
    y = walked(strokes[5])[:, 1]
    y -= y.mean()
    crossings = np.count_nonzero(np.diff(np.sign(y[np.abs(y) > 0.1])))
    assert crossings / 2 == pytest.approx(200 / 6.0, abs=1)


@pytest.mark.parametrize("angle", [0.0, 20.0, 45.0, 90.0])
def test_hatching_is_straight_in_two_directions_and_as_far_apart_as_wanted(angle):
    strokes = np.array(rasterise(flat(1.0, 100), "hatch", 0.25, pen_mm=0.5, angle=angle, pitch=1.5))
    assert strokes.shape[1:] == (2, 2)
    way = strokes[:, 1] - strokes[:, 0]
    turned = np.degrees(np.arctan2(way[:, 1], way[:, 0])) % 180
    off = np.minimum(np.abs(turned - angle), 180 - np.abs(turned - angle))
    assert np.allclose(np.minimum(off, np.abs(off - 90)), 0, atol=1e-6)
    along = strokes[off < 45].mean(axis=1)
    across = np.sort(along @ (-math.sin(math.radians(angle)), math.cos(math.radians(angle))))
    pitches = np.diff(across) / 3.0
    np.testing.assert_allclose(pitches, np.rint(pitches), atol=1e-9)
    assert pitches.min() > 0.5 and np.mean(pitches < 1.5) > 0.8, "nearly all of them for black"


def test_hatching_has_more_lines_for_every_step_of_darkness():
    counts = [len(rasterise(flat(tone, 100), "hatch", 0.25, pen_mm=0.5)) for tone in np.linspace(0.1, 1.0, 10)]
    assert (np.diff(counts) > 0).all()


@given(st.integers(0, 1000), st.integers(10, 90))
def test_the_papers_rows_are_the_runs_of_dark_pixels(seed, threshold):
    grey = np.random.default_rng(seed).integers(0, 256, (9, 14)).astype(np.uint8)
    strokes = rasterise(grey, "threshold_rows", 0.5, pen_mm=0.5, threshold=threshold)
    drawn = np.zeros(grey.shape, bool)
    for (x0, y0), (x1, y1) in strokes:
        assert y0 == y1 == round(y0)
        assert x0 == x1 or (x1 > x0) == (y0 % 2 == 0), "to and fro"
        row = slice(int(min(x0, x1)), int(max(x0, x1)) + 1)
        assert not drawn[int(y0), row].any()
        drawn[int(y0), row] = True
    np.testing.assert_array_equal(drawn, np.rint(100 * 255 - 100.0 * grey) >= threshold * 255 - 50)
    assert len(strokes) == sum(np.count_nonzero(np.diff(np.r_[0, line, 0]) == 1) for line in drawn.astype(int))


def test_the_spiral_keeps_its_turns_apart():
    grey = flat(0.1, 200)
    (spiral,) = rasterise(grey, "spiral", 0.25, pen_mm=0.5, pitch=4.0)
    x, y = (walked(spiral) - 99.5).T
    radius = np.hypot(x, y)
    crossings = radius[1:][(y[:-1] < 0) & (y[1:] >= 0) & (x[1:] > 0)]
    np.testing.assert_allclose(np.diff(crossings), 8.0, atol=0.2)
    assert 92 <= radius.max() <= 100 + 1e-6


def test_squiggles_do_not_swing_out_over_white():
    grey = flat(1.0, 120)
    grey[33:87] = 255
    strokes = rasterise(grey, "squiggle", 0.25, pen_mm=0.5, pitch=10.0)
    y = np.concatenate([walked(stroke) for stroke in strokes])[:, 1]
    assert y.min() < 25 and y.max() > 95
    assert not ((y > 33) & (y < 86)).any()
