"""What the pen leaves: back on the sheet, as far from the strokes as it really is, and as like them as it looks."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from app.drawing.compare.drawn import deviation_um, drawn_strokes, likeness, likeness_to_strokes
from app.drawing.rasterise import render_ink
from app.drawing.toolpath import PenSettings, Placement, default_placement, plan_toolpath
from app.robots import make_robot
from tests.drawing.toolpath.shapes import circle, distances, dot, every_kind, length, line, zigzag

ROBOT = make_robot("delta3")
FLAT = default_placement(ROBOT)
TURNED = Placement(FLAT.height_m, (0.02, -0.03), 0.8)


def test_drawn_strokes_lie_on_the_strokes_of_the_turned_sheet():
    strokes = every_kind()
    drawn = drawn_strokes(plan_toolpath(strokes, ROBOT, TURNED), TURNED)
    assert len(drawn) == len(strokes)
    for run, stroke in zip(drawn, strokes, strict=True):
        assert len(run) >= 2 and distances(run, stroke).max() <= 0.1
        assert np.allclose(run[[0, -1]], stroke[[0, -1]], atol=1e-5)
    assert length(drawn[0]) == pytest.approx(length(strokes[0]), rel=1e-3)
    assert length(drawn[-1]) == 0.0


def test_without_a_lift_the_ways_between_are_ink_too():
    strokes = [line((-20.0, 0.0), (0.0, 0.0)), line((0.0, 30.0), (20.0, 30.0))]
    (run,) = drawn_strokes(plan_toolpath(strokes, ROBOT, FLAT, PenSettings(lift=False)), FLAT)
    assert length(run) == pytest.approx(70.0, abs=0.1)


def test_a_laser_leaves_nothing_between():
    strokes = [line((-20.0, 0.0), (0.0, 0.0)), line((0.0, 30.0), (20.0, 30.0)), dot(0.0, -20.0)]
    drawn = drawn_strokes(plan_toolpath(strokes, ROBOT, FLAT, PenSettings(laser=True)), FLAT)
    assert [length(run) for run in drawn] == pytest.approx([20.0, 20.0, 0.0], abs=1e-3)


def test_a_shifted_line_deviates_by_its_shift():
    strokes = [line((-50.0, 5.0), (50.0, 5.0)), dot(0.0, -40.0)]
    path = plan_toolpath(strokes, ROBOT, FLAT)
    assert deviation_um(path, FLAT, strokes) < 0.01
    shifted = replace(path, pose=path.pose + [0.0, 70e-6, 0.0])
    assert deviation_um(shifted, FLAT, strokes) == pytest.approx(70.0, abs=0.1)


def test_the_deviation_is_that_of_every_segment_tried():
    strokes = [zigzag(2.0, 6.0), circle(15.0, (0.0, -25.0), points=9)]
    path = plan_toolpath(strokes, ROBOT, TURNED, PenSettings(speed_mm_s=300.0))
    apart = [
        np.min([distances(points, TURNED.on_table(stroke)) for stroke in strokes], axis=0)
        for points in (path.pose[path.stroke == number, :2] for number in range(2))
    ]
    wanted = 1e6 * float(np.sqrt(np.mean(np.concatenate(apart) ** 2)))
    assert wanted > 1.0
    assert deviation_um(path, TURNED, strokes) == pytest.approx(wanted, rel=1e-6)


def hatching(spacing: float) -> list[np.ndarray]:
    return [line((-20.0, y), (20.0, y)) for y in np.arange(-15.0, 15.1, spacing)]


def test_a_grey_patch_looks_most_like_hatching_of_its_own_tone():
    grey = np.full((300, 400), 255, np.uint8)
    grey[:, 100:300] = 127
    half = [0.5 * stroke * (1.0, 2.0) for stroke in hatching(1.2)]
    found = [likeness(grey, ink, 0.1, 0.5) for ink in ([], half, hatching(1.2), hatching(0.5))]
    assert np.argmax(found) == 1 and found[1] > 0.8


def test_where_the_ink_lies_matters():
    strokes = [circle(12.0, (-5.0, 3.0)), line((-30.0, -8.0), (25.0, 9.0))]
    grey = render_ink(strokes, (80.0, 60.0), 0.5, 5.0)
    right, mirrored = (likeness(grey, [stroke * axes for stroke in strokes], 0.2, 0.5) for axes in (1.0, (1.0, -1.0)))
    assert right > 0.9 > mirrored + 0.1


def test_strokes_look_like_themselves_and_less_the_farther_they_are_moved():
    strokes = [circle(15.0), line((-20.0, -8.0), (20.0, 9.0)), dot(3.0, 3.0)]
    found = [
        likeness_to_strokes(strokes, [stroke + shift for stroke in strokes], 0.5) for shift in (0.0, 0.5, 1.5, 4.0)
    ]
    assert found[0] == 1.0
    assert all(after < before - 0.02 for before, after in pairwise(found))
