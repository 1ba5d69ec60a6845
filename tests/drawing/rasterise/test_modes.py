"""What holds for every way to rasterise."""

from __future__ import annotations

import inspect

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.drawing.errors import DrawingError
from app.drawing.rasterise import RASTER_MODES, rasterise
from tests.drawing.rasterise.walk import walked
from tests.support.paper import face, flat

MODES = list(RASTER_MODES)
ONE_STROKE = ("spiral", "one_line")
LIFTING = [mode for mode in MODES if mode not in ONE_STROKE]
PEN_PX = 2.0
MM_PER_PX = 0.25


def draw(grey, mode, **parameters):
    return rasterise(grey, mode, MM_PER_PX, pen_mm=PEN_PX * MM_PER_PX, **parameters)


def assert_sound(strokes, grey):
    """Strokes as agreed: finite, at least two points, on the picture."""
    height, width = grey.shape
    for stroke in strokes:
        assert stroke.dtype == np.float64 and stroke.ndim == 2 and stroke.shape[1] == 2 and len(stroke) >= 2
        assert np.isfinite(stroke).all()
        assert (stroke >= -0.5 - 1e-6).all() and (stroke <= (width - 0.5 + 1e-6, height - 0.5 + 1e-6)).all()


@pytest.mark.parametrize("mode", MODES)
def test_white_and_nearly_white_pictures_have_no_strokes(mode):
    assert draw(flat(0.0, 60), mode) == []
    assert draw(flat(0.045, 60), mode) == []


@pytest.mark.parametrize("mode", LIFTING)
@given(st.integers(0, 255), st.integers(0, 255), st.floats(0, 6.3))
@settings(max_examples=12, deadline=None)
def test_the_pen_is_not_down_over_white(mode, first, last, angle):
    y, x = np.mgrid[:48, :60]
    along = (x * np.cos(angle) + y * np.sin(angle)) / 80
    grey = np.clip(first + (last - first) * (along + 0.5), 0, 255).astype(np.uint8)
    grey[6:26, 20:50] = 255
    strokes = draw(grey, mode)
    assert_sound(strokes, grey)
    inked = grey < 255 * 0.95
    if not inked.any():
        assert strokes == []
        return
    rows, columns = np.nonzero(inked)
    for x, y in np.concatenate([*map(walked, strokes), np.zeros((0, 2))]):
        # to the nearest pixel that is not white; corners of white are as round as the pen
        away = np.maximum(np.abs(columns - x), np.abs(rows - y)).min()
        assert away <= 0.5 + PEN_PX / 2


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("shape", [(1, 1), (1, 2), (2, 1), (3, 3), (1, 200), (200, 1), (7, 5)])
def test_tiny_pictures(mode, shape):
    for value in (0, 128, 255):
        grey = np.full(shape, value, np.uint8)
        for pen_px in (0.1, 1.0, 30.0):
            strokes = rasterise(grey, mode, 1.0, pen_mm=pen_px)
            assert_sound(strokes, grey)
            assert value < 255 or strokes == []


@pytest.mark.parametrize("mode", MODES)
def test_the_same_picture_gives_the_same_strokes(mode):
    grey = face(90)
    first, again = draw(grey, mode), draw(grey.copy(), mode)
    assert len(first) == len(again) > 0
    assert all((one == two).all() for one, two in zip(first, again, strict=True))


@pytest.mark.parametrize("mode", ONE_STROKE)
@given(seed=st.integers(0, 1000))
@settings(max_examples=10, deadline=None)
def test_without_a_lift_there_is_exactly_one_stroke(mode, seed):
    rng = np.random.default_rng(seed)
    blotches = np.kron(rng.integers(0, 256, (5, 6)), np.ones((12, 12))).astype(np.uint8)
    strokes = draw(blotches, mode)
    assert len(strokes) == 1
    assert_sound(strokes, blotches)


@pytest.mark.parametrize("mode", MODES)
def test_the_ends_of_every_slider_can_be_drawn(mode):
    grey = face(60)
    grey[30:, :20] = 0
    for parameter in RASTER_MODES[mode].parameters:
        for value in (parameter.low, parameter.high):
            strokes = draw(grey, mode, **{parameter.name: value})
            assert_sound(strokes, grey)
            assert strokes


@pytest.mark.parametrize("mode", MODES)
def test_the_sliders_fit_the_function_that_they_set(mode):
    signature = inspect.signature(RASTER_MODES[mode].draw)
    settings = {name: given.default for name, given in list(signature.parameters.items())[2:]}
    assert RASTER_MODES[mode].defaults == settings
    for parameter in RASTER_MODES[mode].parameters:
        assert parameter.low <= parameter.default <= parameter.high
        assert 0 < parameter.step <= parameter.high - parameter.low
        assert parameter.label[0].isupper()
    assert RASTER_MODES[mode].title and RASTER_MODES[mode].explanation.endswith(".")


GREY = flat(0.5, 20)


@pytest.mark.parametrize(
    ("arguments", "settings", "complaint"),
    [
        ((GREY, "scribble", 0.5), {}, "no way to rasterise called 'scribble'; choose one of squiggle"),
        ((GREY.astype(float), "squiggle", 0.5), {}, "8 bits of grey"),
        ((np.zeros((5, 5, 3), np.uint8), "squiggle", 0.5), {}, "8 bits of grey"),
        ((np.zeros((0, 5), np.uint8), "squiggle", 0.5), {}, "at least one pixel"),
        ((np.zeros((3000, 3000), np.uint8), "squiggle", 0.01), {}, "more than 4 megapixels"),
        ((GREY, "squiggle", 0.0), {}, "must be positive"),
        ((GREY, "squiggle", 0.5), {"pen_mm": float("nan")}, "must be positive"),
        ((GREY, "squiggle", 0.001), {}, "more than 100 pixels wide"),
        ((GREY, "squiggle", 100.0), {"pen_mm": 0.1}, "too fine for a drawing this large"),
        ((GREY, "squiggle", 0.5), {"pitch": 0.1}, "Distance of rows must lie between 2 and 10, not at 0.1"),
        ((GREY, "squiggle", 0.5), {"pitch": float("nan")}, "must lie between"),
        ((GREY, "hatch", 0.5), {"wave": 3.0}, "Hatching has no setting 'wave'; its settings are pitch, angle"),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_one_sentence(arguments, settings, complaint):
    with pytest.raises(DrawingError, match=complaint) as refusal:
        rasterise(*arguments, **settings)
    assert str(refusal.value).endswith(".") and "\n" not in str(refusal.value)
