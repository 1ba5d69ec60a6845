"""What is drawn is told by the content of a file, not by its name."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from app.drawing.errors import DrawingError
from app.drawing.exports import write_points_file, write_svg
from app.drawing.source import LONGEST_TITLE, read_source, strokes_source, text_source
from tests.drawing.test_load import GIF_200_THEN_BLACK, QUARTERS, encoded

STROKES = [np.array([[0.0, 0.0], [10.0, 5.0]]), np.array([[-3.0, 2.0], [-3.0, 2.0]])]
SHEET = (40.0, 30.0)
SVG = write_svg(STROKES, SHEET).encode()
POINTS = write_points_file(STROKES, SHEET).encode()


def assert_strokes(found, wanted, atol=1e-9):
    assert found is not None and len(found) == len(wanted)
    for one, other in zip(found, wanted, strict=True):
        np.testing.assert_allclose(one, other, atol=atol)


@pytest.mark.parametrize("name", ["photo.svg", "photo.png", "Ptos_Dibujo.txt", ""])
def test_a_picture_whatever_its_name(name):
    source = read_source(name, encoded(QUARTERS))
    assert source.strokes is None and source.grey is not None and (source.grey == QUARTERS).all()
    assert source.title == (name or "picture")


@pytest.mark.parametrize(
    "data", [SVG, b"\xef\xbb\xbf" + SVG, b"\n  " + SVG.partition(b"?>")[2], SVG.partition(b"?>")[2]]
)
def test_an_svg_even_one_called_png(data):
    source = read_source("drawing.png", data)
    assert source.grey is None
    assert_strokes(source.strokes, STROKES, atol=2e-3)


def test_an_svg_in_16_bits():
    text = SVG.decode().replace("utf-8", "utf-16").replace("UTF-8", "UTF-16")
    assert_strokes(read_source("a.svg", text.encode("utf-16")).strokes, STROKES, atol=2e-3)


@pytest.mark.parametrize("data", [POINTS, b"\xef\xbb\xbf" + POINTS, POINTS.replace(b"\n", b"\r\n")])
def test_a_file_of_points(data):
    assert_strokes(read_source("C:\\drawings\\Ptos_Dibujo.txt", data).strokes, STROKES)
    assert read_source("C:\\drawings\\Ptos_Dibujo.txt", data).title == "Ptos_Dibujo.txt"


@pytest.mark.parametrize(
    ("data", "complaint"),
    [
        (b"", "empty"),
        (b"<html><body>Not found</body></html>", "'html' and not an SVG"),
        (b"<svg", "no readable SVG"),
        (SVG[:-20], "no readable SVG"),
        (b"# Ptos_Dibujo 1\n# sheet_mm 10 x\n", "Line 2"),
        (b"# Ptos_Dibujo 1\n# sheet_mm 10 10\n\xff\xfe 1 2\n", "UTF-8"),
        (b"x y z\n1 2 3\n", "text"),
        (b"\x89PNG\r\n\x1a\n", "damaged"),
    ],
)
def test_refusals_are_one_sentence(data, complaint):
    with pytest.raises(DrawingError, match=complaint) as refusal:
        read_source("file", data)
    assert str(refusal.value).endswith(".") and "\n" not in str(refusal.value)


def test_notes_of_the_picture_are_kept():
    assert read_source("a.gif", GIF_200_THEN_BLACK).notes == ("The GIF is animated: its first frame is drawn.",)


def test_text_is_strokes_and_says_what_it_lacks():
    source = text_source("Hello\nworld")
    assert source.title == "Hello world" and source.grey is None and source.strokes and source.notes == ()
    points = np.concatenate(source.strokes)
    np.testing.assert_allclose(points.min(axis=0) + points.max(axis=0), 0.0, atol=1e-9)
    lacking = text_source("a漢b")
    assert "漢" in lacking.notes[0] and lacking.notes[0].endswith(".")
    assert len(text_source("long " * 100).title) == LONGEST_TITLE
    with pytest.raises(DrawingError, match="no letter"):
        text_source("  \n ")


def test_strokes_of_a_hand():
    source = strokes_source("by hand", [[[0, 0], [1, 2]]])
    assert source.title == "by hand"
    assert_strokes(source.strokes, [np.array([[0.0, 0.0], [1.0, 2.0]])])
    for bad in ([], [[[0, 0]]], [[[0, 0], [np.nan, 1]]], [[0, 1, 2]]):
        with pytest.raises(DrawingError, match=r"\.$"):
            strokes_source("by hand", bad)


def test_sources_go_to_another_process():
    for source in (read_source("a.png", encoded(QUARTERS)), text_source("a")):
        again = pickle.loads(pickle.dumps(source))
        assert again.title == source.title
        assert_strokes(again.strokes or [], source.strokes or [])
