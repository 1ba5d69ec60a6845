"""What is beyond the robot is found before anything moves."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.errors import DrawingError
from app.drawing.toolpath import PenSettings, Placement, ToolpathError, default_placement, plan_toolpath, unreachable
from app.robots import ROBOTS, make_robot
from tests.drawing.toolpath.shapes import circle, line


def radial(robot_name: str):
    """A robot, its placement, and a stroke from the middle of the sheet to far outside."""
    robot = make_robot(robot_name)
    return robot, default_placement(robot), np.column_stack([np.linspace(0.0, 600.0, 301), np.zeros(301)])


@pytest.mark.parametrize("name", ROBOTS)
def test_each_vertex_out_of_reach_is_marked(name: str):
    robot, placement, stroke = radial(name)
    inside, outside = unreachable([circle(20.0), stroke], robot, placement)
    assert not inside.any()
    spots = placement.on_table(stroke)
    assert outside.tolist() == [not robot.reach([*xy, placement.height_m, 0.0][: robot.dof]).ok for xy in spots]
    assert 0 < outside.sum() < len(outside)


def test_no_strokes_have_no_vertices():
    robot = make_robot("par4")
    assert unreachable([], robot, default_placement(robot)) == []


@pytest.mark.parametrize("name", ROBOTS)
def test_a_stroke_out_of_reach_is_refused_with_the_limit_that_stops_it(name: str):
    robot, placement, _ = radial(name)
    away = line((0.0, 0.0), (600.0, 0.0))  # its ends are 300 checked points apart
    with pytest.raises(ToolpathError) as refusal:
        plan_toolpath([circle(20.0), away], robot, placement)
    message = str(refusal.value)
    assert message.startswith("Stroke 2 ") and message.endswith(".") and message.count(".") == 1
    x = np.arange(0.0, 0.6, 1e-4)
    poses = np.zeros((len(x), robot.dof))
    poses[:, 0], poses[:, 1], poses[:, 2] = placement.centre_m[0] + x, placement.centre_m[1], placement.height_m
    stopped = poses[np.argmin(robot.reachable(poses))]
    kind = robot.reach(stopped).reason.split(":")[0].rstrip(".")
    assert kind in message


def test_a_pen_that_cannot_be_lifted_is_refused():
    robot = make_robot("fivebar")
    with pytest.raises(ToolpathError, match=r"cannot be lifted at an end of stroke 1 \(The screw is at its upper end"):
        plan_toolpath([circle(20.0)], robot, Placement(0.048, (0.0, 0.336)), PenSettings(lift_mm=4.0))
    assert plan_toolpath([circle(20.0)], robot, Placement(0.048, (0.0, 0.336)), PenSettings(lift_mm=1.0)).duration_s > 0


@pytest.mark.parametrize("lift", [True, False])
def test_a_way_between_strokes_through_forbidden_ground_is_refused(lift: bool):
    """The five-bar's reach has a notch between its motors."""
    robot, placement = make_robot("fivebar"), Placement(-0.01, (0.0, 0.225))
    left, right = line((-130.0, 0.0), (-120.0, 0.0)), line((120.0, 0.0), (130.0, 0.0))
    for alone in (left, right):
        assert plan_toolpath([alone], robot, placement).duration_s > 0
    with pytest.raises(ToolpathError, match=r"^The way to stroke 2 is beyond the robot \("):
        plan_toolpath([left, right], robot, placement, PenSettings(lift=lift))


@pytest.mark.parametrize(
    ("strokes", "complaint"),
    [
        ([], "nothing to draw"),
        ([circle(5.0), np.array([[0.0, np.nan], [1.0, 1.0]])], "Stroke 2 is not a list of points"),
        ([np.zeros((4, 3))], "Stroke 1 is not a list of points"),
        ([np.zeros((0, 2))], "Stroke 1 is not a list of points"),
        ([np.zeros(2)], "Stroke 1 is not a list of points"),
    ],
)
def test_what_is_no_drawing_is_refused(strokes: list, complaint: str):
    robot = make_robot("delta3")
    with pytest.raises(DrawingError, match=complaint):
        plan_toolpath(strokes, robot, default_placement(robot))


def test_a_drawing_of_days_is_refused_before_it_is_computed():
    robot = make_robot("delta3")
    rows = [line((-70.0, y), (70.0, y)) for y in np.arange(-60.0, 60.0, 0.1)]
    with pytest.raises(DrawingError, match=r"would take \d+ minutes"):
        plan_toolpath(rows, robot, default_placement(robot), PenSettings(speed_mm_s=1.0))


@pytest.mark.parametrize("wrong", [{"speed_mm_s": 0.0}, {"up_speed_mm_s": np.inf}, {"lift_mm": -1.0}])
def test_impossible_settings_are_refused(wrong: dict):
    with pytest.raises(DrawingError):
        PenSettings(**wrong)
