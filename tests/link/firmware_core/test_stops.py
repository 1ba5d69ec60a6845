"""What ends a motion: the watchdogs, and the controlled stop that they and the commands use."""

from __future__ import annotations

import numpy as np
import pytest

from app.link.protocol.codes import Command, DriveKind, Flag, Refusal, State, TestKind
from app.link.protocol.messages import Test
from tests.link.firmware_core.bench import STEP_MS, Bench
from tests.support.tools import needs

pytestmark = needs("gcc")


def cruising(drive: DriveKind = DriveKind.SERVO, **options) -> Bench:
    """Under way at 1 rad/s, with pen and laser on; the last set-point is 10 ms old."""
    board = Bench("delta3", drive).make_ready()
    for k in range(1, 16):
        board.aim(board.towards(0.01 * k), pen_down=True, laser=255, **options)
        board.run(10, alive=False)
    assert board.outputs.laser == 1.0
    return board


def test_set_points_that_stop_coming_hold_the_joints_within_200_ms():
    board = cruising()
    lost_us, still = board.now_us - 10_000, False
    while not still:
        before = list(board.joints)
        board.run(STEP_MS)
        still = board.joints == before
    held_us = board.now_us
    board.run(200)
    assert board.telemetry[-1].state == State.HELD
    assert board.joints == before
    assert held_us - lost_us < 200_000
    assert board.outputs.powered


def test_hold_comes_after_the_time_that_was_set():
    for hold_after in (20.0, 60.0, 150.0):
        board = Bench("delta3", DriveKind.SERVO)
        board.set("hold_after", hold_after)
        board.make_ready()
        board.aim(board.towards(0.7), laser=255)  # takes longer than that
        waited = 0
        while board.tick().laser or waited == 0:
            waited += STEP_MS
        assert hold_after - STEP_MS <= waited <= hold_after + STEP_MS
        assert board.state() == State.HELD


@pytest.mark.parametrize(("drive", "still_homed"), [(DriveKind.SERVO, False), (DriveKind.DC, True)])
def test_silence_switches_off_and_only_a_sensor_remembers(drive, still_homed):
    board = Bench("delta3", drive).make_ready()
    board.run(450, alive=False)
    assert board.outputs.powered
    telemetry = board.run(100, alive=False)
    assert telemetry.state == State.OFF and not board.outputs.powered
    assert bool(telemetry.flags & Flag.HOMED) == still_homed


@pytest.mark.parametrize("doing", ["homing", "testing"])
def test_homing_and_tests_need_signs_of_life(doing):
    board = Bench("delta3", DriveKind.DC, joints=[0.6] * 3).make_ready(homed=doing == "testing")
    if doing == "homing":
        board.order(Command.HOME)
    else:
        assert board.ask(Test(TestKind.PULSE, 0, 0.05, 2000)).result == Refusal.OK
    board.run(200)
    assert board.telemetry[-1].state in (State.HOMING, State.TESTING)
    assert board.run(140, alive=False).state == State.HELD


@pytest.mark.parametrize(
    ("command", "state"), [(Command.STOP, State.STOPPED), (Command.HALT, State.READY), (None, State.HELD)]
)
def test_a_controlled_stop_runs_out_straight_within_stop_time(command, state):
    board = cruising()
    board.aim(board.towards(0.5), pen_down=True, laser=255)
    board.run(30, alive=False)
    if command is None:
        while board.telemetry[-1].state == State.MOVING:
            board.run(STEP_MS)
    speed = board.setting("speed", 0)
    start = board.joints[0]
    if command:
        assert board.order(command) == Refusal.OK
    way = [board.joints[0]]
    for _ in range(14):
        board.run(STEP_MS)
        way.append(board.joints[0])
    assert board.telemetry[-1].state == state and board.outputs.laser == 0.0
    assert board.telemetry[-1].flags & Flag.PEN_DOWN
    steps = np.diff(way)
    assert np.all(np.diff(steps) <= 1e-6) and np.all(steps >= -1e-6)
    assert steps[10:] == pytest.approx(np.zeros(4), abs=1e-6)
    if command:  # half of what full speed would have done in 50 ms
        assert way[-1] - start == pytest.approx(speed * 0.05 / 2, rel=0.02)
    assert board.joints[1:] == pytest.approx(board.home[1:], abs=1e-5)


def test_a_joint_that_would_leave_its_limits_stops_there():
    board = Bench("delta3", DriveKind.SERVO).make_ready()
    highest = board.setting("max", 0)
    while board.joints[0] < highest - 0.01:
        board.aim((min(board.joints[0] + 0.15, highest), *board.home[1:]))
        board.run(10, alive=False)
    assert board.order(Command.STOP) == Refusal.OK
    board.run(100)
    assert board.joints[0] <= highest + 1e-5


def test_nothing_resumes_by_itself():
    board = cruising()
    board.order(Command.STOP)
    assert board.refusal_of(board.towards(0.15)) == Refusal.STOPPED
    board.order(Command.CLEAR)
    joints = list(board.joints)
    board.run(300)
    assert board.state() == State.READY and board.joints == pytest.approx(joints, abs=0.05)
    held = cruising()
    held.run(150)
    assert held.refusal_of(held.towards(0.1)) == Refusal.HELD
    assert held.order(Command.FOLLOW) == Refusal.OK
    assert held.state() == State.READY


def test_after_a_halt_the_next_set_point_takes_over():
    board = cruising()
    board.order(Command.HALT)
    board.stream(board.towards(0.1), 100)
    assert board.joints[0] == pytest.approx(board.home[0] + 0.1, abs=1e-5)


def test_power_off_lifts_the_pen_and_cuts_everything():
    board = cruising()
    board.order(Command.OFF)
    board.tick()
    assert board.outputs == (False, (0.0,) * 4, board.setting("pen_up"), 0.0)
