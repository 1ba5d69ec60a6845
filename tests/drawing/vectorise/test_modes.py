"""Modes by name, the choice among them, filled shapes, and pictures with nothing to draw."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.drawing.errors import DrawingError
from app.drawing.vectorise import MODES, choose_mode, vectorise
from tests.drawing.vectorise.pictures import (
    MM_PER_PX,
    SHAPE,
    arc,
    cartoon,
    filled,
    inked,
    length,
    logo,
    photo,
    rms_and_covered,
    spiral,
)


def noisy(picture: np.ndarray, deviation: float) -> np.ndarray:
    noise = np.random.default_rng(3).normal(0.0, deviation, picture.shape)
    return np.clip(picture + noise, 0, 255).astype(np.uint8)


def clip_art() -> np.ndarray:
    """Flat discs of several greys."""
    picture = np.full(SHAPE, 230, np.uint8)
    for x, y, radius, tone in ((150, 150, 120, 90), (350, 180, 100, 160), (250, 360, 140, 40), (250, 360, 60, 200)):
        picture[filled([arc(x, y, radius)]) < 128] = tone
    return picture


@pytest.mark.parametrize(
    ("picture", "mode"),
    [
        (inked(cartoon()), "centreline"),
        (inked(spiral(), 2), "centreline"),
        (inked(cartoon(), 9), "centreline"),
        (255 - inked(cartoon()), "centreline"),
        ((inked(cartoon()) * np.linspace(0.45, 0.95, 512)).astype(np.uint8), "centreline"),
        (noisy(inked(cartoon()), 6), "centreline"),
        (filled(logo()), "outline"),
        (255 - filled(logo()), "outline"),
        (noisy(filled(logo()), 8), "outline"),
        (clip_art(), "outline"),
        (photo(0), "sketch"),
        (photo(1), "sketch"),
        (photo(0) // 4 + 100, "sketch"),
    ],
)
def test_the_choice_and_its_reason(picture, mode):
    found = vectorise(picture, "auto", MM_PER_PX)
    assert found.mode == mode == choose_mode(picture)[0] and found.strokes
    assert found.reason.startswith("The picture") and found.reason.endswith(".")


@pytest.mark.parametrize("noise", [0.0, 8.0])
def test_outlines_of_a_logo(noise):
    """The target is 0.25 pixels."""
    found = vectorise(noisy(filled(logo()), noise), "outline", MM_PER_PX)
    rms, covered = rms_and_covered(found.strokes, logo())
    assert len(found.strokes) == 3 and all((stroke[0] == stroke[-1]).all() for stroke in found.strokes)
    assert rms < 0.15 and covered > 0.99
    assert length(found.strokes) == pytest.approx(length(logo()), rel=0.02)


def test_outlines_between_many_tones():
    """Of the four discs, two lie partly under the others."""
    found = vectorise(clip_art(), "outline", MM_PER_PX)
    discs = [arc(150, 150, 120), arc(350, 180, 100), arc(250, 360, 140), arc(250, 360, 60)]
    assert rms_and_covered(found.strokes, discs)[0] < 0.35
    assert rms_and_covered(found.strokes, discs[3:])[1] > 0.99
    assert 0.75 < length(found.strokes) / length(discs) < 1.0


EMPTY = {
    "white": np.full((60, 80), 255, np.uint8),
    "black": np.zeros((60, 80), np.uint8),
    "grey": np.full((60, 80), 127, np.uint8),
    "one pixel": np.array([[9]], np.uint8),
    "a row": np.full((1, 200), 255, np.uint8),
    "a column": np.full((200, 1), 0, np.uint8),
    "two pixels": np.array([[0, 255]], np.uint8),
}


@pytest.mark.parametrize("mode", ["auto", *MODES])
@pytest.mark.parametrize("name", EMPTY)
def test_nothing_to_draw(mode, name):
    found = vectorise(EMPTY[name], mode, MM_PER_PX)
    assert found.strokes == [] and found.edge_mask.shape == EMPTY[name].shape
    assert not found.edge_mask.any() or len(EMPTY[name].ravel()) <= 2


@settings(max_examples=60)
@given(
    st.sampled_from(["auto", *MODES]),
    st.integers(1, 40),
    st.integers(1, 40),
    st.integers(0, 1000),
    st.sampled_from([2, 5, 256]),
)
def test_any_picture_is_drawn_inside_itself(mode, height, width, seed, tones):
    random = np.random.default_rng(seed)
    picture = (random.integers(0, tones, (height, width)) * (255 // (tones - 1))).astype(np.uint8)
    found = vectorise(picture, mode, 0.3, shortest_mm=0.0)
    assert found.mode in MODES and found.edge_mask.shape == picture.shape
    for stroke in found.strokes:
        assert stroke.dtype == np.float64 and stroke.ndim == 2 and stroke.shape[1] == 2 and len(stroke) >= 2
        assert np.isfinite(stroke).all()
        assert stroke.min() >= -1.5 and (stroke.max(axis=0) <= [width + 0.5, height + 0.5]).all()


@pytest.mark.parametrize("mode", MODES)
def test_the_same_picture_gives_the_same_strokes(mode):
    first, second = (vectorise(photo(), mode, MM_PER_PX).strokes for _ in range(2))
    assert len(first) == len(second) and all((a == b).all() for a, b in zip(first, second, strict=True))


@pytest.mark.parametrize(
    ("mode", "mm_per_px", "wrong", "complaint"),
    [
        ("scribble", 0.3, {}, "no mode called scribble; choose auto, sketch"),
        ("canny", 0.0, {}, "cannot be 0 mm"),
        ("canny", float("nan"), {}, "cannot be nan mm"),
        ("canny", 0.3, {"apperture": 3}, "no setting called apperture"),
        ("canny", 0.3, {"aperture": 4}, "choose 3, 5 or 7"),
        ("canny", 0.3, {"low": 90.0, "high": 30.0}, "at most the high one"),
        ("outline", 0.3, {"low": -1.0}, "at least 0"),
        ("sketch", 0.3, {"strong": 0.2, "weak": 0.1}, "must rise"),
        ("sketch", 0.3, {"shortest_mm": -1.0}, "shortest_mm cannot be -1"),
        ("centreline", 0.3, {"join_mm": float("nan")}, "join_mm cannot be nan"),
        ("centreline", 0.3, {"tolerance_mm": float("inf")}, "tolerance_mm cannot be inf"),
    ],
)
def test_settings_that_cannot_be(mode, mm_per_px, wrong, complaint):
    with pytest.raises(DrawingError, match=complaint) as refusal:
        vectorise(photo(), mode, mm_per_px, **wrong)
    assert str(refusal.value).endswith(".")
