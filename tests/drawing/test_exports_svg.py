"""SVG that other programs read: checked as XML, and by reading it back."""

from __future__ import annotations

from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given

from app.drawing.errors import DrawingError
from app.drawing.exports import write_svg
from app.drawing.svg_import import read_svg
from tests.support.sheet_strokes import assert_same, drawings, sheets

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
STEP_MM = 1e-4
"""To which the file rounds."""

TWO = [np.array([(-80.0, 60.0), (0.0, 0.0), (10.0, 5.0)]), np.array([(80.0, -60.0), (80.0, -60.0)])]


def layers(text: str) -> tuple[ElementTree.Element, ElementTree.Element, ElementTree.Element]:
    root = ElementTree.fromstring(text)
    down, up = root.findall(f"{SVG}g")
    return root, down, up


def lines(layer: ElementTree.Element) -> list[list[list[float]]]:
    return [
        [[float(number) for number in pair.split(",")] for pair in line.attrib["points"].split()]
        for line in layer.findall(f"{SVG}polyline")
    ]


def test_the_sheet_is_in_millimetres_from_its_upper_left_corner():
    root, down, _ = layers(write_svg(TWO, (160.0, 120.0), pen_mm=0.3))
    assert (root.attrib["width"], root.attrib["height"]) == ("160.0mm", "120.0mm")
    assert [float(number) for number in root.attrib["viewBox"].split()] == [0.0, 0.0, 160.0, 120.0]
    assert lines(down) == [[[0.0, 0.0], [80.0, 60.0], [90.0, 55.0]], [[160.0, 120.0], [160.0, 120.0]]]
    assert float(down.attrib["stroke-width"]) == 0.3 and down.attrib["fill"] == "none"
    assert down.attrib["stroke-linecap"] == "round"  # without it a dot does not show


def test_the_lifted_moves_are_in_a_layer_that_nobody_plots():
    _, down, up = layers(write_svg(TWO, (160.0, 120.0)))
    assert lines(up) == [[[90.0, 55.0], [160.0, 120.0]]]
    assert up.attrib["style"] == "display:none"
    assert {layer.attrib[f"{INKSCAPE}groupmode"] for layer in (down, up)} == {"layer"}
    assert up.attrib[f"{INKSCAPE}label"].startswith("%")
    assert_same(read_svg(write_svg(TWO, (160.0, 120.0)).encode()), TWO, STEP_MM)


@given(drawings, sheets)
def test_what_is_written_is_read_back(drawing, sheet):
    assert_same(read_svg(write_svg(drawing, sheet).encode()), drawing, 0.51 * STEP_MM)


def test_no_strokes_make_an_empty_sheet():
    _, down, up = layers(write_svg([], (160.0, 120.0)))
    assert lines(down) == lines(up) == []


@pytest.mark.parametrize(
    ("stroke", "complaint"),
    [
        ([(0.0, 0.0)], "Stroke 2 has the shape"),
        ([(0.0, 0.0, 0.0), (1.0, 1.0, 0.0)], "Stroke 2 has the shape"),
        ([(0.0, 0.0), (np.nan, 1.0)], "Stroke 2 has a point that is no place"),
        ([(0.0, 0.0), (np.inf, 1.0)], "Stroke 2 has a point that is no place"),
    ],
)
def test_what_is_no_stroke_is_refused(stroke, complaint):
    with pytest.raises(DrawingError, match=complaint):
        write_svg([TWO[0], np.array(stroke)], (160.0, 120.0))


@pytest.mark.parametrize("sheet", [(0.0, 10.0), (10.0, -1.0), (np.nan, 10.0), (np.inf, 10.0)])
def test_what_is_no_sheet_is_refused(sheet):
    with pytest.raises(DrawingError, match="cannot be drawn on"):
        write_svg(TWO, sheet)
