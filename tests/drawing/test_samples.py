"""The sample pictures: all there, small, credited, shipped, and drawn well by the mode that they hint at."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from app.drawing import samples
from app.drawing.errors import DrawingError
from app.drawing.load import load_image
from app.drawing.modes import DRAWING_MODES
from app.drawing.samples import SAMPLES, sample_bytes
from app.drawing.svg_import import read_svg
from app.drawing.vectorise import vectorise
from app.drawing.vectorise.auto import choose_mode

FOLDER = Path(samples.__file__).parent
LONGEST_PX, MOST_BYTES = 700, 100_000
FREE = ("CC0", "public domain")
PICTURES = sorted(name for name, sample in SAMPLES.items() if not sample.file.endswith(".svg"))
PHOTOS = {"cat", "astronaut", "coffee", "camera"}


def test_the_folder_holds_what_is_listed_and_nothing_else():
    files = {path.name for path in FOLDER.iterdir() if path.suffix not in (".py", ".md") and path.is_file()}
    assert files == {sample.file for sample in SAMPLES.values()}


@pytest.mark.parametrize("name", SAMPLES)
def test_a_sample_is_small_and_free_and_hints_at_a_mode(name):
    sample = SAMPLES[name]
    assert len(sample_bytes(name)) < MOST_BYTES
    assert any(licence in sample.credit for licence in FREE)
    assert sample.mode_hint in DRAWING_MODES
    assert f"| {sample.file} |" in (FOLDER / "README.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_is_a_picture_of_reasonable_size(name):
    decoded = cv2.imdecode(np.frombuffer(sample_bytes(name), np.uint8), cv2.IMREAD_GRAYSCALE)
    assert decoded is not None
    assert 300 <= max(decoded.shape) <= LONGEST_PX
    assert np.ptp(decoded) > 150


@pytest.mark.parametrize("name", sorted(set(PICTURES) - PHOTOS))
def test_auto_chooses_for_a_drawing_what_the_sample_hints_at(name):
    assert choose_mode(load_image(sample_bytes(name)).grey)[0] == SAMPLES[name].mode_hint


@pytest.mark.parametrize("name", sorted(PHOTOS))
def test_auto_sees_that_a_photo_is_a_photo(name):
    assert choose_mode(load_image(sample_bytes(name)).grey)[0] == "sketch"


def test_the_logo_has_four_outlines():
    """Outer and inner edge of the gear, and of the triangle."""
    strokes = vectorise(load_image(sample_bytes("logo")).grey, "outline", 0.25).strokes
    assert len(strokes) == 4
    assert all(np.allclose(stroke[0], stroke[-1]) for stroke in strokes)


def test_the_mandala_is_the_same_upside_down():
    """It has eight axes of symmetry, and one of them is level."""
    grey = load_image(sample_bytes("mandala")).grey
    blurred = cv2.GaussianBlur(grey, (0, 0), 3.0).astype(float)
    assert np.abs(blurred - cv2.GaussianBlur(grey[::-1], (0, 0), 3.0)).mean() < 5.0


def test_the_bicycle_stands_on_two_round_wheels():
    strokes = read_svg(sample_bytes("bicycle"))
    tyres = [stroke for stroke in strokes if np.allclose(np.ptp(stroke, axis=0), 50.0, atol=0.1)]
    assert len(tyres) == 2
    for tyre in tyres:
        middle = (tyre.min(axis=0) + tyre.max(axis=0)) / 2
        np.testing.assert_allclose(np.linalg.norm(tyre - middle, axis=1), 25.0, atol=0.05)


def test_an_unknown_sample_is_refused():
    with pytest.raises(DrawingError, match="no sample called dog; choose one of robot"):
        sample_bytes("dog")
