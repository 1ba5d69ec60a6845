"""The preview picture and DXF, decoded; and the table of all exports."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.exports import EXPORTS, GCODE_VARIANTS, write_dxf, write_preview_png
from app.drawing.svg_import import read_svg
from tests.support.sheet_strokes import Stroke, assert_same, drawings, sheets

SHEET = (100.0, 60.0)
THREE = [np.array([(-40.0, y), (40.0, y)]) for y in (20.0, 0.0, -20.0)]
WHITE = np.array([255, 255, 255])


RED, ORANGE = np.array([17, 51, 204]), np.array([0, 94, 213])


def picture_of(strokes: list[Stroke], px_per_mm: float = 4.0, **options: Any) -> NDArray[np.uint8]:
    data = write_preview_png(strokes, SHEET, px_per_mm, **options)
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
    ink = np.argwhere((picture < 140).any(axis=2))
    assert np.abs(ink.mean(axis=0) - (119.5, 199.5)).max() < 0.26  # the middle of the sheet is that of the picture
    assert ink[:, 1].min() == pytest.approx(40, abs=2) and ink[:, 1].max() == pytest.approx(360, abs=2)


def test_lifted_moves_are_thin_and_grey():
    picture = picture_of([THREE[0], THREE[0] + (0.0, -30.0)])
    x, y = 0.0, 5.0  # halfway from the first line's right end to the second line's left one
    around = picture[round(4 * (30 - y)) - 3 : round(4 * (30 - y)) + 3, 200].astype(int)
    assert 190 <= around.min() < 250 and np.ptp(around, axis=1).max() < 10
    assert (pixel(picture, x + 10.0, y) == WHITE).all()


def ink_of(points: list[tuple[float, float]], px_per_mm: float, pen_mm: float) -> NDArray[np.float64]:
    """How dark each pixel inside the edge is, 0 to 1: the first colour has no red."""
    inside = picture_of([np.array(points)], px_per_mm, pen_mm=pen_mm)[1:-1, 1:-1]
    return 1.0 - (inside[..., 2].astype(float) - 13.0) / 242.0


@pytest.mark.parametrize("pen_mm", [0.3, 0.5, 1.0])
@pytest.mark.parametrize("px_per_mm", [2.5, 4.0, 10.0, 20.0])
def test_a_line_is_as_wide_as_the_pen(px_per_mm, pen_mm):
    ink = ink_of([(-20.0, -10.0), (20.0, 5.0)], px_per_mm, pen_mm)
    width = ink.sum() / (np.hypot(40.0, 15.0) * px_per_mm)
    assert width == pytest.approx(pen_mm * px_per_mm, abs=1.2)


@pytest.mark.parametrize("px_per_mm", [2.5, 4.0, 5.0, 20.0])
def test_a_dot_is_as_wide_as_the_pen(px_per_mm):
    ink = ink_of([(10.3, 5.2), (10.3, 5.2)], px_per_mm, 0.5)
    assert 2.0 * np.sqrt(ink.sum() / np.pi) == pytest.approx(0.5 * px_per_mm, abs=1.7)  # OpenCV's widths are 2 apart
    assert ink.max() > 0.4
    centre = (np.argwhere(ink > 0.0) * ink[ink > 0.0][:, None]).sum(axis=0) / ink.sum()
    np.testing.assert_allclose(centre + 1.0, np.array([24.8, 60.3]) * px_per_mm - 0.5, atol=0.6)


def test_an_empty_sheet_and_strokes_beyond_it():
    empty = picture_of([])
    assert (empty[1:-1, 1:-1] == 255).all()
    assert np.array_equal(picture_of([np.array([(500.0, 500.0), (9e4, -9e4)])]), empty)


def test_the_paper_has_an_edge_and_shows_its_margin():
    framed = picture_of([], margin_mm=5.0)
    for edge in (framed[0], framed[-1], framed[:, 0], framed[:, -1]):
        assert (edge < 200).all()
    rows, columns = np.nonzero((framed[1:-1, 1:-1] < 255).any(axis=2))
    assert (rows.min() + 1, rows.max() + 1, columns.min() + 1, columns.max() + 1) == (20, 219, 20, 379)
    assert (framed[30:210, 30:370] == 255).all()
    for none in (0.0, 30.0, 100.0):
        assert np.array_equal(picture_of([], margin_mm=none), picture_of([]))


def test_moves_that_are_drawn_too_are_orange_and_as_wide_as_the_pen():
    two = [THREE[0], THREE[0] + (0.0, -30.0)]
    lifted, dragged = (picture_of(two, 8.0, stray=stray).astype(int) for stray in (False, True))
    columns = [picture[150:250, 400] for picture in (lifted, dragged)]  # the move crosses the middle here
    assert np.ptp(columns[0], axis=1).max() < 10
    assert np.abs(columns[1] - ORANGE).max(axis=1).min() <= 3
    assert (columns[1] < 200).any(axis=1).sum() > (columns[0] < 220).any(axis=1).sum()


def test_what_is_out_of_reach_is_red():
    stroke = np.column_stack([np.linspace(-40.0, 40.0, 9), np.zeros(9)])
    marks = stroke[:, 0] > 15.0
    picture = picture_of([stroke, THREE[0]], outside=[marks, np.zeros(2, dtype=bool)])
    red = (np.abs(picture.astype(int) - RED).max(axis=2) <= 2).nonzero()
    x, y = red[1] / 4.0 - 50.0, 30.0 - red[0] / 4.0
    assert x.min() == pytest.approx(20.0, abs=1.0) and x.max() == pytest.approx(40.0, abs=1.0)
    assert np.abs(y).max() < 1.0
    assert set(np.floor(np.unique(x))) >= set(range(20, 40)), "without gaps"
    alone = picture_of([stroke], outside=[np.arange(9) == 4])
    assert (np.abs(alone[119:122, 198:202].astype(int) - RED).max(axis=2) <= 2).any()
    assert not (np.abs(alone[:, :190].astype(int) - RED).max(axis=2) <= 2).any()


@pytest.mark.parametrize("marks", [[], [np.zeros(3, dtype=bool)], [np.zeros(2, dtype=bool)] * 2])
def test_marks_of_another_drawing_are_refused(marks):
    with pytest.raises(DrawingError, match="another drawing"):
        picture_of([THREE[0]], outside=marks)


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
        assert export.title and export.suffix == suffix and "/" in export.mime_type
        assert export.write(THREE, SHEET).startswith(begins[suffix])
    assert_same(read_svg(EXPORTS[".svg"].write(THREE, SHEET)), THREE, 1e-4)


OPTIONS: dict[str, Any] = {
    "pen_mm": 0.9,
    "flavour": "marlin",
    "pen": "laser",
    "draw_mm_s": 33.0,
    "travel_mm_s": 133.0,
    "lift_mm": 7.0,
    "power": 0.3,
    "px_per_mm": 3.0,
    "outside": [np.ones(2, dtype=bool)] * 3,
    "stray": True,
    "margin_mm": 4.0,
}


def test_every_option_of_an_export_changes_the_file():
    for export in EXPORTS.values():
        for name in export.options:
            rest = {"pen": "laser"} if name == "power" else {}
            assert export.write(THREE, SHEET, **rest, **{name: OPTIONS[name]}) != export.write(THREE, SHEET, **rest)
    assert {name for export in EXPORTS.values() for name in export.options} == set(OPTIONS)


def test_every_variant_of_g_code_is_another_and_the_first_is_the_plain_one():
    write = EXPORTS[".gcode"].write
    files = [write(THREE, SHEET, **options) for options in GCODE_VARIANTS.values()]
    assert files[0] == write(THREE, SHEET) and len(set(files)) == len(files) == 6
    for (title, options), data in zip(GCODE_VARIANTS.items(), files, strict=True):
        assert title.lower().startswith(options["flavour"])
        assert (b"; laser" in data) == ("laser" in title)
        assert (b"Z4" in data) == ("Z axis" in title)
