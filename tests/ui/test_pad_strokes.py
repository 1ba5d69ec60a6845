"""What a drawing pad's page may send, and what the server keeps of it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.drawing.errors import DrawingError
from app.ui.drawing.pad_strokes import MAX_POINTS, MAX_STROKES, PadStrokes, Piece, read_piece

SHEET = (148.0, 210.0)
numbers = st.integers(-99999, 99999)


def piece(number: int, points: object, last: bool = True) -> Piece:
    return Piece(number, last, np.array(points, dtype=np.float64))


def drawn(*pieces: Piece) -> PadStrokes:
    pad = PadStrokes()
    for each in pieces:
        pad.take(each, SHEET)
    return pad


def points_of(pad: PadStrokes) -> list[list[list[float]]]:
    return [stroke.points_mm.tolist() for stroke in pad.kept]


@given(st.integers(0, 10**9 - 1), st.booleans(), st.lists(st.tuples(numbers, numbers), min_size=1))
def test_what_a_pad_sends_is_read(number: int, last: bool, units: list[tuple[int, int]]):
    text = f"{number} {'last' if last else 'more'} " + " ".join(f"{x},{y}" for x, y in units)
    found = read_piece(text)
    assert found is not None and (found.number, found.last) == (number, last)
    np.testing.assert_allclose(found.points_mm, np.array(units) / 10.0)


@pytest.mark.parametrize(
    "text",
    [
        "", "1 last", "1 last ", "1 last 1", "1 last 1,2,3", "1 last 1,2 3", "1 last 1.5,2", "1 last nan,0",
        "1 last 1e3,0", "1 last 1,2\n", " 1 last 1,2", "1  last 1,2", "1 last 1,2 ", "1 LAST 1,2", "-1 last 1,2",
        "1 last +1,2", "1 last 123456,0", "1234567890 last 1,2", "١ last 1,2", "1 last ١,2", "1 last 1,--2",
        "<script>", "1 last 1 ,2",
    ],
)  # fmt: skip
def test_anything_else_is_no_stroke(text: str):
    assert read_piece(text) is None


forged = st.from_regex(r"[0-9]{1,3} (more|last)( -?[0-9]{1,5},-?[0-9]{1,5}){1,4}", fullmatch=True)


@given(st.lists(st.one_of(forged, st.text("0123456789 ,-morelast\n", max_size=30), st.text(max_size=30)), max_size=12))
def test_forged_messages_leave_good_strokes_on_the_sheet(texts: list[str]):
    pad = drawn(*(found for text in texts if (found := read_piece(text)) is not None))
    for stroke in pad.kept:
        assert stroke.points_mm.dtype == np.float64 and stroke.points_mm.ndim == 2 and len(stroke.points_mm) >= 2
        assert np.all(np.abs(stroke.points_mm) <= np.array(SHEET) / 2)


def test_pieces_are_put_together_and_a_tap_is_a_dot():
    pad = drawn(piece(1, [(0, 0), (1, 0)], last=False), piece(2, [(2, 0), (2, 0), (3, 1)]), piece(3, [(5, 5)]))
    assert points_of(pad) == [[[0, 0], [1, 0], [2, 0], [3, 1]], [[5, 5], [5, 5]]]
    assert [stroke.number for stroke in pad.kept] == [2, 3] and pad.heard == 3


def test_points_off_the_sheet_are_brought_to_its_edge():
    assert points_of(drawn(piece(1, [(-900, 0), (10, 300)]))) == [[[-74, 0], [10, 105]]]


def test_no_more_strokes_than_the_pad_holds():
    pad = drawn(*(piece(number, [(0, 0)]) for number in range(MAX_STROKES)))
    with pytest.raises(DrawingError, match="undo or clear"):
        pad.take(piece(999, [(0, 0)]), SHEET)
    pad.undo()
    assert pad.take(piece(1000, [(1, 1)]), SHEET) and len(pad.kept) == MAX_STROKES


def test_no_more_points_than_the_pad_holds_and_none_are_hoarded():
    path = np.column_stack([np.linspace(-70, 70, 900), np.linspace(0, 100, 900)])
    pad = drawn(piece(1, path), *(piece(k, path, last=False) for k in range(2, 200)))
    with pytest.raises(DrawingError, match="20,000 points"):
        pad.take(piece(200, path), SHEET)
    assert [len(stroke.points_mm) for stroke in pad.kept] == [900]
    assert pad.take(piece(201, path), SHEET), "there is room again"
    assert sum(len(stroke.points_mm) for stroke in pad.kept) <= MAX_POINTS
