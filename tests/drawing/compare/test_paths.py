"""Drawings to compare robots with."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.compare.paths import rose, zigzag
from app.drawing.errors import DrawingError


def test_a_zigzag_fills_the_sheet_inside_its_margins():
    (stroke,) = zigzag((148.0, 210.0), pitch_mm=4.0, margin_mm=5.0)
    assert np.abs(stroke).max(axis=0).tolist() == [69.0, 100.0]
    step = np.diff(stroke, axis=0)
    rows, turns = step[0::2], step[1::2]
    assert len(rows) == 51 and (rows[:, 1] == 0.0).all()
    assert rows[0::2, 0] == pytest.approx(138.0) and rows[1::2, 0] == pytest.approx(-138.0)
    assert (turns[:, 0] == 0.0).all() and turns[:, 1] == pytest.approx(-4.0)


@pytest.mark.parametrize("pitch", [3.0, 7.0, 500.0])
def test_rows_are_at_most_a_pitch_apart(pitch: float):
    (stroke,) = zigzag(pitch_mm=pitch)
    rows = np.unique(stroke[:, 1])
    assert np.diff(rows).max() <= pitch + 1e-9 and len(rows) >= 2


@pytest.mark.parametrize(("pitch", "margin"), [(0.0, 10.0), (5.0, 74.0)])
def test_a_zigzag_without_room_is_refused(pitch: float, margin: float):
    with pytest.raises(DrawingError, match="room"):
        zigzag((148.0, 210.0), pitch, margin)


@pytest.mark.parametrize(("petals", "tips"), [(2, 4), (3, 3), (4, 8), (5, 5)])
def test_a_rose_has_its_petals_and_is_closed(petals: int, tips: int):
    (stroke,) = rose(50.0, petals)
    radius = np.hypot(*stroke.T)
    assert radius.max() == pytest.approx(50.0) and radius.min() < 1.0
    inner = radius[:-1]
    assert np.count_nonzero((inner > np.roll(inner, 1)) & (inner >= np.roll(inner, -1))) == tips
    assert (stroke[0] == stroke[-1]).all()
