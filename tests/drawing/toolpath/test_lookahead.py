"""The look-ahead against a plain loop, and against a robot whose answer is known by hand."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.toolpath.lookahead import Bounds, find_bounds, find_profile
from app.drawing.toolpath.placement import Placement, default_placement
from app.drawing.toolpath.polyline import SPACING_M, Polylines, lay_out
from app.robots import ROBOTS, make_robot
from app.robots.limits import RateLimits, rate_limits
from app.robots.robot import Array
from tests.drawing.toolpath.shapes import circle, every_kind, length, line, random_strokes

FLAT = Placement(-0.34)


def planned(strokes: list[Array], name: str = "delta3", speed: float = 0.08) -> tuple[Polylines, Bounds]:
    robot = make_robot(name)
    placement = default_placement(robot)
    lines = lay_out(strokes, placement)
    return lines, find_bounds(lines, robot, placement.height_m, rate_limits(robot), speed)


def speeds_by_a_loop(lines: Polylines, bounds: Bounds) -> Array:
    """Squared speeds at the vertices, stroke by stroke, forward and back as in any firmware."""
    squared = bounds.vertex.copy()
    gain = 2.0 * bounds.acceleration * lines.length
    for first, last in zip(lines.first[:-1], lines.last, strict=True):
        for i in range(first, last):
            squared[i + 1] = min(squared[i + 1], squared[i] + gain[i])
        for i in range(last - 1, first - 1, -1):
            squared[i] = min(squared[i], squared[i + 1] + gain[i])
    return squared


@pytest.mark.parametrize("name", ROBOTS)
def test_running_minima_equal_the_two_passes(name: str):
    lines, bounds = planned([*every_kind(), *random_strokes(np.random.default_rng(1), 12)], name, 0.3)
    profile = find_profile(lines, bounds)
    assert np.allclose(profile.enter**2, speeds_by_a_loop(lines, bounds), atol=1e-12)


def test_strokes_do_not_know_of_each_other():
    strokes = every_kind()
    lines, bounds = planned(strokes)
    together = find_profile(lines, bounds).duration
    apart = [find_profile(*planned([stroke])).duration for stroke in strokes]
    assert np.allclose(together, np.concatenate(apart), atol=1e-12)


def test_each_segment_covers_its_length_in_its_time():
    lines, bounds = planned(random_strokes(np.random.default_rng(2), 10), speed=0.3)
    profile = find_profile(lines, bounds)
    segment = np.arange(len(lines.points))
    assert np.allclose(profile.travelled(segment, np.zeros(len(segment)), lines.length), 0.0, atol=1e-12)
    assert np.allclose(profile.travelled(segment, profile.duration, lines.length), lines.length, atol=1e-12)
    early = profile.travelled(segment, profile.duration * (0.5 - 1e-4), lines.length)
    late = profile.travelled(segment, profile.duration * (0.5 + 1e-4), lines.length)
    speed = (late - early) / np.maximum(profile.duration * 2e-4, 1e-15)
    moving = lines.length > 1e-6
    assert (speed[moving] ** 2 <= bounds.cruise[moving] * (1 + 1e-6)).all()


class Plotter:
    """A machine whose joints are x, y and z."""

    dof = 3

    def jacobian(self, pose: Array) -> Array:
        return np.broadcast_to(np.eye(3), (len(pose), 3, 3))


def test_a_line_on_a_machine_with_joints_along_x_and_y():
    limits = RateLimits(np.full(3, 1.0), np.full(3, 4.0))
    lines = lay_out([line((0.0, 0.0), (30.0, 0.0))], FLAT)
    profile = find_profile(lines, find_bounds(lines, Plotter(), 0.0, limits, 0.1))  # pyright: ignore[reportArgumentType]
    # half of 4 m/s^2 for speeding up, from the jump of 2 m/s^2 * 8 ms = 16 mm/s that the average smooths
    ramp_s, ramp_m = (0.1 - 0.016) / 2.0, (0.1**2 - 0.016**2) / (2 * 2.0)
    assert profile.enter[0] == pytest.approx(0.016)
    assert profile.duration.sum() == pytest.approx(2 * ramp_s + (0.030 - 2 * ramp_m) / 0.1)


def test_a_corner_costs_what_junction_deviation_says_and_a_reversal_stops():
    corner = np.array([[0.0, 0.0], [20.0, 0.0], [20.0, 20.0]])
    back = np.array([[0.0, 0.0], [20.0, 0.0], [0.0, 0.0]])
    lines, bounds = planned([corner, back])
    turning = np.flatnonzero(bounds.vertex[lines.inner] < 0.01**2 * 9)
    corner_v2, back_v2 = bounds.vertex[lines.inner][turning]
    robot = make_robot("delta3")
    jacobian = robot.jacobian([0.02, 0.0, -0.34])
    a = 0.5 * np.min(60.0 / np.abs(jacobian[:, :2] @ np.array([-1.0, 1.0]) / np.sqrt(2)))
    s = np.sin(np.pi / 4)
    assert corner_v2 == pytest.approx(a * 0.02e-3 * s / (1 - s))
    assert back_v2 == 0.0


def test_a_circle_takes_half_of_the_joints_acceleration():
    radius = 1.5
    lines, bounds = planned([circle(radius, points=200)], speed=2.0)
    robot = make_robot("delta3")
    middle = lines.inner[20:-20]
    pose = np.column_stack([lines.points[middle], np.full(len(middle), -0.34)])
    inward = -lines.points[middle] / (1e-3 * radius)
    joints = np.einsum("mnd,md->mn", robot.jacobian(pose)[..., :2], inward) / (1e-3 * radius)
    share = bounds.vertex[middle] * np.abs(joints).max(axis=1) / 60.0
    assert np.allclose(share, 0.5, atol=0.02)


def test_long_lines_are_divided_and_repeated_vertices_dropped():
    strokes = [np.array([[0.0, 0.0], [0.0, 0.0], [33.0, 0.0], [33.0, 0.0]]), np.array([[5.0, 5.0], [5.0, 5.0]])]
    lines = lay_out(strokes, FLAT)
    assert lines.length[: lines.last[0]].max() <= SPACING_M and lines.length[: lines.last[0]].min() > 1e-4
    assert 1e3 * lines.length.sum() == pytest.approx(length(strokes[0]))
    assert lines.first.tolist() == [0, 18, 19]
    assert np.allclose(lines.points[[0, 17, 18]], [[0.0, 0.0], [0.033, 0.0], [0.005, 0.005]])
