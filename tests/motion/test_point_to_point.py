"""Point to point: straight in joint space, from rest to rest, within speed, acceleration and torque."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from app.motion import MotionError, point_to_point
from app.robots import ROBOTS, make_robot
from app.robots.dynamics import dynamics_of
from app.robots.limits import drive_limits


def two_poses(robot) -> tuple[np.ndarray, np.ndarray]:
    start, end = robot.home.copy(), robot.home.copy()
    start[:3] += [-0.04, 0.01, -0.03]
    end[:3] += [0.05, 0.03, -0.01]
    end[3:] += 0.3
    return start, end


@pytest.mark.parametrize("name", ROBOTS)
def test_it_arrives_at_rest_within_the_limits(name):
    robot = make_robot(name)
    start, end = two_poses(robot)
    limits = drive_limits(robot)
    move = pickle.loads(pickle.dumps(point_to_point(robot, start, end, limits)))
    t = np.linspace(0.0, move.duration_s, 4001)
    pose, rate, acceleration = move.sample(t)
    assert np.allclose(pose[[0, -1]], [start, end], atol=1e-9)
    assert np.allclose(rate[[0, -1]], 0.0, atol=1e-9)
    assert np.allclose(np.gradient(pose, t, axis=0), rate, atol=2e-3 * np.abs(rate).max())
    assert np.allclose(np.gradient(rate, t, axis=0)[1:-1], acceleration[1:-1], atol=5e-3 * np.abs(acceleration).max())

    dynamics = dynamics_of(robot)
    rates = dynamics.joint_rates(pose, rate)
    speed = np.abs(rates / limits.speed).max()
    push = np.abs(dynamics.joint_accelerations(pose, rate, acceleration) / limits.acceleration).max()
    effort = np.abs(dynamics.inverse(pose, rate, acceleration) / limits.effort).max()
    assert max(speed, push, effort) <= 1.001 and max(speed, push, effort) > 0.99
    q = robot.inverse(pose)
    way = (q - q[0]) @ (q[-1] - q[0]) / np.sum((q[-1] - q[0]) ** 2)
    assert np.allclose(q, q[0] + way[:, None] * (q[-1] - q[0]), atol=1e-9), "straight in joint space"


def test_weak_motors_take_longer():
    robot = make_robot("delta3")
    limits = drive_limits(robot)
    start, end = two_poses(robot)
    strong = point_to_point(robot, start, end, limits)
    weak = point_to_point(robot, start, end, limits._replace(effort=0.3 * limits.effort))
    assert weak.duration_s > 1.05 * strong.duration_s
    sample = weak.sample(np.linspace(0.0, weak.duration_s, 3001))
    share = np.abs(dynamics_of(robot).inverse(*sample) / (0.3 * limits.effort)).max()
    assert share == pytest.approx(1.0, abs=5e-3)
    with pytest.raises(MotionError, match="cannot even hold"):
        point_to_point(robot, start, end, limits._replace(effort=0.01 * limits.effort))


def test_out_of_reach_is_refused_and_staying_is_not():
    robot = make_robot("linear")
    limits = drive_limits(robot)
    with pytest.raises(MotionError, match="out of reach"):
        point_to_point(robot, robot.home, robot.home + 0.5, limits)
    stay = point_to_point(robot, robot.home, robot.home, limits)
    assert np.allclose(stay.sample(np.array([0.0, 1.0])).pose, robot.home)
