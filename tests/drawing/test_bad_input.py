"""Whatever is offered as a picture gives a sensible drawing, or one sentence that says what is wrong."""

from __future__ import annotations

import re
import zlib

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.drawing import DrawingError, draw_image, load
from app.drawing.exports import write_svg
from app.drawing.pipeline import MODES, Drawing
from tests.drawing.test_load import GIF_200_THEN_BLACK, RED_CMYK_JPEG, encoded, png_chunk, png_header, with_exif
from tests.drawing.test_svg_import import svg
from tests.drawing.vectorise.pictures import length, photo

SHEET, SMALL_SHEET = (100.0, 100.0), (30.0, 30.0)
BAR = np.full((180, 300), 255, np.uint8)
"""A sheet with a line across its upper half, longer to the left."""
cv2.line(BAR, (30, 45), (210, 45), (0,), 5)

END = png_chunk(b"IEND", b"")
DEEP = (BAR.astype(np.uint16) * 16, BAR.astype(np.uint16) * 257)
CLEAR = np.dstack([np.zeros((180, 300, 3), np.uint8), 255 - BAR])
ALPHA_ROWS = np.dstack([np.zeros_like(BAR), 255 - BAR]).reshape(180, 600)
ALPHA_DATA = zlib.compress(b"".join(b"\0" + row.tobytes() for row in ALPHA_ROWS))
GREY_ALPHA = png_header(300, 180, 8, 4) + png_chunk(b"IDAT", ALPHA_DATA) + END


def drawn(data: bytes, mode: str = "auto", sheet: tuple[float, float] = SHEET) -> Drawing:
    return draw_image(data, mode, sheet)


def refusal(data: bytes, mode: str = "auto", sheet: tuple[float, float] = SHEET) -> str:
    """The one sentence."""
    with pytest.raises(DrawingError) as found:
        drawn(data, mode, sheet)
    sentence = str(found.value)
    assert sentence.endswith(".") and "\n" not in sentence and 20 < len(sentence) < 300
    assert not re.search(r"[.!?]\s+[A-Z]", sentence), f"more than one sentence: {sentence}"
    return sentence


def drawn_or_refused(data: bytes, mode: str = "auto", sheet: tuple[float, float] = SHEET) -> Drawing | None:
    try:
        return drawn(data, mode, sheet)
    except DrawingError:
        refusal(data, mode, sheet)
        return None


def assert_bar(drawing: Drawing) -> None:
    """What is drawn of BAR: one line, up and to the left."""
    assert len(drawing.strokes) == 1
    (stroke,) = drawing.strokes
    x, y = (stroke.min(axis=0) + stroke.max(axis=0)) / 2
    assert x == pytest.approx((120 - 149.5) / 3, abs=0.7) and y == pytest.approx((89.5 - 45) / 3, abs=0.5)
    assert length([stroke]) == pytest.approx(60.0, abs=3.0)


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "empty"),
        (b"# a list\nof things\n" * 30, "text"),
        ("Dibujo de un árbol".encode(), "cannot be read"),
        (encoded(photo(), ".jpg")[:9000], "damaged"),
        (encoded(BAR)[:-30], "damaged"),
        (b"%PDF-1.7\n%\xe2\xe3", "PDF"),
        (b"PK\x03\x04\x14\0 a zip file, say a document", "cannot be read"),
        (bytes(5000), "cannot be read"),
        (b"<html><body>404</body></html>", "not an SVG"),
        (png_header(30_000, 30_000) + png_chunk(b"IDAT", b"x") + END, "100 million"),
        (png_header(0, 0), "damaged"),
        (svg("<script>alert(1)</script><path d='M0 0L9 9'/>"), "script"),
        (svg("<path d='M0 0L9 9' onclick='alert(1)'/>"), "script"),
        (svg("<image href='http://example.com/a.png'/><path d='M0 0L9 9'/>"), "another file"),
        (svg("<style>@import url(http://example.com/a.css);</style><path d='M0 0L9 9'/>"), "another file"),
        (svg("<text>only text</text>"), "no lines"),
        (b"<!DOCTYPE svg [<!ENTITY a 'aaaa'>]><svg xmlns='http://www.w3.org/2000/svg'>&a;</svg>", "entities"),
        (svg("<path d='M0 0L9 9'/>")[:-10], "no readable SVG"),
        (b"# Ptos_Dibujo 1\n# sheet_mm 160 120\n1 2 zero\n", "Line 3"),
    ],
)
def test_what_is_no_picture_is_refused_in_one_sentence(data, says):
    assert says in refusal(data)


