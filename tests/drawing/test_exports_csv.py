"""Tables of strokes and of a timed path, read back by the standard library and NumPy."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.exports import write_strokes_csv, write_toolpath_csv
from tests.support.sheet_strokes import assert_same, drawings


@dataclass(frozen=True)
class Path:
    t: NDArray[np.float64]
    pose: NDArray[np.float64]
    q: NDArray[np.float64]
    pen: NDArray[np.bool_]


def some_path(samples: int, coordinates: int = 4, joints: int = 4) -> Path:
    numbers = np.random.default_rng(1)
    pose, q = numbers.normal(size=(samples, coordinates)), numbers.normal(size=(samples, joints))
    return Path(np.arange(samples) / 1000.0, pose, q, numbers.random(samples) > 0.5)


@given(drawings)
def test_strokes_are_read_back_exactly(drawing):
    rows = list(csv.DictReader(io.StringIO(write_strokes_csv(drawing))))
    assert list(rows[0]) == ["stroke_id", "x_mm", "y_mm"]
    found = [
        np.array([(float(row["x_mm"]), float(row["y_mm"])) for row in rows if row["stroke_id"] == str(number)])
        for number in range(len(drawing))
    ]
    assert_same(found, drawing, 0.0)
    assert len(rows) == sum(map(len, drawing))


def test_no_strokes_are_a_header():
    assert write_strokes_csv([]) == "stroke_id,x_mm,y_mm\n"


@given(st.integers(1, 50), st.integers(3, 4), st.integers(2, 4))
def test_a_timed_path_is_read_back(samples, coordinates, joints):
    path = some_path(samples, coordinates, joints)
    text = write_toolpath_csv(path)
    assert text.splitlines()[0] == ",".join(["t", "x", "y", "z", "q1", "q2", "q3", "q4"][: 4 + joints] + ["pen"])
    table = np.loadtxt(io.StringIO(text), delimiter=",", skiprows=1, ndmin=2)
    wanted = np.column_stack([path.t, path.pose[:, :3], path.q, path.pen])
    np.testing.assert_allclose(table, wanted, rtol=0.0, atol=0.51e-7)
    assert {line.rpartition(",")[2] for line in text.splitlines()[1:]} <= {"0", "1"}


@pytest.mark.parametrize("part", ["t", "pose", "q", "pen"])
def test_a_path_with_missing_samples_is_refused(part):
    path = some_path(5)
    with pytest.raises(DrawingError, match="for every sample"):
        write_toolpath_csv(replace(path, **{part: getattr(path, part)[:-1]}))


def test_a_flat_pose_is_refused():
    with pytest.raises(DrawingError, match="for every sample"):
        write_toolpath_csv(some_path(5, coordinates=2))
