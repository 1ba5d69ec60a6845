"""The preview picture and DXF, decoded; and the table of all exports."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.exports import EXPORTS, write_dxf, write_preview_png
from app.drawing.svg_import import read_svg
from tests.support.sheet_strokes import Stroke, assert_same, drawings, sheets

SHEET = (100.0, 60.0)
THREE = [np.array([(-40.0, y), (40.0, y)]) for y in (20.0, 0.0, -20.0)]
WHITE = np.array([255, 255, 255])


def picture_of(strokes: list[Stroke], px_per_mm: float = 4.0) -> NDArray[np.uint8]:
    data = write_preview_png(strokes, SHEET, px_per_mm)
    assert data.startswith(b"\x89PNG")
    return np.asarray(cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR), np.uint8)


def pixel(picture: NDArray[np.uint8], x: float, y: float, px_per_mm: float = 4.0) -> NDArray[np.int64]:
    """At a place on the sheet, mm from its middle."""
    place = np.floor(np.array([SHEET[1] / 2 - y, SHEET[0] / 2 + x]) * px_per_mm).astype(int)
    return picture[tuple(place)].astype(int)


def test_strokes_are_where_they_belong_and_coloured_by_order():
    picture = picture_of(THREE)
    assert picture.shape == (240, 400, 3)
    blue, _, red = zip(*(pixel(picture, 0.0, y) for y in (20.0, 0.0, -20.0)), strict=True)
    assert blue[0] > red[0] and blue[2] < red[2] and red[0] < red[1] < red[2]
    assert all((pixel(picture, *place) == WHITE).all() for place in [(20.0, 10.0), (45.0, 20.0), (0.0, 25.0)])
    ink = np.argwhere((picture < 128).any(axis=2))
    assert np.abs(ink.mean(axis=0) - (119.5, 199.5)).max() < 0.26  # the middle of the sheet is that of the picture
    assert ink[:, 1].min() == pytest.approx(40, abs=2) and ink[:, 1].max() == pytest.approx(360, abs=2)


def test_lifted_moves_are_thin_and_grey():
    picture = picture_of([THREE[0], THREE[0] + (0.0, -30.0)])
    x, y = 0.0, 5.0  # halfway from the first line's right end to the second line's left one
    around = picture[round(4 * (30 - y)) - 3 : round(4 * (30 - y)) + 3, 200].astype(int)
    assert 190 <= around.min() < 250 and np.ptp(around, axis=1).max() < 10
    assert (pixel(picture, x + 10.0, y) == WHITE).all()


@pytest.mark.parametrize("px_per_mm", [4.0, 5.0, 20.0])
def test_a_dot_is_as_wide_as_a_line(px_per_mm):
    dot, line = (
        (picture_of([np.array(stroke)], px_per_mm) < 128).any(axis=2)
        for stroke in ([(10.3, 5.2), (10.3, 5.2)], [(-40.0, 5.2), (40.0, 5.2)])
    )
    wide = line.sum(axis=0).max()
    assert wide == pytest.approx(0.5 * px_per_mm, abs=2.1)  # OpenCV: 1 to 2 pixels more
    assert np.ptp(np.argwhere(dot), axis=0) + 1 == pytest.approx(wide, abs=1)
    np.testing.assert_allclose(np.argwhere(dot).mean(axis=0), np.array([24.8, 60.3]) * px_per_mm - 0.5, atol=0.6)


def test_an_empty_sheet_and_strokes_beyond_it():
    assert (picture_of([]) == 255).all()
    assert (picture_of([np.array([(500.0, 500.0), (9e4, -9e4)])]) == 255).all()


@pytest.mark.parametrize("px_per_mm", [0.0, -1.0, np.nan, 1e6])
def test_previews_without_or_with_too_many_pixels_are_refused(px_per_mm):
    with pytest.raises(DrawingError, match="none or too many"):
        picture_of(THREE, px_per_mm)


def read_dxf(text: str) -> list[Stroke]:
    """R12 polylines: pairs of lines, a group code and its value."""
    lines = text.splitlines()
    assert len(lines) % 2 == 0
    pairs = list(zip(map(int, lines[::2]), lines[1::2], strict=True))
    assert pairs[:2] == [(0, "SECTION"), (2, "ENTITIES")] and pairs[-2:] == [(0, "ENDSEC"), (0, "EOF")]
    strokes, points, closed, entity = [], [], False, ""
    for code, value in pairs[2:-2]:
        if code == 0:
            entity = value
            if value == "POLYLINE":
                points, closed = [], False
            elif value == "VERTEX":
                points.append([0.0, 0.0])
            elif value == "SEQEND":
                strokes.append(np.array(points + points[:1] * closed))
        elif code == 70 and entity == "POLYLINE":
            closed = value == "1"
        elif code in (10, 20) and entity == "VERTEX":
            points[-1][code // 10 - 1] = float(value)
    return strokes


@given(drawings, sheets)
def test_dxf_is_read_back_from_the_lower_left_corner(drawing, sheet):
    found = [stroke - np.array(sheet) / 2 for stroke in read_dxf(write_dxf(drawing, sheet))]
    assert_same(found, drawing, 0.51e-4)


def test_dxf_marks_closed_strokes_and_repeats_no_point():
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)])
    for stroke, flag, corners in [(square, "1", 4), (square[:-1], "0", 4), (square[[0, 0]], "0", 2)]:
        lines = write_dxf([stroke], SHEET).splitlines()
        assert lines[lines.index("70") + 1] == flag and lines.count("VERTEX") == corners


def test_every_export_writes_something_of_its_kind():
    begins = {".svg": b"<?xml", ".gcode": b"; Delta Lab", ".csv": b"stroke_id", ".txt": b"# Ptos", ".dxf": b"0\n"}
    begins |= {".png": b"\x89PNG"}
    assert set(EXPORTS) == set(begins)
    for suffix, export in EXPORTS.items():
        assert export.title and export.write(THREE, SHEET).startswith(begins[suffix])
    assert_same(read_svg(EXPORTS[".svg"].write(THREE, SHEET)), THREE, 1e-4)