def test_a_bomb_is_never_decoded(monkeypatch):
    """Some kilobytes that would be gigabytes."""
    lines = zlib.compressobj(9)
    body = b"".join(lines.compress(bytes(3751)) for _ in range(30_000)) + lines.flush()
    bomb = png_header(30_000, 30_000) + png_chunk(b"IDAT", body) + END
    assert len(bomb) < 150_000
    monkeypatch.setattr(load.cv2, "imdecode", lambda *_: pytest.fail("it was decoded"))
    assert "100 million" in refusal(bomb)


@pytest.mark.parametrize("kind", [".jpg", ".png"])
def test_fifty_megapixels_are_drawn(kind):
    picture = cv2.resize(BAR, (9150, 5490), interpolation=cv2.INTER_NEAREST)
    assert picture.size > 50e6
    assert_bar(drawn(encoded(picture, kind)))


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("value", [255, 128, 0])
def test_an_even_picture_has_nothing_to_draw_or_is_evenly_inked(mode, value):
    """White, and for lines any even tone, is refused; tones cover the whole sheet."""
    data = encoded(np.full((60, 60), value, np.uint8))
    if mode in ("auto", "sketch", "canny", "centreline", "outline", "paper") or value == 255:
        assert "nothing to draw" in refusal(data, mode)
        return
    points = np.concatenate(drawn(data, mode, SMALL_SHEET).strokes)
    assert np.ptp(points, axis=0).min() > 26.0 and np.abs(points).max() <= 15.5


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("shape", [(1, 1), (1, 300), (300, 1)])
def test_the_smallest_pictures(mode, shape):
    for value in (0, 255):
        drawing = drawn_or_refused(encoded(np.full(shape, value, np.uint8)), mode, SMALL_SHEET)
        assert drawing is None or (value == 0 and np.isfinite(np.concatenate(drawing.strokes)).all())


@pytest.mark.parametrize(
    ("data", "note"),
    [
        pytest.param(encoded(BAR), "", id="grey"),
        pytest.param(encoded(cv2.cvtColor(BAR, cv2.COLOR_GRAY2BGR), ".jpg"), "", id="colour"),
        pytest.param(encoded(DEEP[0]), "8 bits", id="12 bits"),
        pytest.param(encoded(DEEP[1]), "8 bits", id="16 bits"),
        pytest.param(encoded(CLEAR), "ransparent", id="black on transparent"),
        pytest.param(GREY_ALPHA, "ransparent", id="grey with alpha"),
        pytest.param(with_exif(np.ascontiguousarray(np.rot90(BAR)), ".jpg", 6), "upright", id="lying on its side"),
        pytest.param(with_exif(np.ascontiguousarray(np.rot90(BAR, 2)), ".png", 3), "upright", id="upside down"),
        pytest.param(encoded(BAR, ".bmp"), "", id="bmp"),
        pytest.param(encoded(BAR, ".webp"), "", id="webp"),
        pytest.param(encoded(BAR, ".tif"), "", id="tiff"),
    ],
)
def test_the_same_bar_from_every_kind_of_file(data, note):
    drawing = drawn(data)
    assert_bar(drawing)
    assert note in " ".join(drawing.notes) and bool(note) == bool(drawing.notes)


def test_cmyk_has_its_colours():
    """Red is dark enough to be hatched, and not as dark as black."""
    red, black = (drawn(data, "hatch").ink_mm for data in (RED_CMYK_JPEG, encoded(np.zeros((8, 8), np.uint8))))
    assert 0.6 * black < red < 0.95 * black


def test_of_an_animation_the_first_frame_is_drawn():
    """A light grey, then black."""
    drawing, black = (drawn(data, "hatch") for data in (GIF_200_THEN_BLACK, encoded(np.zeros((2, 4), np.uint8))))
    assert drawing.ink_mm < 0.5 * black.ink_mm and "first frame" in drawing.notes[0]


@settings(max_examples=40, deadline=None)
@given(st.sampled_from([".png", ".jpg", ".bmp", ".tif", ".webp", ".svg"]), st.integers(0, 5000), st.integers(0, 255))
def test_any_damage_is_drawn_or_refused(kind, at, byte):
    svg_file = write_svg([np.array([[0.0, 0.0], [9.0, 9.0]])], SHEET).encode()
    data = bytearray(svg_file if kind == ".svg" else encoded(BAR, kind))
    data[at % len(data)] = byte
    drawn_or_refused(bytes(data))
