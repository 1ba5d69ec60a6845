"""Lines and light tones in one drawing."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.errors import DrawingError
from app.drawing.rasterise import portrait, rasterise
from tests.support.paper import face, flat, ink

LINES = [np.array([[10.0, 10.0], [50.0, 30.0], [70.0, 30.0]]), np.array([[5.0, 60.0], [5.0, 60.0]])]


def test_the_lines_come_first_and_unchanged():
    drawing = portrait(LINES, face(100), 0.25)
    assert len(drawing) > len(LINES)
    assert all((drawn == line).all() for drawn, line in zip(drawing, LINES, strict=False))


@pytest.mark.parametrize("mode", ["hatch", "streamlines", "squiggle"])
@pytest.mark.parametrize("weight", [0.5, 1.0])
def test_tones_have_the_share_of_ink_that_their_weight_says(mode, weight):
    grey = flat(0.8, 160)
    tones = portrait([], grey, 0.25, weight=weight, mode=mode)
    cover = ink(tones, grey.shape, 2.0, fine=3)[40:-40, 40:-40].mean()
    assert cover == pytest.approx(weight * 0.8 * 0.8, abs=0.05)


def test_without_weight_there_are_only_the_lines():
    assert len(portrait(LINES, face(100), 0.25, weight=0.0)) == len(LINES)


def test_full_weight_is_the_mode_itself_with_its_settings():
    both = portrait([], face(80), 0.25, pen_mm=0.4, weight=1.0, mode="hatch", pitch=2.0)
    alone = rasterise(face(80), "hatch", 0.25, pen_mm=0.4, pitch=2.0)
    assert all((one == other).all() for one, other in zip(both, alone, strict=True))


def test_refusals():
    with pytest.raises(DrawingError, match="weight of the tones must lie between"):
        portrait(LINES, face(20), 0.25, weight=1.5)
    with pytest.raises(DrawingError, match="8 bits of grey"):
        portrait(LINES, np.zeros((4, 4, 3), np.uint8), 0.25)
