"""The paper's file of points: a robot that goes through it draws the strokes, and reading gives them back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.drawing.errors import DrawingError
from app.drawing.exports import read_points_file, write_points_file
from tests.support.sheet_strokes import assert_same, drawings, sheets

HEADER = "# Ptos_Dibujo 1\n# sheet_mm 160 120\n"
EXAMPLE = HEADER + "-20 10 4\n-20 10 0\n-15.5 11 0\n-15.5 11 4\n"


def test_the_documented_example():
    drawing, sheet = read_points_file(EXAMPLE)
    assert [stroke.tolist() for stroke in drawing] == [[[-20.0, 10.0], [-15.5, 11.0]]]
    assert sheet == (160.0, 120.0)
    assert read_points_file(write_points_file(drawing, sheet))[1] == sheet
    numbers = [[float(word) for word in line.split()] for line in write_points_file(drawing, sheet).splitlines()[2:]]
    assert numbers == [[-20.0, 10.0, 4.0], [-20.0, 10.0, 0.0], [-15.5, 11.0, 0.0], [-15.5, 11.0, 4.0]]


@given(st.just([]) | drawings, sheets, st.floats(0.1, 50.0))
def test_what_is_written_is_read_back_exactly(drawing, sheet, lift):
    again, same_sheet = read_points_file(write_points_file(drawing, sheet, lift_mm=lift))
    assert_same(again, drawing, 0.0)
    assert same_sheet == sheet


@given(drawings, sheets)
def test_going_from_line_to_line_draws_the_strokes(drawing, sheet):
    """A robot that knows nothing of strokes: it draws where both ends of a move are on the paper."""
    rows = np.array([line.split() for line in write_points_file(drawing, sheet).splitlines()[2:]], dtype=float)
    drawn = (rows[1:, 2] == 0.0) & (rows[:-1, 2] == 0.0)
    moves = np.stack([rows[:-1, :2], rows[1:, :2]], axis=1)[drawn]
    wanted = np.concatenate([np.stack([stroke[:-1], stroke[1:]], axis=1) for stroke in drawing])
    np.testing.assert_array_equal(moves, wanted)
    sideways = (rows[1:, :2] != rows[:-1, :2]).any(axis=1)
    assert not (sideways & (rows[1:, 2] != rows[:-1, 2])).any()


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "Line 1: the file is not one"),
        ("1 2 3\n4 5 6\n", "Line 1: the file is not one"),
        ("# Ptos_Dibujo 1\n1 2 3\n", "Line 2: the sheet is missing"),
        ("# Ptos_Dibujo 1\n# sheet_mm 160\n", "Line 2: '160' are not 2 numbers"),
        ("# Ptos_Dibujo 1\n# sheet_mm 0 120\n", "cannot be drawn on"),
        (EXAMPLE + "1 2\n", "Line 7: '1 2' are not 3 numbers"),
        (EXAMPLE + "1 2 3 4\n", "Line 7: '1 2 3 4' are not 3 numbers"),
        (EXAMPLE + "1 x 4\n", "Line 7: '1 x 4' are not 3 numbers"),
        (EXAMPLE + "1 nan 4\n", "Line 7: '1 nan 4' are not 3 numbers"),
        (EXAMPLE + "1 1e9 4\n", "Line 7: '1 1e9 4' are not 3 numbers"),
        (EXAMPLE + "1 1_0 4\n", "Line 7: '1 1_0 4' are not 3 numbers"),
        (EXAMPLE + "1 2 -1\n", "Line 7: z -1 is below the paper"),
        (EXAMPLE + "1 2 0\n1 3 0\n1 3 4\n", "Line 9: a stroke must begin and end lifted"),
        (EXAMPLE + "1 2 4\n1 2 0\n1 3 0\n", "Line 9: a stroke must begin and end lifted"),
        (EXAMPLE + "1 2 4\n1 2 0\n1 2 4\n", "Line 9: a stroke needs two or more points"),
        (EXAMPLE + "1 2 4\n1 2 4\n", "Line 8: a stroke needs two or more points"),
        (EXAMPLE + "\n1 2 4\n1 3 0\n1 3 0\n1 3 4\n", "Line 8: the pen must be lifted right over"),
        (EXAMPLE + "1 3 4\n1 3 0\n1 3 0\n1 2 4\n", "Line 10: the pen must be lifted right over"),
    ],
)
def test_refusals_name_the_line(text, complaint):
    with pytest.raises(DrawingError, match=complaint) as refusal:
        read_points_file(text)
    assert str(refusal.value).endswith(".") and "\n" not in str(refusal.value)


@pytest.mark.parametrize("lift", [0.0, -4.0, np.nan, np.inf])
def test_a_lift_must_lift(lift):
    with pytest.raises(DrawingError, match="does not lift the pen"):
        write_points_file([np.zeros((2, 2))], (160.0, 120.0), lift_mm=lift)


@given(st.text(alphabet="0123456789.- \n", max_size=100).map(lambda text: HEADER + text) | st.text(max_size=50))
def test_any_text_is_read_or_refused(text):
    try:
        drawing, _ = read_points_file(text)
    except DrawingError:
        return
    assert all(stroke.ndim == 2 and len(stroke) >= 2 and np.isfinite(stroke).all() for stroke in drawing)
