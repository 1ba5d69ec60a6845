"""Onto the ridge, smooth, and with few points, but never elsewhere."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.drawing.vectorise.smoothing import Flock, onto_ridge, simplify, smooth
from tests.drawing.vectorise.pictures import arc, length, polygon, rms_and_covered, walked


def smoothed(line: np.ndarray, sigma: float = 1.0) -> np.ndarray:
    flock = Flock([line])
    smooth(flock, sigma)
    return flock.points


def test_a_staircase_becomes_its_diagonal():
    steps = np.repeat(np.arange(40.0), 2)
    stairs = np.column_stack([steps[1:], steps[:-1]])
    off = (smoothed(stairs, 2.0) @ [1.0, -1.0])[8:-8] - 0.5
    assert np.abs(off).max() < 0.01


def test_a_straight_line_and_the_ends_of_every_line_stay():
    straight = walked(polygon((3, 4), (90, 61)), 1.0)
    np.testing.assert_allclose(smoothed(straight), straight, atol=1e-9)
    bent = np.concatenate([walked(polygon((0, 0), (20, 0)), 1.0), walked(polygon((20, 1), (20, 9)), 1.0)])
    np.testing.assert_allclose(smoothed(bent)[[0, -1]], bent[[0, -1]], atol=1e-9)


def test_a_closed_line_stays_closed_and_smooth_across_its_seam():
    corner = walked(polygon((0, 0), (30, 0), (30, 30), (0, 30), (0, 0)), 1.0)
    rounded = smoothed(corner, 2.0)
    assert (rounded[0] == rounded[-1]).all()
    assert np.hypot(*rounded[0]) == pytest.approx(np.hypot(30 - rounded[31, 0], rounded[31, 1]), abs=0.3)


def test_lines_do_not_pull_at_each_other():
    lines = [walked(polygon((0, 0), (9, 0)), 1.0), walked(polygon((50, 50), (59, 50)), 1.0), np.array([[7.0, 7.0]])]
    flock = Flock(lines)
    smooth(flock, 3.0)
    for before, after in zip(lines, flock.lines(), strict=True):
        np.testing.assert_allclose(after, before, atol=1e-3)


@pytest.mark.parametrize("shift", [-0.45, -0.2, 0.0, 0.3])
def test_onto_the_ridge(shift):
    """A ridge between the pixels is found to a hundredth."""
    y = np.arange(40.0)[:, None]
    ridge = np.repeat(np.exp(-0.5 * ((y - 20 - shift) / 2.0) ** 2), 60, axis=1).astype(np.float32)
    flock = Flock([walked(polygon((5, 20), (55, 20)), 1.0)])
    onto_ridge(flock, ridge)
    np.testing.assert_allclose(flock.points[:, 1], 20 + shift, atol=0.02)


def test_no_ridge_no_move_and_never_more_than_a_pixel():
    line = walked(polygon((5, 20), (55, 20)), 1.0)
    for ground in (np.zeros((40, 60)), np.arange(40.0)[:, None] ** 2 * np.ones((1, 60))):
        flock = Flock([line])
        onto_ridge(flock, ground.astype(np.float32))
        np.testing.assert_allclose(flock.points, line)
    noise = np.random.default_rng(1).random((40, 60)).astype(np.float32)
    flock = Flock([line])
    onto_ridge(flock, noise)
    assert np.abs(flock.points - line).max() <= 1.0


@given(st.integers(0, 1000), st.sampled_from([0.16, 0.5, 2.0]), st.booleans())
def test_simplified_within_its_tolerance(seed, tolerance, closed):
    random = np.random.default_rng(seed)
    line = np.cumsum(random.standard_normal((60, 2)), axis=0)
    line = np.concatenate([line, line[:1]]) if closed else line
    fewer = simplify(line, tolerance)
    start, step = fewer[:-1], np.diff(fewer, axis=0)
    share = ((line[:, None] - start) * step).sum(axis=2) / np.maximum((step**2).sum(axis=1), 1e-12)
    nearest = start + np.clip(share, 0, 1)[..., None] * step
    assert np.hypot(*(line[:, None] - nearest).transpose(2, 0, 1)).min(axis=1).max() <= 1.01 * tolerance + 1e-4
    assert (fewer[0] == fewer[-1]).all() == closed and len(fewer) <= len(line)


def test_a_simplified_circle_has_no_seam():
    circle = arc(100, 100, 50)
    circle[-1] = circle[0]
    fewer = simplify(circle, 0.16)
    assert len(fewer) < 80 and length([fewer]) == pytest.approx(100 * np.pi, rel=0.005)
    assert rms_and_covered([fewer], [circle])[0] < 0.16


@pytest.mark.parametrize("line", [polygon((1, 2), (1, 2)), polygon((1, 2), (5, 2))])
def test_short_lines_are_left_alone(line):
    assert (simplify(line, 1.0) == line).all()
