"""How much of the paper the ink covers, against what the picture wants; the ink is sampled the slow way."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.rasterise import RASTER_MODES, rasterise
from tests.support.paper import flat, ink

GREYS = ["squiggle", "hatch", "streamlines", "spiral", "one_line"]
PEN_PX = 2.0


def draw(grey, mode):
    return rasterise(grey, mode, 0.25, pen_mm=PEN_PX * 0.25)


@pytest.mark.parametrize("mode", list(RASTER_MODES))
def test_black_is_covered(mode):
    grey = flat(1.0, 120)
    inner = ink(draw(grey, mode), grey.shape, PEN_PX, fine=3)[30:-30, 30:-30]
    assert inner.mean() > 0.7


@pytest.mark.parametrize("darkness", [0.4, 0.75])
@pytest.mark.parametrize("mode", [*GREYS, "stipple"])
def test_a_flat_grey_gets_its_cover(mode, darkness):
    grey = flat(darkness, 140)
    cover = ink(draw(grey, mode), grey.shape, PEN_PX, fine=3)[30:-30, 30:-30].mean()
    assert cover == pytest.approx(0.8 * (1 - grey[0, 0] / 255), abs=0.05)


def test_streamlines_have_no_tones_that_jump():
    darkness = np.linspace(0.44, 0.84, 6)
    greys = [flat(each, 140) for each in darkness]
    covers = [ink(draw(grey, "streamlines"), grey.shape, PEN_PX, fine=3)[30:-30, 30:-30].mean() for grey in greys]
    np.testing.assert_allclose(covers, 0.8 * darkness, atol=0.03)


@pytest.mark.parametrize("pen_mm", [0.2, 0.5, 1.0])
@pytest.mark.parametrize("mode", ["squiggle", "hatch", "streamlines"])
def test_the_cover_does_not_depend_on_the_pen(mode, pen_mm):
    pen = pen_mm / 0.2
    grey, border = flat(0.5, round(60 * pen)), round(10 * pen)
    strokes = rasterise(grey, mode, 0.2, pen_mm=pen_mm)
    cover = ink(strokes, grey.shape, pen, fine=max(1, round(6 / pen)))
    assert cover[border:-border, border:-border].mean() == pytest.approx(0.4, abs=0.05)


@pytest.mark.parametrize("mode", GREYS)
def test_darker_is_darker_along_a_ramp(mode):
    grey = np.tile(np.linspace(230, 0, 240).round().astype(np.uint8), (160, 1))
    cover = ink(draw(grey, mode), grey.shape, PEN_PX, fine=2)[40:-40]
    bands = [band.mean() for band in np.array_split(cover[:, 48:-48], 6, axis=1)]
    assert np.diff(bands).min() > 0.0
    assert bands[-1] - bands[0] > 0.3
