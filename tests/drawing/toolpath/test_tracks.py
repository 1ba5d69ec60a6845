"""A track is its toolpath, only with fewer samples."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from app.drawing.errors import DrawingError
from app.drawing.toolpath import PenSettings, Toolpath, Track, default_placement, plan_toolpath, track
from app.robots import make_robot
from tests.drawing.toolpath.shapes import dot, every_kind, length, line

TOUCHING = [line((0.0, 0.0), (10.0, 0.0)), line((10.0, 0.0), (10.0, 5.0)), dot(10.0, 5.0)]


def planned(strokes: list, pen: PenSettings | None = None) -> Toolpath:
    robot = make_robot("par4")
    return plan_toolpath(strokes, robot, default_placement(robot), pen)


@pytest.mark.parametrize("step_s", [0.001, 0.005, 0.04, 0.0037])
@pytest.mark.parametrize("lift", [True, False])
def test_every_sample_is_the_toolpaths(step_s: float, lift: bool):
    path = planned(every_kind(), PenSettings(lift=lift))
    small = track(path, step_s)
    assert small.t[0] == 0.0 and small.t[-1] == path.t[-1] == small.duration_s
    assert np.allclose(np.diff(small.t)[:-1], step_s) and 0.0 < np.diff(small.t)[-1] <= step_s + 1e-9
    for column in range(path.pose.shape[1]):
        assert np.allclose(small.pose[:, column], np.interp(small.t, path.t, path.pose[:, column]), atol=1e-7)
    for column in range(path.q.shape[1]):
        assert np.allclose(small.q[:, column], np.interp(small.t, path.t, path.q[:, column]), atol=1e-6)
    nearest = np.rint(small.t / 1e-3).astype(int)
    assert np.array_equal(small.pen, path.pen[nearest]) and np.array_equal(small.stroke, path.stroke[nearest])


@pytest.mark.parametrize("strokes", [every_kind(), TOUCHING], ids=["every kind", "touching"])
def test_how_far_each_stroke_has_come(strokes: list):
    path = planned(strokes)
    small = track(path, 0.002)
    assert (small.along_mm[small.stroke < 0] == 0.0).all()
    for number, stroke in enumerate(strokes):
        along = small.along_mm[small.stroke == number]
        assert (np.diff(along) >= 0.0).all() and along[0] <= 0.2
        assert along[-1] == pytest.approx(length(stroke), rel=0.1, abs=0.2)  # corners are rounded
        rows = np.flatnonzero(path.stroke == number)
        for share in (0.25, 0.5, 0.9):
            so_far = rows[: 1 + int(share * len(rows))]
            there = np.interp(path.t[so_far[-1]], small.t[small.stroke == number], along)
            assert there == pytest.approx(1e3 * length(path.pose[so_far, :2]), abs=0.02)


@pytest.mark.parametrize("pen", [PenSettings(), PenSettings(lift=False), PenSettings(laser=True)])
@pytest.mark.parametrize("strokes", [every_kind(), TOUCHING], ids=["every kind", "touching"])
def test_strokes_done_before(strokes: list, pen: PenSettings):
    path = planned(strokes, pen)
    small = track(path)
    ends = [path.t[path.stroke == number].max() for number in range(len(strokes))]
    for t, stroke, done in zip(small.t, small.stroke, small.done, strict=True):
        assert done == (stroke if stroke >= 0 else sum(end < t for end in ends))
    assert small.done[0] == 0 and small.done[-1] == len(strokes)
    assert (np.diff(small.done) >= 0).all()


def test_it_is_small():
    path = planned(every_kind())
    small = track(path)
    assert small.t.dtype == np.float64 and small.pen.dtype == np.bool_
    assert {part.dtype.name for part in (small.pose, small.q, small.along_mm)} == {"float32"}
    assert {part.dtype.name for part in (small.stroke, small.done)} == {"int32"}
    again: Track = pickle.loads(pickle.dumps(small))
    assert np.array_equal(again.q, small.q) and len(pickle.dumps(small)) < len(pickle.dumps(path)) / 6


@pytest.mark.parametrize("step_s", [0.0, -1.0, np.nan])
def test_steps_that_are_none_are_refused(step_s: float):
    with pytest.raises(DrawingError, match="above zero"):
        track(planned([dot(0.0, 0.0)]), step_s)
