"""Tests of one drive: voltage pulses and set-point steps."""

from __future__ import annotations

import itertools
import math

import pytest

from app.control.sampled_pid import Sampling, sampled_pid
from app.link.firmware.generate import GAINS
from app.link.protocol.codes import Command, DriveKind, Refusal, State, TestKind
from app.link.protocol.messages import Test
from tests.link.firmware_core.bench import STEP_MS, Bench
from tests.support.tools import needs

pytestmark = needs("gcc")


@pytest.fixture
def board() -> Bench:
    return Bench("delta3", DriveKind.DC).make_ready()


def test_a_pulse_is_a_constant_share_of_the_supply(board):
    assert board.ask(Test(TestKind.PULSE, 1, 0.3, 200)).result == Refusal.OK
    drives = []
    while board.tick().drive[1] == pytest.approx(0.3) or not drives:
        board.run(0)
        drives.append(board.outputs.drive[1])
        board.ask(Test(TestKind.PULSE, 1, 0.3, 200), board._number)  # a sign of life that changes nothing
    assert len(drives) * STEP_MS == pytest.approx(200, abs=STEP_MS)
    assert board.state() == State.READY
    assert [sample.joint for sample in board.samples] == [1] * len(board.samples)
    assert [sample.drive for sample in board.samples] == pytest.approx([0.3] * len(board.samples))
    times = [sample.t_us for sample in board.samples]
    assert {later - earlier for earlier, later in itertools.pairwise(times)} == {5000}
    assert board.samples[-1].position - board.samples[0].position > 0.2


def test_after_a_pulse_the_joint_stays_where_it_is(board):
    board.ask(Test(TestKind.PULSE, 0, 0.2, 100))
    board.run(110)
    end = board.joints[0]
    board.run(600)
    assert board.state() == State.READY
    assert board.joints[0] == pytest.approx(end, abs=0.1)
    assert board.telemetry[-1].setpoint[0] == pytest.approx(board.joints[0], abs=0.01)


def test_a_pulse_towards_the_limit_ends_inside(board):
    board.ask(Test(TestKind.PULSE, 0, -0.4, 5000))
    assert board.run(2000).state == State.READY
    assert board.joints[0] > board.setting("min", 0)


def test_a_step_moves_the_set_point_at_once_and_keeps_it(board):
    before = board.telemetry[-1].setpoint[0]
    assert board.ask(Test(TestKind.STEP, 0, 0.3, 400)).result == Refusal.OK
    board.run(20)
    assert board.telemetry[-1].setpoint[0] == pytest.approx(before + 0.3)
    telemetry = board.run(500)
    assert telemetry.state == State.READY and telemetry.setpoint[0] == pytest.approx(before + 0.3)
    assert board.joints[0] == pytest.approx(before + 0.3, abs=0.02)


def test_the_step_response_is_that_of_the_control_lab(board):
    """The samples of a step against the same PID and motor, computed here."""
    board.run(2000)
    start, setpoint = board.joints[0], board.telemetry[-1].setpoint[0] + 0.2
    law = sampled_pid(GAINS["delta3"], Sampling(STEP_MS * 1e-3, "backward Euler", "clamping"), 6.0, start)
    model = Bench("delta3", DriveKind.DC, joints=[start] * 3)
    board.ask(Test(TestKind.STEP, 0, 0.2, 300))
    board.run(300)
    for sample in board.samples[:50]:
        assert sample.position == pytest.approx(model.joints[0], abs=2e-3)
        volts = law(setpoint, model.joints[0])
        assert sample.drive == pytest.approx(volts / 6.0, abs=0.02)
        model._turn_motor(0, volts)


REFUSED = [
    (Test(TestKind.PULSE, 3, 0.1, 100), Refusal.UNKNOWN),
    (Test(TestKind.PULSE, 0, 1.01, 100), Refusal.VALUE),
    (Test(TestKind.PULSE, 0, math.nan, 100), Refusal.VALUE),
    (Test(TestKind.PULSE, 0, 0.1, 0), Refusal.VALUE),
    (Test(TestKind.PULSE, 0, 0.1, 5001), Refusal.VALUE),
    (Test(TestKind.STEP, 0, 0.36, 100), Refusal.VALUE),
]


@pytest.mark.parametrize(("test", "refusal"), REFUSED)
def test_what_is_refused(board, test, refusal):
    assert board.ask(test).result == refusal
    assert board.state() == State.READY


def test_a_test_needs_home_room_and_a_motor_with_a_sensor():
    board = Bench("delta3", DriveKind.DC, joints=[0.3, 0.3, -0.75])
    pulse, step = Test(TestKind.PULSE, 2, 0.1, 100), Test(TestKind.STEP, 0, -0.3, 100)
    assert board.ask(pulse).result == Refusal.NOT_ENABLED
    assert board.make_ready(homed=False).ask(pulse).result == Refusal.NOT_HOMED
    board = Bench("delta3", DriveKind.DC).make_ready()
    board.set("speed", 5.0, 0)
    for k in range(1, 11):
        board.stream(board.towards(-0.07 * k), 50)
    board.stream(board.towards(-0.7), 300)
    assert board.state() == State.READY
    assert board.ask(step).result == Refusal.LIMIT
    servo = Bench("delta3", DriveKind.SERVO).make_ready()
    assert servo.ask(pulse).result == Refusal.UNKNOWN


def test_the_same_test_again_is_the_answer_that_was_lost(board):
    assert board.ask(Test(TestKind.PULSE, 0, 0.1, 300), 77).result == Refusal.OK
    assert board.ask(Test(TestKind.PULSE, 0, 0.1, 300), 77).result == Refusal.OK
    assert board.ask(Test(TestKind.PULSE, 0, 0.1, 300), 78).result == Refusal.BUSY


@pytest.mark.parametrize("command", [Command.STOP, Command.HALT])
def test_a_test_can_be_stopped(board, command):
    board.ask(Test(TestKind.PULSE, 0, 0.2, 3000))
    board.run(100)
    board.order(command)
    board.run(500)
    assert board.state() == (State.STOPPED if command == Command.STOP else State.READY)
    assert board.speeds[0] == pytest.approx(0.0, abs=0.02)


def test_no_more_than_duty_max(board):
    board.order(Command.OFF)
    board.set("duty_max", 0.25)
    board.make_ready()
    board.ask(Test(TestKind.PULSE, 0, -0.9, 50))
    assert board.tick().drive[0] == -0.25
    board.run(200)
    board.ask(Test(TestKind.STEP, 0, 0.3, 100))
    assert board.tick().drive[0] == pytest.approx(0.25)
