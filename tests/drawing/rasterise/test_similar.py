"""Likeness against its definition, on pictures whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.errors import DrawingError
from app.drawing.rasterise import affine_error, ink_cover, rasterise, similarity
from app.drawing.rasterise.similar import _ssim
from tests.support.paper import face, flat


def test_white_paper_is_exactly_a_white_picture():
    assert similarity(flat(0, 60), [], 0.5, 0.5) == pytest.approx(1.0)
    assert affine_error(flat(0, 60), [], 0.5, 0.5) == pytest.approx(0.0, abs=1e-9)


def test_white_paper_is_no_face():
    assert similarity(face(120), [], 1.0, 0.5) < 0.3


def test_the_own_strokes_are_liker_than_those_of_another_picture():
    grey = face(120)
    own, upside_down = rasterise(grey, "squiggle", 0.8), rasterise(grey[::-1].copy(), "squiggle", 0.8)
    assert similarity(grey, own, 0.8, 0.5) > similarity(grey, upside_down, 0.8, 0.5) + 0.2
    assert affine_error(grey, own, 0.8, 0.5) < 0.5 * affine_error(grey, upside_down, 0.8, 0.5)


def test_the_affine_error_forgives_brightness_and_contrast():
    ramp = np.tile(np.linspace(200, 0, 150).astype(np.uint8), (150, 1))
    light = rasterise((255 - (255.0 - ramp) / 2).astype(np.uint8), "squiggle", 0.5)
    missing = 0.8 * (1 - ramp / 255).mean() - ink_cover(light, ramp.shape, 1.0).mean()
    assert missing > 0.15
    assert affine_error(ramp, light, 0.5, 0.5) < missing / 2.5


def test_ink_that_says_nothing_leaves_all_of_the_picture_as_error():
    ramp = np.tile(np.linspace(240, 0, 150).astype(np.uint8), (150, 1))
    assert affine_error(ramp, [], 0.5, 0.5) == pytest.approx(0.8 * np.std(ramp / 255), rel=0.05)


def test_the_index_is_that_of_its_definition():
    rng = np.random.default_rng(3)
    a, b = rng.random((15, 18)), rng.random((15, 18))
    x, y = a[4:11, 5:12], b[4:11, 5:12]
    covariance = ((x - x.mean()) * (y - y.mean())).mean()
    wanted = (2 * x.mean() * y.mean() + 1e-4) * (2 * covariance + 9e-4)
    wanted /= (x.mean() ** 2 + y.mean() ** 2 + 1e-4) * (x.var() + y.var() + 9e-4)
    assert _ssim(a, b)[7, 8] == pytest.approx(wanted)
    assert _ssim(a, a) == pytest.approx(1.0)


@pytest.mark.parametrize(("mm_per_px", "pen_mm"), [(0.0, 0.5), (0.5, -1.0), (float("nan"), 0.5)])
def test_lengths_must_be_positive(mm_per_px, pen_mm):
    with pytest.raises(DrawingError, match="positive"):
        similarity(flat(0.5, 10), [], mm_per_px, pen_mm)
