"""One drawing on every robot: the numbers are those of the toolpath itself."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.drawing.compare import robots
from app.drawing.compare.robots import draw_on, largest_scale
from app.drawing.toolpath import (
    PenSettings,
    default_pen,
    default_placement,
    plan_toolpath,
    unreachable,
)
from app.robots import ROBOTS, make_robot
from app.robots.limits import rate_limits
from tests.drawing.toolpath.shapes import circle, every_kind, line


@pytest.mark.parametrize("name", ROBOTS)
def test_the_numbers_are_the_toolpaths(name: str):
    robot, strokes, pen = make_robot(name), every_kind(), PenSettings(120.0, 200.0, 3.0)
    result = draw_on(strokes, name, pen)
    path = plan_toolpath(strokes, robot, default_placement(robot), pen)
    assert result.robot == name and result.reason == "" and result.scaled_to == 1.0
    assert result.time_s == path.duration_s and result.down_s + result.hops_s == pytest.approx(result.time_s)
    assert result.down_s == pytest.approx(1e-3 * np.count_nonzero(path.stroke >= 0), abs=2e-3)
    speed = np.abs(np.diff(path.q, axis=0)) / 1e-3
    share = speed / rate_limits(robot).speed
    joint = int(np.argmax(share.max(axis=0)))
    assert result.peak_joint_speed_ratio == pytest.approx(path.max_joint_speed_ratio, abs=1e-9)
    assert result.peak_joint_speed == pytest.approx(speed[:, joint].max(), abs=1e-9)
    assert result.speed_unit == ("m/s" if name == "linear" else "rad/s")
    conditioning = robot.conditioning(path.pose)
    assert result.worst_conditioning == pytest.approx(conditioning.max(), rel=1e-3)
    assert result.mean_conditioning == pytest.approx(conditioning.mean(), rel=1e-3)


@pytest.mark.parametrize("name", ROBOTS)
def test_by_default_the_pen_is_what_suits_the_robot(name: str):
    strokes = [circle(20.0), line((0.0, 0.0), (30.0, 0.0))]
    robot = make_robot(name)
    assert draw_on(strokes, name) == draw_on(strokes, name, default_pen(robot))


@pytest.mark.parametrize("name", ROBOTS)
def test_what_is_too_large_is_drawn_as_large_as_it_fits(name: str):
    strokes = [circle(400.0), line((-50.0, 0.0), (50.0, 0.0))]
    robot = make_robot(name)
    placement, pen = default_placement(robot), default_pen(robot)
    result = draw_on(strokes, name)
    scaled = [result.scaled_to * stroke for stroke in strokes]
    assert 0.1 < result.scaled_to < 1.0
    assert result.time_s == plan_toolpath(scaled, robot, placement, pen).duration_s
    larger = [1.01 * stroke for stroke in scaled]
    assert any(outside.any() for outside in unreachable(larger, robot, placement))
    assert f"drawn at {100 * result.scaled_to:.3g} %" in result.reason and "beyond the robot" in result.reason


@pytest.mark.parametrize("turn", [0.0, 0.7, 2.0])
def test_the_largest_scale_is_where_the_reach_ends(turn: float):
    robot = make_robot("delta3")
    placement = default_placement(robot)
    direction = np.array([math.cos(turn), math.sin(turn)])
    scale = largest_scale([np.array([[0.0, 0.0], 600.0 * direction])], robot, placement, PenSettings())
    shares = np.linspace(0.0, 1.0, 6001)
    pose = np.zeros((len(shares), 3))
    pose[:, :2] = 0.6 * shares[:, None] * direction
    heights = (placement.height_m, placement.height_m + 0.004)
    ends = []
    for pose[:, 2] in heights:
        ends.append(shares[np.argmin(robot.reachable(pose))])
    assert scale == pytest.approx(min(ends), abs=1.5e-3) and scale <= min(ends)


def test_where_the_ways_between_do_not_fit_it_is_drawn_still_smaller(monkeypatch: pytest.MonkeyPatch):
    """The reach of the strokes is made to seem larger than it is."""
    strokes = [circle(400.0)]
    fitting = draw_on(strokes, "delta3").scaled_to
    monkeypatch.setattr(robots, "largest_scale", lambda *_: 1.1 * fitting)
    assert draw_on(strokes, "delta3").scaled_to == pytest.approx(1.1 * fitting * robots.SHRINK**4)


def test_other_dimensions_are_another_robot():
    large, small = (draw_on([circle(20.0)], "delta3", dimensions=changed) for changed in (None, {"rf": 0.12}))
    assert large.worst_conditioning != small.worst_conditioning and not small.reason


@pytest.mark.parametrize(
    ("strokes", "name", "pen", "dimensions", "complaint"),
    [
        ([], "delta3", None, {}, "nothing to draw"),
        ([circle(20.0)], "hexapod", None, {}, "no robot"),
        ([circle(20.0)], "delta3", None, {"rf": 90.0}, "rf"),
        ([circle(20.0) + 50_000.0], "par4", None, {}, "beyond the robot"),
        ([circle(40.0)] * 20, "linear", PenSettings(speed_mm_s=1.0), {}, "minutes"),
        ([np.array([[math.nan, 0.0], [1.0, 0.0]])], "delta3", None, {}, "not a list of points"),
    ],
)
def test_what_cannot_be_drawn_has_a_reason_and_no_numbers(strokes, name, pen, dimensions, complaint):
    result = draw_on(strokes, name, pen, dimensions)
    assert complaint in result.reason and math.isnan(result.time_s) and math.isnan(result.worst_conditioning)
