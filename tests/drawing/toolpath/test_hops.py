"""Up, across, down: clear of the paper, within the joints' limits, quick."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.toolpath.hops import Hops, between, find_pace, pose_at
from app.drawing.toolpath.placement import default_placement
from app.robots import ROBOTS, Robot, make_robot
from app.robots.limits import rate_limits
from app.robots.robot import Array

LIFT_M = 0.004


def some_hops(robot: Robot, count: int, *, lift: bool = True) -> Hops:
    """From stroke to stroke over 0.05 to 60 mm around the middle of the sheet, median 3 mm."""
    placement, rng = default_placement(robot), np.random.default_rng(3)
    starts = rng.uniform(-0.045, 0.045, (count, 2))
    way = np.minimum(3e-3 * np.exp(rng.normal(0.0, 1.2, count)), 0.06)
    turn = rng.uniform(0.0, 2 * np.pi, count)
    stops = np.clip(
        np.roll(starts, -1, axis=0) + way[:, None] * np.column_stack([np.cos(turn), np.sin(turn)]), -0.045, 0.045
    )
    middle = np.array(placement.centre_m)
    return between(starts + middle, stops + middle, placement.height_m, LIFT_M, lift=lift)


def fine_samples(hops: Hops, robot: Robot) -> tuple[Array, Array, Array]:
    """Times (h, s), joints (h, s, n) and poses (h, s, dof) at 0.2 % of each hop."""
    pace = find_pace(hops, robot, rate_limits(robot), 0.3)
    count = len(hops.start)
    t = pace.total[:, None] * np.linspace(0.0, 1.0, 501)
    pose = pose_at(hops, pace, np.repeat(np.arange(count), 501), t.ravel(), robot)
    return t, robot.inverse(pose).reshape(count, 501, -1), pose.reshape(count, 501, -1)


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("lift", [True, False])
def test_ends_and_clearance(name: str, lift: bool):
    robot = make_robot(name)
    hops = some_hops(robot, 40, lift=lift)
    _, _, pose = fine_samples(hops, robot)
    assert np.allclose(pose[:, 0, :2], hops.start, atol=1e-12) and np.allclose(pose[:, -1, :2], hops.stop, atol=1e-12)
    height = pose[..., 2] - hops.paper
    assert np.allclose(height[1:, 0], 0.0, atol=1e-12) and np.allclose(height[:-1, -1], 0.0, atol=1e-12)
    assert height[0, 0] == pytest.approx(LIFT_M) and height[-1, -1] == pytest.approx(LIFT_M)
    if not lift:
        assert np.allclose(height[1:-1], 0.0, atol=1e-12)
        return
    assert np.allclose(height.max(axis=1), LIFT_M) and height.min() >= -1e-12
    across = np.hypot(*np.diff(pose[..., :2], axis=1).transpose(2, 0, 1)) > 1e-9
    low = np.minimum(height[:, 1:], height[:, :-1]) < 0.99e-3
    assert not (across & low).any()


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("lift", [True, False])
def test_joint_limits_hold_between_the_samples_too(name: str, lift: bool):
    robot = make_robot(name)
    limits = rate_limits(robot)
    t, q, pose = fine_samples(some_hops(robot, 40, lift=lift), robot)
    step = (t[:, 1] - t[:, 0])[:, None, None]
    assert (np.abs(np.diff(q, axis=1)) / step / limits.speed).max() <= 1.01
    assert (np.abs(np.diff(q, n=2, axis=1)) / step**2 / limits.acceleration).max() <= 1.05
    assert (np.linalg.norm(np.diff(pose[..., :2], axis=1), axis=2) / step[..., 0]).max() <= 0.3 * (1 + 1e-6)


@pytest.mark.parametrize("name", ["par4", "delta3", "linear"])
def test_a_hop_of_a_few_millimetres_takes_a_seventh_of_a_second(name: str):
    robot = make_robot(name)
    pace = find_pace(some_hops(robot, 180), robot, rate_limits(robot), 0.3)
    assert np.median(pace.total[1:-1]) <= 0.140
    assert np.mean(pace.total[1:-1]) <= 0.165


def test_all_hops_at_once_are_each_on_its_own():
    robot = make_robot("par4")
    hops, limits = some_hops(robot, 12), rate_limits(robot)
    together = find_pace(hops, robot, limits, 0.3)
    for i in range(len(hops.start)):
        rows = slice(i, i + 1)
        alone = Hops(hops.start[rows], hops.stop[rows], hops.rise[rows], hops.fall[rows], hops.paper)
        assert find_pace(alone, robot, limits, 0.3).total[0] == pytest.approx(together.total[i])


def test_a_lift_below_the_clearance_moves_straight_up_across_and_down():
    robot = make_robot("delta3")
    hops = between(np.array([[0.0, 0.0], [0.02, 0.0]]), np.array([[0.01, 0.0], [0.03, 0.0]]), -0.34, 0.0008, lift=True)
    _, _, pose = fine_samples(hops, robot)
    across = np.abs(np.diff(pose[1, :, 0])) > 1e-9
    assert np.allclose(pose[1, 1:, 2][across], -0.34 + 0.0008, atol=1e-7)
