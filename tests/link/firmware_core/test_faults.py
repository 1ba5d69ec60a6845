"""What switches the power off."""

from __future__ import annotations

import pytest

from app.link.protocol.codes import Command, DriveKind, Fault, Flag, Refusal, State
from tests.link.firmware_core.bench import Bench
from tests.support.tools import needs

pytestmark = needs("gcc")


def ready(drive: DriveKind = DriveKind.DC) -> Bench:
    return Bench("delta3", drive).make_ready()


def expect(board: Bench, fault: Fault, joint: int) -> None:
    assert board.state() == State.FAULT and not board.outputs.powered
    assert board.outputs.laser == 0.0
    assert board.outputs.drive == (0.0,) * 4 or board.drive == DriveKind.STEPPER
    assert (board.telemetry[-1].fault, board.telemetry[-1].fault_joint) == (fault, joint)
    assert not board.telemetry[-1].flags & Flag.POWERED


@pytest.mark.parametrize("powered", [True, False])
def test_the_emergency_stop_works_at_once_and_must_be_closed_to_be_cleared(powered):
    board = ready() if powered else Bench()
    board.estop = True
    assert not board.tick().powered
    expect(board, Fault.ESTOP, 0)
    assert board.telemetry[-1].flags & Flag.ESTOP_OPEN
    assert board.order(Command.CLEAR) == Refusal.ESTOP
    board.estop = False
    expect(board, Fault.ESTOP, 0)  # latched
    assert board.order(Command.CLEAR) == Refusal.OK
    assert board.state() == State.OFF


@pytest.mark.parametrize("reading", [0.0, 0.019, 0.981, 1.0, float("nan")])
def test_a_sensor_at_its_rail_is_a_broken_wire(reading):
    board = ready()
    board.raw_is[1] = reading
    assert not board.tick().powered
    expect(board, Fault.SENSOR, 2)
    assert board.order(Command.CLEAR) == Refusal.FAULT
    board.raw_is.clear()
    board.tick()
    assert board.order(Command.CLEAR) == Refusal.OK


def test_a_sensor_that_reads_nothing_does_not_matter_while_off():
    board = Bench("delta3", DriveKind.DC)
    board.raw_is[1] = 0.0
    assert board.run(100).state == State.OFF


@pytest.mark.parametrize(("beyond", "fault"), [(0.04, Fault.NONE), (0.06, Fault.LIMIT)])
def test_a_joint_may_be_a_little_beyond_its_limit(beyond, fault):
    board = Bench("delta3", DriveKind.DC, joints=[0.2, 0.2, 1.5]).make_ready(homed=False)
    board.stuck = {2}
    board.joints[2] = board.setting("max", 2) + beyond
    board.tick()
    assert board.state() == (State.FAULT if fault else State.READY)
    if fault:
        expect(board, Fault.LIMIT, 3)
        assert board.order(Command.CLEAR) == Refusal.OK
        assert board.order(Command.ENABLE) == Refusal.LIMIT
        board.joints[2] = 1.0
        board.tick()
        assert board.order(Command.ENABLE) == Refusal.OK


def test_a_stuck_joint_is_noticed_after_following_time():
    board = ready()
    board.stuck = {0}
    for k in range(1, 21):  # farther away than `following`, 0.2 rad, for the last 200 ms
        board.aim(board.towards(0.02 * min(k, 15)))
        board.run(20, alive=False)
    assert board.telemetry[-1].flags & Flag.POWERED
    board.stream(board.towards(0.3), 150)
    expect(board, Fault.FOLLOWING, 1)


@pytest.mark.parametrize("drive", [DriveKind.DC, DriveKind.SERVO])
def test_a_limit_switch_that_closes_in_motion(drive):
    board = ready(drive)
    board.switches = 0b100
    assert board.run(100).state == State.READY and board.telemetry[-1].limit_switches == 0b100
    board.aim(board.towards(0.1))
    board.tick()
    expect(board, Fault.SWITCH, 3)


def test_a_switch_that_is_closed_at_the_lower_limit_is_where_it_belongs():
    board = Bench("linear", DriveKind.STEPPER, joints=[0.01] * 3).make_ready()
    at = board.home[0]
    while at > 0.0:
        at = max(at - 0.0015, 0.0)
        board.stream((at, *board.home[1:]), 10)
    telemetry = board.stream((0.0, *board.home[1:]), 60)
    assert telemetry.limit_switches == 0b001 and telemetry.fault == Fault.NONE
    board.switches = 0b010
    board.stream((0.001, *board.home[1:]), 20)
    expect(board, Fault.SWITCH, 2)


def test_the_first_fault_stands():
    board = ready()
    board.raw_is[0] = 0.0
    board.tick()
    board.estop = True
    board.tick()
    expect(board, Fault.SENSOR, 1)
    assert board.order(Command.CLEAR) == Refusal.ESTOP
