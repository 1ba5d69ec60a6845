"""The whole trajectory: on the strokes, within reach and limits, at rest where it should be."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.drawing.toolpath import PenSettings, Placement, Toolpath, default_placement, plan, plan_toolpath, sample
from app.robots import ROBOTS, Robot, make_robot
from app.robots.limits import rate_limits
from app.robots.robot import Array
from tests.drawing.toolpath.shapes import circle, distances, dot, every_kind, length, line, random_strokes, spiral

MADE = {name: make_robot(name) for name in ROBOTS}


def check_safe(path: Toolpath, robot: Robot) -> None:
    """Reach, limits and rest, all recomputed from the poses."""
    assert robot.reachable(path.pose).all()
    assert (path.q == robot.inverse(path.pose)).all()
    assert np.allclose(np.diff(path.t), 1e-3) and path.t[0] == 0.0 and path.duration_s == path.t[-1]
    assert (path.pose[:, 3:] == 0.0).all()
    limits = rate_limits(robot)
    q = np.concatenate([path.q[:1], path.q, path.q[-1:]])
    speed = np.abs(np.diff(q, axis=0) / 1e-3 / limits.speed).max()
    acceleration = np.abs(np.diff(q, n=2, axis=0) / 1e-6 / limits.acceleration).max()
    assert speed <= 1.0 and path.max_joint_speed_ratio == pytest.approx(speed)
    assert acceleration <= 1.0 and path.max_joint_acceleration_ratio == pytest.approx(acceleration)


def check_drawn(path: Toolpath, strokes: list[Array], placement: Placement, lift_mm: float) -> None:
    """Every stroke within 0.1 mm and nothing left out; the pen down on them, on the very paper, and up elsewhere."""
    drawn = path.stroke >= 0
    assert (path.pose[drawn, 2] == placement.height_m).all() and path.pen[drawn].all()
    assert path.pose[[0, -1], 2] == pytest.approx(placement.height_m + 1e-3 * lift_mm)
    assert not path.pen[[0, -1]].any()
    assert path.stroke[drawn].tolist() == sorted(path.stroke[drawn].tolist())
    for number, stroke in enumerate(strokes):
        vertices, traced = placement.on_table(stroke), path.pose[path.stroke == number, :2]
        assert len(traced)
        assert distances(traced[::3], vertices).max() <= 0.1e-3
        assert distances(vertices, traced).max() <= 0.1e-3
        assert np.allclose(traced[[0, -1]], vertices[[0, -1]], atol=1e-9)


@pytest.mark.parametrize("name", ROBOTS)
def test_every_kind_of_stroke(name: str):
    robot, strokes = MADE[name], every_kind()
    placement = default_placement(robot)
    path = plan_toolpath(strokes, robot, placement)
    check_safe(path, robot)
    check_drawn(path, strokes, placement, 2.0 if name == "fivebar" else 4.0)
    up = path.stroke < 0
    assert not path.pen[up].any() and (path.pose[up, 2] > placement.height_m).all()
    assert path.stray_ink_mm == 0.0
    low = path.pose[:, 2] < placement.height_m + 0.99e-3
    moved = np.hypot(*np.diff(path.pose[:, :2], axis=0).T)
    assert moved[(low[1:] & low[:-1]) & (up[1:] & up[:-1])].max() <= 1e-9
    assert path.speed_m_s[path.pen].max() <= 0.080 * (1 + 1e-6)
    assert path.speed_m_s[[0, -1]].tolist() == [0.0, 0.0]


@settings(max_examples=15)
@given(
    seed=st.integers(0, 2**32 - 1),
    name=st.sampled_from(list(ROBOTS)),
    speed=st.sampled_from([20.0, 80.0, 300.0, 1500.0]),
    up_speed=st.sampled_from([60.0, 300.0, 1500.0]),
    lift_mm=st.sampled_from([0.5, 1.0, 4.0, 8.0]),
    lift=st.booleans(),
)
def test_random_drawings(seed: int, name: str, speed: float, up_speed: float, lift_mm: float, lift: bool):
    rng, robot = np.random.default_rng(seed), MADE[name]
    strokes = random_strokes(rng, int(rng.integers(1, 6)))
    around = default_placement(robot)
    placement = Placement(around.height_m, around.centre_m, float(rng.uniform(0.0, 2 * np.pi)))
    path = plan_toolpath(strokes, robot, placement, PenSettings(speed, up_speed, lift_mm, lift))
    check_safe(path, robot)
    check_drawn(path, strokes, placement, lift_mm)


def test_hundreds_of_short_strokes_and_one_long_line():
    robot = MADE["delta3"]
    placement = default_placement(robot)
    y = np.linspace(-60.0, 60.0, 300)
    strokes = [line((-60.0, v), (-59.0 + 0.01 * v, v + 0.3)) for v in y] + [line((-100.0, -140.0), (100.0, 140.0))]
    path = plan_toolpath(strokes, robot, placement)
    check_safe(path, robot)
    check_drawn(path, strokes, placement, 4.0)


@pytest.mark.parametrize("name", ROBOTS)
def test_without_a_lift_every_travel_is_drawn(name: str):
    robot, strokes = MADE[name], every_kind()
    placement = default_placement(robot)
    path = plan_toolpath(strokes, robot, placement, PenSettings(lift=False))
    check_safe(path, robot)
    check_drawn(path, strokes, placement, 4.0)
    travels = [np.hypot(*(after[0] - before[-1])) for before, after in pairwise(strokes)]
    assert path.stray_ink_mm == pytest.approx(sum(travels), abs=1e-6)
    assert sum(travels) > 100.0
    down = np.flatnonzero(path.pen)
    assert np.array_equal(down, np.arange(down[0], down[-1] + 1))
    assert (path.pose[path.pen, 2] == placement.height_m).all()


@pytest.mark.parametrize("name", ROBOTS)
def test_more_speed_never_takes_longer(name: str):
    robot, strokes = MADE[name], random_strokes(np.random.default_rng(5), 6)
    placement = default_placement(robot)
    speeds = (10.0, 20.0, 40.0, 80.0, 320.0, 1000.0)
    pen = [plan_toolpath(strokes, robot, placement, PenSettings(speed_mm_s=speed)).duration_s for speed in speeds]
    up = [plan_toolpath(strokes, robot, placement, PenSettings(up_speed_mm_s=speed)).duration_s for speed in speeds]
    assert pen[0] > 1.5 * pen[2] and up[0] > 1.5 * up[2]
    for times in (pen, up):
        assert all(after <= before for before, after in pairwise(times))


def test_a_long_line_takes_its_length_over_its_speed():
    robot = MADE["linear"]
    path = plan_toolpath([line((-60.0, 0.0), (60.0, 0.0))], robot, default_placement(robot))
    drawing = 1e-3 * (np.count_nonzero(path.pen) - 1)
    assert 120.0 / 80.0 <= drawing <= 120.0 / 80.0 + 0.05
    assert np.mean(path.speed_m_s[path.pen] > 0.0799) > 0.95


def test_a_dot_is_a_pause_of_the_pen():
    robot = MADE["par4"]
    path = plan_toolpath([dot(3.0, 4.0)], robot, default_placement(robot))
    assert 0.03 <= 1e-3 * np.count_nonzero(path.pen) <= 0.1
    assert np.ptp(path.pose[path.pen], axis=0).max() == 0.0


def test_the_speed_is_that_of_the_tool():
    robot = MADE["delta3"]
    path = plan_toolpath([spiral(3.0, 4.0)], robot, default_placement(robot))
    inked = 1e3 * float(path.speed_m_s[path.pen].sum()) * 1e-3
    assert inked == pytest.approx(length(spiral(3.0, 4.0)), rel=5e-3)


def test_playback_between_and_beyond_the_samples():
    robot = MADE["delta3"]
    path = plan_toolpath([circle(10.0), dot(0.0, 0.0)], robot, default_placement(robot))
    at = sample(path, path.t)
    assert np.allclose(at.pose, path.pose, atol=1e-15) and np.allclose(at.q, path.q, atol=1e-15)
    assert np.array_equal(at.pen, path.pen) and np.array_equal(at.stroke, path.stroke)
    halfway = sample(path, path.t[:-1] + 0.5e-3)
    assert np.allclose(halfway.q, robot.inverse(halfway.pose), atol=1e-5)
    for t, end in ((-5.0, 0), (1e6, -1)):
        beyond = sample(path, t)
        assert np.array_equal(beyond.pose, path.pose[end]) and beyond.pen == path.pen[end]


def test_slowing_down_whole_strokes_keeps_the_limits_too(monkeypatch: pytest.MonkeyPatch):
    """The last resort, which the usual drawings do not need."""
    monkeypatch.setattr(plan, "LOCAL_ROUNDS", 0)
    robot = MADE["par4"]
    for seed in range(6):
        strokes = random_strokes(np.random.default_rng(seed), 5)
        check_safe(plan_toolpath(strokes, robot, default_placement(robot), PenSettings(300.0)), robot)


def test_the_same_drawing_is_planned_the_same_way():
    robot, strokes = MADE["fivebar"], random_strokes(np.random.default_rng(9), 6)
    one, two = (plan_toolpath(strokes, robot, default_placement(robot)) for _ in range(2))
    assert np.array_equal(one.q, two.q)
