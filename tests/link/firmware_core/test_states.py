"""Which command is allowed in which state, and what it leads to: the table in PROTOCOL.md."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import pytest

from app.link.protocol.codes import Command, DriveKind, Fault, Flag, Refusal, Reset, State, TestKind
from app.link.protocol.messages import Alive, Hello, Identity, Test
from tests.link.firmware_core.bench import Bench
from tests.support.tools import needs

pytestmark = needs("gcc")


def off() -> Bench:
    return Bench()


def ready() -> Bench:
    return Bench().make_ready()


def moving() -> Bench:
    board = ready()
    board.stream(board.towards(0.08), 60)
    return board


def homing() -> Bench:
    board = Bench(joints=[0.3] * 4).make_ready(homed=False)
    board.order(Command.HOME)
    return board


def in_a_test() -> Bench:
    board = ready()
    assert board.ask(Test(TestKind.PULSE, 0, 0.1, 1000)).result == Refusal.OK
    return board


def held() -> Bench:
    board = moving()
    board.run(120)
    return board


def stopped() -> Bench:
    board = ready()
    board.order(Command.STOP)
    return board


def fault() -> Bench:
    board = ready()
    board.estop = True
    board.tick()
    board.estop = False
    board.tick()
    return board


STATES: dict[State, Callable[[], Bench]] = {
    State.OFF: off,
    State.READY: ready,
    State.MOVING: moving,
    State.HOMING: homing,
    State.TESTING: in_a_test,
    State.HELD: held,
    State.STOPPED: stopped,
    State.FAULT: fault,
}

LEADS_TO: dict[Command, dict[State, State]] = {
    Command.STOP: {
        **dict.fromkeys(STATES, State.STOPPED),
        State.OFF: State.OFF,
        State.FAULT: State.FAULT,
    },
    Command.OFF: {**dict.fromkeys(STATES, State.OFF), State.FAULT: State.FAULT},
    Command.CLEAR: {
        State.STOPPED: State.READY,
        State.FAULT: State.OFF,
        State.READY: State.READY,
        State.OFF: State.OFF,
    },
    Command.ENABLE: {State.OFF: State.READY, State.READY: State.READY},
    Command.HOME: {State.READY: State.HOMING, State.HOMING: State.HOMING},
    Command.FOLLOW: {State.HELD: State.READY, State.READY: State.READY},
    Command.HALT: dict.fromkeys((State.READY, State.MOVING, State.HOMING, State.TESTING), State.READY),
    Command.SAVE: {State.OFF: State.OFF},
    Command.DEFAULTS: {State.OFF: State.OFF},
}

REASON = {
    State.OFF: Refusal.NOT_ENABLED,
    State.HELD: Refusal.HELD,
    State.STOPPED: Refusal.STOPPED,
    State.FAULT: Refusal.FAULT,
}


@pytest.mark.parametrize("state", STATES)
def test_the_commands_of_a_state(state):
    for command in Command:
        board = STATES[state]()
        assert board.state() == state
        result = board.order(command)
        after = LEADS_TO[command].get(state)
        if after is None:
            reason = Refusal.BUSY if command in (Command.SAVE, Command.DEFAULTS) else REASON.get(state, Refusal.BUSY)
            assert result == reason, command
            assert board.state() == state
        else:
            assert result == Refusal.OK, command
            assert board.state() == after


def test_a_board_boots_off_with_everything_off():
    board = Bench()
    assert board.state() == State.OFF
    assert board.outputs == (False, (0.0,) * 4, pytest.approx(board.setting("pen_up")), 0.0)
    assert board.telemetry[-1].flags == Flag(0)


def test_after_its_watchdogs_reset_a_board_says_so():
    board = Bench(reset=Reset.WATCHDOG)
    assert board.state() == State.FAULT and board.telemetry[-1].fault == Fault.WATCHDOG
    assert board.order(Command.ENABLE) == Refusal.FAULT
    assert board.order(Command.CLEAR) == Refusal.OK
    assert board.state() == State.OFF and board.telemetry[-1].fault == Fault.NONE


def test_identity():
    board = Bench("delta3", DriveKind.SERVO, serial=123_456)
    number = board.send(Hello(), 40_000)
    board.tick()
    identity = board.others.pop()
    assert number == 40_000 and isinstance(identity, Identity)
    assert (identity.robot, identity.drive, identity.joints) == (2, DriveKind.SERVO, 3)
    assert (identity.protocol, identity.version, identity.period_us, identity.serial) == (1, "1.0", 5000, 123_456)


def test_telemetry_comes_every_20_ms_and_carries_the_last_accepted_number():
    board = ready()
    board.forget()
    board.aim(board.towards(0.01))
    number = board._number
    board.aim((9.0,) * 4)
    board.run(1000)
    board.telemetry.pop(0)
    times = [telemetry.t_us for telemetry in board.telemetry]
    assert {b - a for a, b in itertools.pairwise(times)} == {20_000} and len(times) == 50
    assert board.telemetry[-1].refusal == Refusal.LIMIT
    assert number > 0


def test_frames_are_counted():
    board = Bench()
    board.send(Alive())
    board.core.receive(b"\0\x05abcd\0" + b"\0\x02\x01\0")
    board.state()
    before = board.telemetry[-1]
    board.core.receive(b"\0noise\0")
    board.state()
    assert board.telemetry[-1].bad == before.bad + 1
    assert board.telemetry[-1].good == before.good + 1  # the sign of life in `state`
