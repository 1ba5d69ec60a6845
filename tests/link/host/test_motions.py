"""Motions alone: how smooth, how far, how fast."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.link.errors import LinkError
from app.link.motions.axis import JogMotion, StepMotion
from app.link.motions.bounds import TOOL_SPEED, Bounds, bounds_of
from app.link.motions.course import Course, check_program
from app.link.motions.mirror import MirrorMotion
from app.link.motions.motion import Motion
from app.link.programs import Jog, Program
from app.robots import ROBOTS, make_robot

DT = 0.01
BOUNDS = {name: bounds_of(make_robot(name), {}, homed=True) for name in ROBOTS}


def at_home(bounds: Bounds) -> tuple[float, ...]:
    return tuple(bounds.robot.inverse(bounds.robot.home).tolist())


def drive(motion: Motion, seconds: float, share: float = 1.0, dt: float = DT) -> np.ndarray:
    """(k, n) targets, until the end or for so long."""
    targets = []
    for _ in range(round(seconds / dt)):
        targets.append(motion.advance(dt, share).joints)
        if motion.finished:
            break
    return np.array(targets)


def until_blocked(motion: JogMotion) -> np.ndarray:
    """(k, n) targets, until some moments after it has come to rest in front of something."""
    targets, blocked = [], 0
    while blocked < 5:
        targets.append(motion.advance(DT, 1.0).joints)
        blocked += bool(motion.notice)
        assert len(targets) < 10_000
    return np.array(targets)


def tool(bounds: Bounds, joints: np.ndarray) -> np.ndarray:
    """(k - 1,) m/s"""
    return np.linalg.norm(np.diff(bounds.robot.forward(joints)[:, :3], axis=0), axis=1) / DT


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("space", ["joint", "pose"])
def test_a_jog_comes_to_rest_at_the_edge_and_never_leaves(name, space):
    bounds = BOUNDS[name]
    axes = (0,) if space == "joint" else range(bounds.robot.dof)
    for axis in axes:
        for direction in (1, -1):
            motion = JogMotion(bounds, Jog(space, axis, direction, 50.0), at_home(bounds))
            joints = until_blocked(motion)
            limits = bounds.robot.joint_limits
            assert (joints >= limits[:, 0]).all() and (joints <= limits[:, 1]).all()
            assert (np.abs(np.diff(joints, axis=0)) <= DT * np.array(bounds.speed) * 1.0001).all()
            assert tool(bounds, joints).max() <= TOOL_SPEED
            assert np.ptp(joints[-5:], axis=0).max() < 1e-9


@settings(max_examples=30)
@given(size=st.floats(1e-5, 0.05), speed=st.floats(0.01, 1.0), dt=st.sampled_from([0.005, 0.01, 0.027]))
def test_a_step_ends_exactly_where_it_should(size, speed, dt):
    bounds = BOUNDS["delta3"]
    motion = StepMotion(bounds, Jog("pose", 2, -1, speed), size, at_home(bounds))
    joints = drive(motion, 120.0, dt=dt)
    pose = bounds.robot.forward(joints)
    assert motion.finished
    assert pose[-1] == pytest.approx(bounds.robot.home - [0.0, 0.0, size], abs=1e-9)
    assert (np.diff(pose[:, 2]) <= 1e-12).all()  # never back
    fastest = np.abs(np.diff(pose[:, 2], prepend=bounds.robot.home[2])).max() / dt
    assert fastest <= 1.6 * min(speed, TOOL_SPEED)  # the last bit is less than two set-points' way


def test_a_jog_speeds_up_smoothly():
    bounds = BOUNDS["delta3"]
    motion = JogMotion(bounds, Jog("pose", 0, 1, 0.2), at_home(bounds))
    x = bounds.robot.forward(drive(motion, 0.5))[:, 0]
    acceleration = np.diff(x, 2) / DT**2
    assert np.abs(acceleration).max() < 1.0
    assert np.diff(x)[-1] / DT == pytest.approx(0.2, rel=1e-6)


def test_another_direction_is_taken_after_braking():
    bounds = BOUNDS["delta3"]
    motion = JogMotion(bounds, Jog("pose", 0, 1, 0.2), at_home(bounds))
    before = drive(motion, 0.5)
    motion.renew(Jog("pose", 1, 1, 0.2))
    pose = bounds.robot.forward(np.vstack([before, drive(motion, 0.8)]))
    assert np.abs(np.diff(pose[:, :2], 2, axis=0)).max() / DT**2 < 1.0
    assert pose[-1, 1] > 0.05
    assert np.diff(pose[-10:, 0]) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("name", ROBOTS)
def test_a_step_beyond_the_edge_is_refused_before_it_moves(name):
    bounds = BOUNDS[name]
    with pytest.raises(LinkError, match="no room for that step"):
        StepMotion(bounds, Jog("pose", 2, -1, 0.1), 2.0, at_home(bounds))


@pytest.mark.parametrize(
    "jog", [Jog("joint", 9, 1, 0.1), Jog("pose", 3, 1, 0.1), Jog("joint", 0, 2, 0.1), Jog("joint", 0, 1, math.nan)]
)
def test_an_axis_that_there_is_not(jog):
    with pytest.raises(LinkError, match="choose one"):
        JogMotion(BOUNDS["delta3"], jog, at_home(BOUNDS["delta3"]))


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("share", [1.0, 0.1])
def test_a_mirrored_pose_is_followed_slowly_to_the_nearest_one_in_reach(name, share):
    bounds = BOUNDS[name]
    robot = bounds.robot
    goal = robot.home.copy()
    goal[:3] += [0.05, 0.08, -0.9]  # far below the reach
    motion = MirrorMotion(bounds, tuple(goal), at_home(bounds))
    joints = drive(motion, (8.0 if name == "fivebar" else 3.0) / share, share)
    assert tool(bounds, joints).max() <= share * TOOL_SPEED
    assert (np.abs(np.diff(joints, axis=0)) <= DT * np.array(bounds.speed) * 1.0001).all()
    assert robot.forward(joints[-1])[:3] == pytest.approx(robot.nearest(goal)[:3], abs=0.01)


def test_a_hand_that_turns_back_is_followed_back():
    bounds = BOUNDS["delta3"]
    motion = MirrorMotion(bounds, (0.1, 0.0, -0.33), at_home(bounds))
    drive(motion, 0.3)
    motion.follow((0.0, 0.0, -0.33))
    joints = drive(motion, 2.0)
    assert bounds.robot.forward(joints[-1]) == pytest.approx([0.0, 0.0, -0.33], abs=1e-5)


def line(name: str, way: float, seconds: float, count: int = 101) -> Program:
    """Joint 1 from home by `way` and back, smoothly."""
    t = np.linspace(0.0, seconds, count)
    q = np.tile(at_home(BOUNDS[name]), (count, 1))
    q[:, 0] += way * np.sin(np.pi * t / seconds) ** 2
    return Program("line", name, t, q, np.zeros(count, dtype=bool), np.zeros(count))


def test_a_program_begins_with_a_slow_way_with_the_pen_up():
    bounds = BOUNDS["delta3"]
    program = line("delta3", 0.2, 2.0)
    program = Program("line", "delta3", program.t, program.q, ~program.pen_down, program.laser + 0.5)
    course = Course(program, bounds)
    start = tuple(q - 0.5 for q in at_home(bounds))
    course.begin(start)
    targets = []
    while not course.progress:
        targets.append(course.advance(DT, 1.0))
    assert not any(target.pen_down or target.laser for target in targets[:-1])
    assert all(target.manual for target in targets[:-1])
    joints = np.array([start, *(target.joints for target in targets)])
    assert tool(bounds, joints).max() <= TOOL_SPEED
    assert np.abs(np.diff(joints, axis=0)).max() / DT <= 0.5 * min(bounds.speed)
    assert joints[-2] == pytest.approx(program.q[0])


@pytest.mark.parametrize("share", [1.0, 0.5, 0.05])
def test_the_override_stretches_time(share):
    course = Course(line("delta3", 0.2, 2.0), BOUNDS["delta3"])
    course.begin(at_home(BOUNDS["delta3"]))
    took = DT * len(drive(course, 100.0, share))
    assert took == pytest.approx((0.3 + 2.0) / share, abs=0.6)


def test_a_program_that_is_too_fast_runs_slower():
    bounds = BOUNDS["par4"]
    program = line("par4", 0.5, 0.1)
    course = Course(program, bounds)
    assert course.pace == pytest.approx(4.0 / (np.abs(np.diff(program.q[:, 0])).max() / np.diff(program.t)[0]))
    course.begin(at_home(bounds))
    assert np.abs(np.diff(drive(course, 10.0), axis=0)).max() / DT <= 4.0 * 1.001


@pytest.mark.parametrize(
    ("program", "says"),
    [
        (line("par4", 0.1, 1.0), "is for par4, the robot on the cable is delta3"),
        (line("delta3", 2.0, 9.0), r"After \d\.\d s the program takes joint 1 to 9\d\.\d deg, outside"),
        (line("delta3", 0.5, 0.01), "times as fast as it can go"),
    ],
)
def test_a_program_that_the_robot_cannot_run_is_refused(program, says):
    with pytest.raises(LinkError, match=says):
        check_program(program, BOUNDS["delta3"])


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"t": np.array([0.0, 0.0])}, "increase"),
        ({"t": np.array([1.0, 2.0])}, "begin at 0"),
        ({"q": np.array([[0.0] * 3, [math.nan] * 3])}, "not finite"),
        ({"laser": np.zeros(3)}, "at least two moments"),
    ],
)
def test_a_table_that_is_no_program(change, says):
    parts = {"t": np.array([0.0, 1.0]), "q": np.zeros((2, 3)), "pen_down": np.zeros(2, bool), "laser": np.zeros(2)}
    with pytest.raises(LinkError, match=says):
        Program("p", "delta3", **{**parts, **change})


def test_before_homing_joints_creep():
    known = {46: 0.3, **{10 * joint + 6: 2.0 for joint in range(3)}}
    assert bounds_of(make_robot("delta3"), known, homed=False).speed == pytest.approx((0.6,) * 3)
    assert bounds_of(make_robot("delta3"), known, homed=True).speed == pytest.approx((2.0,) * 3)
