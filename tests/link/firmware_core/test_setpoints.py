"""Set-points: which are accepted, and how the joints get there."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.link.protocol.codes import Command, DriveKind, Flag, Refusal, State, TargetKind
from app.link.protocol.frames import encode_frame
from app.link.protocol.messages import Setpoint, pack
from tests.link.firmware_core.bench import Bench
from tests.support.tools import needs

pytestmark = needs("gcc")


@pytest.fixture
def board() -> Bench:
    return Bench("delta3", DriveKind.SERVO).make_ready()


def setpoints(board: Bench) -> np.ndarray:
    return np.array([telemetry.setpoint[: board.count] for telemetry in board.telemetry])


def test_joints_go_to_the_target_and_the_board_is_ready_again(board):
    target = board.towards(0.1)
    assert board.stream(target, 60).state == State.MOVING
    telemetry = board.run(110)
    assert telemetry.state == State.READY
    assert telemetry.setpoint[:3] == pytest.approx(target, abs=1e-6)
    assert board.joints == pytest.approx(target, abs=1e-5)


def test_a_pose_goes_where_the_robot_says(board):
    pose = (0.01, 0.005, -0.33)
    board.stream((*pose, 0.0), 200, kind=TargetKind.POSE)
    assert board.joints == pytest.approx(board.robot.inverse(pose), abs=2e-5)


def test_the_same_target_again_leaves_the_board_ready(board):
    assert board.stream(board.home, 200).state == State.READY


def test_in_as_much_time_as_the_last_two_were_apart(board):
    """20 ms apart: the way of the second one takes 20 ms, so that a stream makes one smooth motion."""
    board.forget()
    for k in range(1, 31):
        board.aim(board.towards(0.01 * k))
        board.run(20, alive=False)
    steps = np.diff(setpoints(board)[:, 0])[3:-1]
    np.testing.assert_allclose(steps, 0.01, atol=1e-4)


@pytest.mark.parametrize(("robot", "drive"), [("par4", DriveKind.DC), ("linear", DriveKind.STEPPER)])
def test_no_joint_exceeds_its_speed(robot, drive):
    board = Bench(robot, drive).make_ready()
    board.forget()
    limit = board.setting("speed", 0)
    target = board.towards(0.19 * limit)
    board.stream(target, 400)
    speeds = np.abs(np.diff(setpoints(board)[:, 0])) / 0.02
    assert speeds.max() == pytest.approx(limit, rel=1e-3)
    assert board.telemetry[-1].setpoint[0] == pytest.approx(target[0], abs=1e-6)


REFUSED = [
    ({"target": (math.nan, 0.0, 0.0, 0.0)}, Refusal.VALUE),
    ({"target": (0.0, 0.0, 0.0, math.inf)}, Refusal.VALUE),
    ({"target": (0.1597, 0.1597, 1.6, 0.0)}, Refusal.LIMIT),
    ({"target": (-0.8, 0.1597, 0.1597, 0.0)}, Refusal.LIMIT),
    ({"target": (1.2, 0.1597, 0.1597, 0.0)}, Refusal.JUMP),
    ({"target": (0.9, 0.0, -0.33, 0.0), "kind": TargetKind.POSE}, Refusal.REACH),
    ({"target": (0.0, 0.0, -0.22, 0.0), "kind": TargetKind.POSE}, Refusal.LIMIT),
    ({"target": (0.1, 0.0, -0.45, 0.0), "kind": TargetKind.POSE}, Refusal.JUMP),
]


@pytest.mark.parametrize(("wanted", "refusal"), REFUSED)
def test_a_refused_set_point_changes_nothing_but_the_refusal(board, wanted, refusal):
    before = board.telemetry[-1].setpoint
    assert board.refusal_of(**wanted) == refusal
    assert board.telemetry[-1].setpoint == before and board.telemetry[-1].state == State.READY
    board.run(200)
    assert board.telemetry[-1].refusal == refusal
    board.aim(board.home)
    board.run(40)
    assert board.telemetry[-1].refusal == Refusal.OK


@pytest.mark.parametrize(("kind", "flags"), [(2, 0), (0, 4)])
def test_fields_that_the_protocol_does_not_know_are_refused(board, kind, flags):
    payload = bytearray(pack(Setpoint(TargetKind.JOINTS, board.home), 1))
    payload[3], payload[4] = kind, flags
    board.core.receive(encode_frame(bytes(payload)))
    board.state()
    assert board.telemetry[-1].refusal == Refusal.VALUE


def test_a_target_on_its_limit_is_accepted_after_rounding():
    """pi/4 in floats of 4 bytes is a little more than pi/4."""
    low = Bench().setting("min", 0)
    board = Bench(joints=[low + 0.02] * 4).make_ready(homed=False)
    assert board.refusal_of((low - 5e-5,) * 4, manual=True) == Refusal.OK
    board.run(100)
    assert board.telemetry[-1].setpoint[0] >= np.float32(low)


@pytest.mark.parametrize(
    ("state", "refusal"),
    [("off", Refusal.NOT_ENABLED), ("stopped", Refusal.STOPPED), ("fault", Refusal.FAULT), ("homing", Refusal.BUSY)],
)
def test_set_points_need_a_board_that_is_ready(state, refusal):
    board = Bench("delta3", DriveKind.SERVO)
    if state != "off":
        board.make_ready(homed=False)
    board.estop = state == "fault"
    board.tick()
    if state == "stopped":
        board.order(Command.STOP)
    if state == "homing":
        board.order(Command.HOME)
    assert board.refusal_of(board.home) == refusal


def test_without_homing_only_joints_in_manual_mode():
    board = Bench("delta3", DriveKind.SERVO).make_ready(homed=False)
    target = board.towards(0.01)
    assert board.refusal_of(target) == Refusal.NOT_HOMED
    assert board.refusal_of((0.0, 0.0, -0.33), kind=TargetKind.POSE, manual=True) == Refusal.NOT_HOMED
    assert board.refusal_of(target, manual=True) == Refusal.OK
    assert board.telemetry[-1].flags & Flag.MANUAL


def test_without_homing_joints_are_as_slow_as_in_homing():
    board = Bench("delta3", DriveKind.SERVO).make_ready(homed=False)
    board.run(100)
    board.forget()
    board.stream(board.towards(0.5), 300, manual=True)
    speeds = np.abs(np.diff(setpoints(board)[:, 0])) / 0.02
    assert speeds.max() == pytest.approx(board.setting("home_speed") * board.setting("speed", 0), rel=1e-3)


@pytest.mark.parametrize("kind", TargetKind)
@pytest.mark.parametrize("limit", [0.05, 0.25])
@pytest.mark.parametrize("robot", ["delta3", "par4", "linear", "fivebar"])
def test_in_manual_mode_the_tool_keeps_its_speed_limit(robot, limit, kind):
    """A stream that asks for much more, in joints and in poses."""
    drive = {"delta3": DriveKind.SERVO, "par4": DriveKind.SERVO, "linear": DriveKind.STEPPER}.get(robot, DriveKind.DC)
    board = Bench(robot, drive)
    for joint in range(board.count):
        assert board.set("speed", 8.0, joint) == Refusal.OK
    board.make_ready()
    board.set("tool_speed", limit)
    board.run(200)
    board.forget()
    direction = np.array([0.8, 0.3, 0.0 if robot == "fivebar" else 0.4])
    for k in range(1, 26):
        pose = board.robot.home.copy()
        pose[:3] += direction * 0.0035 * k
        target = pose if kind == TargetKind.POSE else board.robot.inverse(pose)
        board.aim(tuple(target.tolist()), kind=kind, manual=True)
        board.run(10, alive=False)
    tools = board.robot.forward(setpoints(board))[:, :3]
    speeds = np.linalg.norm(np.diff(tools, axis=0), axis=1) / 0.02
    assert 0.9 * limit < speeds[2:].mean() and speeds.max() < 1.05 * limit


def test_pen_and_laser_follow_the_set_point(board):
    board.stream(board.towards(0.1), 30, pen_down=True, laser=51)
    assert board.outputs.pen_us == board.setting("pen_down") and board.outputs.laser == pytest.approx(0.2)
    assert {Flag.PEN_DOWN, Flag.LASER_ON} <= set(board.telemetry[-1].flags)
    board.stream(board.towards(0.1), 150, pen_down=True, laser=51)
    assert board.state() == State.READY
    assert board.outputs.pen_us == board.setting("pen_down") and board.outputs.laser == 0.0
