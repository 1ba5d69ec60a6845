"""Homing: each kind of drive finds its home, or says which joint did not."""

from __future__ import annotations

import pytest

from app.link.firmware.generate import BUILDS
from app.link.protocol.codes import Command, DriveKind, Fault, Flag, Refusal, State, TargetKind
from tests.link.firmware_core.bench import Bench
from tests.support.tools import needs

pytestmark = needs("gcc")

STEPPER_ERROR_M = 0.3 * 0.18 * 0.005 + 2.5e-5
"""The way that a carriage makes between two looks at its switch, and a step."""


def near_home(robot: str, drive: DriveKind) -> Bench:
    home = Bench(robot, drive).home
    return Bench(robot, drive, joints=[q + (0.02 if robot == "linear" else 0.2) for q in home])


@pytest.mark.parametrize(("robot", "drive"), BUILDS)
def test_every_build_homes_and_stands_where_the_robot_says(robot, drive):
    board = near_home(robot, drive).make_ready()
    tolerance = STEPPER_ERROR_M if drive == DriveKind.STEPPER else 0.02
    assert board.joints == pytest.approx(board.home, abs=tolerance)
    pose = (*board.robot.home.tolist(), 0.0)[:4]
    board.stream(pose, 200, kind=TargetKind.POSE)
    assert board.telemetry[-1].state == State.READY
    assert board.telemetry[-1].setpoint[: board.count] == pytest.approx(board.home, abs=2e-5)


def test_joints_go_home_at_the_speed_of_homing():
    board = Bench("delta3", DriveKind.DC, joints=[0.8] * 3).make_ready(homed=False)
    board.order(Command.HOME)
    board.run(20)
    board.forget()
    board.run(200)
    moved = board.telemetry[0].setpoint[0] - board.telemetry[-1].setpoint[0]
    speed = board.setting("home_speed") * board.setting("speed", 0)
    assert moved == pytest.approx(0.2 * speed, rel=1e-3)
    assert board.telemetry[-1].state == State.HOMING


def test_the_pen_goes_up_and_the_robot_is_not_homed_until_the_end():
    board = Bench("linear", DriveKind.STEPPER, joints=[0.01] * 3).make_ready()
    board.stream(board.home, 20, pen_down=True)
    assert board.outputs.pen_us == board.setting("pen_down")
    board.order(Command.HOME)
    telemetry = board.run(40)
    assert telemetry.state == State.HOMING and not telemetry.flags & Flag.HOMED
    assert board.outputs.pen_us == board.setting("pen_up")


def test_steppers_learn_where_they_are_from_their_switches():
    """They begin somewhere and believe it is the lower limit."""
    board = Bench("linear", DriveKind.STEPPER, joints=[0.03, 0.0, 0.06])
    assert board.run(20).position[:3] == (0.0, 0.0, 0.0)
    board.make_ready()
    assert board.telemetry[-1].position[:3] == pytest.approx(board.joints, abs=STEPPER_ERROR_M)
    assert board.joints == pytest.approx(board.home, abs=STEPPER_ERROR_M)


def test_a_switch_that_does_not_close_is_a_fault_after_1_2_of_the_range():
    board = Bench("linear", DriveKind.STEPPER, joints=[0.01] * 3)
    board.no_switches, board.switches = True, 0b101
    for joint in range(3):
        board.set("home", 0.02, joint)
        board.set("max", 0.05, joint)
    board.make_ready(homed=False)
    board.order(Command.HOME)
    travel_ms = 1000 * 1.2 * 0.05 / (board.setting("home_speed") * board.setting("speed", 0))
    assert board.run(travel_ms - 30).state == State.HOMING
    telemetry = board.run(60)
    assert (telemetry.state, telemetry.fault, telemetry.fault_joint) == (State.FAULT, Fault.HOMING, 2)


def test_a_joint_that_does_not_come_home_is_a_fault_after_20_s():
    board = Bench("delta3", DriveKind.DC, joints=[0.3, 0.3, 0.3])
    board.set("following", 3.0)
    board.stuck = {1}
    board.make_ready(homed=False)
    board.order(Command.HOME)
    assert board.run(19_900).state == State.HOMING
    telemetry = board.run(200)
    assert (telemetry.state, telemetry.fault, telemetry.fault_joint) == (State.FAULT, Fault.HOMING, 2)


def test_stop_during_homing_leaves_the_robot_not_homed():
    board = Bench("delta3", DriveKind.DC, joints=[0.8] * 3).make_ready(homed=False)
    board.order(Command.HOME)
    board.run(200)
    assert board.order(Command.STOP) == Refusal.OK
    telemetry = board.run(200)
    assert telemetry.state == State.STOPPED and not telemetry.flags & Flag.HOMED
    assert board.speeds[0] == pytest.approx(0.0, abs=0.05)
