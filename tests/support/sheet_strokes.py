"""Strokes on a sheet, for tests of what writes and reads them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

Stroke = NDArray[np.float64]

coordinates = st.floats(-500.0, 500.0, allow_nan=False)
points = st.tuples(coordinates, coordinates)
strokes = st.lists(points, min_size=2, max_size=12).map(np.array)
dots = points.map(lambda point: np.array([point, point]))
loops = st.lists(points, min_size=3, max_size=12).map(lambda corners: np.array([*corners, corners[0]]))

drawings = st.lists(strokes | dots | loops, min_size=1, max_size=6)
"""Lists of strokes, dots and closed strokes."""

sheets = st.tuples(st.floats(1.0, 1000.0), st.floats(1.0, 1000.0))


def assert_same(found: Sequence[Stroke], wanted: Sequence[Stroke], within_mm: float) -> None:
    """The same strokes in the same order, point by point."""
    assert [stroke.shape for stroke in found] == [stroke.shape for stroke in wanted]
    for stroke, original in zip(found, wanted, strict=True):
        np.testing.assert_allclose(stroke, original, rtol=0.0, atol=within_mm)
