"""The paths: closed, no larger than they say, and as fast as they say."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.motion import PATHS, Tour, quintic
from app.robots import ROBOTS, make_robot

UNTIMED = settings(deadline=None)
PHASES = np.linspace(0.0, 1.0, 4001)[:-1]
STEP = PHASES[1]


def curve(name: str) -> np.ndarray:
    return np.stack(PATHS[name].offset(PHASES), axis=-1)


def speeds(points: np.ndarray) -> np.ndarray:
    """Distance per lap, around the closed curve."""
    return np.linalg.norm(np.diff(points, axis=0, append=points[:1]), axis=1) / STEP


@pytest.mark.parametrize("name", PATHS)
def test_it_is_closed_and_does_not_jump(name: str):
    assert speeds(curve(name)).max() < 12.0


@pytest.mark.parametrize("name", PATHS)
def test_it_starts_on_the_positive_x_axis(name: str):
    x, y = curve(name)[0]
    assert x > 0.5 and y == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("name", PATHS)
def test_it_reaches_the_unit_circle_and_stays_within(name: str):
    assert np.linalg.norm(curve(name), axis=1).max() == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("name", PATHS)
def test_it_is_centred(name: str):
    points = curve(name)
    assert np.allclose(points.max(0), -points.min(0), atol=1e-9)


@pytest.mark.parametrize(("name", "length"), [("circle", 2 * np.pi), ("square", 4 * np.sqrt(2.0))])
def test_circle_and_square_are_run_at_constant_speed(name: str, length: float):
    assert np.allclose(speeds(curve(name)), length, rtol=1e-5)


def test_the_square_has_four_corners_on_the_circle():
    points = curve("square")
    corners = points[np.isclose(np.linalg.norm(points, axis=1), 1.0, atol=1e-9)]
    assert np.allclose(np.abs(corners), np.sqrt(0.5)) and len(np.unique(corners.round(6), axis=0)) == 4
    assert np.allclose(np.abs(points).max(1), np.sqrt(0.5))


def test_the_lemniscate_is_bernoullis():
    x, y = curve("lemniscate").T
    assert np.allclose((x**2 + y**2) ** 2, x**2 - y**2, atol=1e-12)
    assert np.isclose(x, 0.0, atol=1e-9).sum() == 2


def test_point_to_point_rests_at_both_ends_and_never_turns_back_between():
    x, y = curve("point-to-point").T
    assert (y == 0.0).all()
    assert np.mean(x == 1.0) == pytest.approx(0.15, abs=0.02) and np.mean(x == -1.0) == pytest.approx(0.15, abs=0.02)
    there, back = x[PHASES < 0.5], x[PHASES >= 0.5]
    assert (np.diff(there) <= 1e-12).all() and (np.diff(back) >= -1e-12).all()
    assert there[0] == 1.0 and back[0] == -1.0


@pytest.mark.parametrize("name", ["circle", "lemniscate"])
def test_round_paths_turn_counter_clockwise_at_first(name: str):
    assert curve(name)[1, 1] > 0.0


def test_the_quintic_is_at_rest_at_both_ends():
    """Value, speed and acceleration at 0 and 1, by one-sided differences."""
    h = 1e-4
    for end, value, inward in ((0.0, 0.0, 1.0), (1.0, 1.0, -1.0)):
        near = quintic(end + inward * h * np.arange(4))
        assert near[0] == value
        assert np.abs(np.diff(near)).max() / h < 1e-5
        assert np.abs(np.diff(near, 2)).max() / h**2 < 0.05
    assert quintic(0.5) == pytest.approx(0.5)


@UNTIMED
@given(st.floats(-5.0, 5.0))
def test_the_quintic_is_symmetric_monotonous_and_constant_beyond(s: float):
    assert quintic(s) + quintic(1.0 - s) == pytest.approx(1.0, abs=1e-12)
    assert 0.0 <= quintic(s) <= 1.0
    assert quintic(s + 0.01) >= quintic(s)
    if s <= 0.0 or s >= 1.0:
        assert quintic(s) == float(s >= 1.0)


@pytest.mark.parametrize("robot_name", ROBOTS)
@pytest.mark.parametrize("name", PATHS)
def test_a_tour_lies_around_home_in_its_plane(robot_name: str, name: str):
    robot = make_robot(robot_name)
    poses = Tour(name, 0.04, 8.0).poses(robot, np.linspace(0.0, 8.0, 201))
    assert poses.shape == (201, robot.dof)
    assert np.array_equal(poses[:, 2:], np.broadcast_to(robot.home[2:], poses[:, 2:].shape))
    distance = np.linalg.norm(poses[:, :2] - robot.home[:2], axis=1)
    assert distance.max() == pytest.approx(0.04, abs=1e-9) and distance.max() <= 0.04 + 1e-12


@UNTIMED
@given(st.sampled_from(list(PATHS)), st.floats(0.0, 50.0), st.floats(0.5, 20.0))
def test_every_lap_is_alike_and_clockwise_is_the_mirror_image(name: str, t: float, lap: float):
    robot = make_robot("par4")
    tour, other_way = Tour(name, 0.05, lap), Tour(name, 0.05, lap, clockwise=True)
    assert np.allclose(tour.poses(robot, t), tour.poses(robot, t + 3 * lap), atol=1e-9)
    offset, mirrored = tour.poses(robot, t) - robot.home, other_way.poses(robot, t) - robot.home
    assert np.allclose(mirrored, offset * [1, -1, 1, 1], atol=1e-12)


def test_poses_have_the_shape_of_the_times():
    robot = make_robot("delta3")
    assert Tour().poses(robot, 0.0).shape == (3,)
    assert Tour().poses(robot, np.zeros((2, 5))).shape == (2, 5, 3)
