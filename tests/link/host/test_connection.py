"""Connecting, losing, finding again: every state with its sentence."""

from __future__ import annotations

from typing import Any

import pytest

from app.link.board_geometry import geometry_values
from app.link.emulated.board import EmulatedBoard
from app.link.emulated.faults import Faults
from app.link.errors import LinkError
from app.link.health import Health
from app.link.ports import Port
from app.link.protocol.codes import Fault, Flag, Refusal, Reset, State
from app.link.protocol.messages import Telemetry
from app.link.protocol.settings import GEOMETRY_ID, SETTING_COUNT, setting_id
from app.robots import ROBOTS, build_robot, make_robot
from tests.support.link_bench import ANNA, TURN_S, Bench


@pytest.fixture
def bench() -> Bench:
    return Bench(EmulatedBoard("delta3"))


def robot_of(bench: Bench) -> Any:
    """The robot on the cable, whose geometry has the fields of its kind."""
    assert bench.status.robot is not None
    return bench.status.robot


def lose(bench: Bench, seconds: float = 0.1) -> None:
    bench.board.faults = Faults(unplugged=True)
    bench.run(seconds)
    bench.board.faults = Faults()


def set_geometry(bench: Bench, **dimensions: float) -> None:
    """As a calibration does, or somebody who built his robot otherwise."""
    values = geometry_values(build_robot("delta3", dimensions))
    changed = {GEOMETRY_ID + k: value for k, value in enumerate(values)}
    bench.answer("apply_settings", ANNA, changed, False)


@pytest.mark.parametrize("robot", ROBOTS)
def test_every_robot_is_known_in_less_than_a_second(robot):
    bench = Bench(EmulatedBoard(robot))
    start = bench.now
    bench.connect(robot)
    assert bench.now - start < 1.0
    assert robot_of(bench).name == robot
    assert f"({robot})" in bench.status.sentence
    bench.run(2.0)
    joints = len(robot_of(bench).joint_names)
    assert sorted(bench.status.settings) == [id for id in range(SETTING_COUNT) if not 10 * joints <= id < 40]


def test_a_port_that_is_not_there(bench):
    with pytest.raises(LinkError, match="no port usb9"):
        bench.answer("connect", "usb9", None)
    assert (bench.status.phase, bench.status.port) == ("refused", "")
    bench.connect()
    assert bench.status.phase == "ready"


def test_a_port_without_a_board(bench):
    bench.board.faults = Faults(loss=1.0)
    answer = bench.order("connect", bench.port, None)
    bench.run(2.9)
    assert bench.status.phase == "connecting"
    bench.run(0.2)
    assert "No Delta Lab board speaks" in str(answer.exception(0))
    assert bench.status.phase == "refused"


def test_a_board_that_hears_nothing(bench):
    """Its telemetry comes, but no question arrives."""
    bench.board.receive = lambda data: None
    answer = bench.order("connect", bench.port, None)
    bench.run(2.0)
    assert "does not answer" in str(answer.exception(0))
    assert len(bench.said) > 10  # HELLO was repeated


def test_own_dimensions_are_taken_where_no_robot_is_asked_for(bench):
    bench.connect()
    bench.give(ANNA)
    set_geometry(bench, rf=0.17)
    assert robot_of(bench).geometry.rf == pytest.approx(0.17)
    bench.connect()
    assert robot_of(bench).geometry.rf == pytest.approx(0.17)


def test_other_dimensions_are_refused_where_the_labs_robot_is_asked_for(bench):
    bench.connect()
    bench.give(ANNA)
    set_geometry(bench, rf=0.17)
    with pytest.raises(LinkError, match=r"not those of the lab's .*rf 170\.0 mm instead of 160\.0; choose"):
        bench.answer("connect", bench.port, "delta3")


def test_a_preset_of_the_lab_is_known(bench):
    bench.connect()
    bench.give(ANNA)
    narrow = {setting_id("min", joint): -0.6 for joint in range(3)}
    bench.answer("apply_settings", ANNA, narrow, False)
    set_geometry(bench, **ROBOTS["delta3"].presets["classic"])
    bench.connect("delta3")
    assert robot_of(bench).geometry == make_robot("delta3", preset="classic").geometry


def test_a_geometry_of_no_robot_is_refused_before_it_is_sent(bench):
    bench.connect()
    bench.give(ANNA)
    before = len(bench.said)
    assert "No robot of this kind" in bench.refused("apply_settings", ANNA, {GEOMETRY_ID + 5: 9.0}, False)
    assert len(bench.said) == before


def test_limits_wider_than_the_robots_are_refused(bench):
    bench.connect()
    bench.give(ANNA)
    with pytest.raises(LinkError, match=r"joint 2 go from -60\.\d to 90\.0 deg.* only bears -45\.0 to 90\.0"):
        bench.answer("apply_settings", ANNA, {setting_id("min", 1): -1.05}, False)


def test_a_quick_reset_is_noticed(bench):
    bench.home()
    bench.board.reset(Reset.LINE)
    bench.run_until(lambda: bench.status.phase == "connecting", 1.0)
    assert bench.status.activity == "idle"
    assert "was reset: it is off and not homed" in bench.status.sentence
    bench.run_until(lambda: bench.status.telemetry is not None, 2.0)
    assert bench.status.phase == "ready"
    assert bench.state is State.OFF
    assert Flag.HOMED not in bench.status.telemetry.flags


def test_silence_is_a_lost_board(bench):
    bench.enable()
    bench.board.faults = Faults(loss=1.0)
    bench.run_until(lambda: bench.status.phase == "lost", 1.0)
    assert "went silent" in bench.status.sentence
    assert "off and not homed" in bench.status.sentence
    bench.board.faults = Faults()
    bench.run_until(lambda: bench.status.phase == "ready", 6.0)
    assert bench.opened == [bench.port] * 2


def test_the_same_board_comes_back_under_another_name(bench):
    bench.enable()
    board = bench.board
    lose(bench)
    bench.boards = {"usb1": board, "usb0": EmulatedBoard("delta3", serial=5)}
    bench.plugged = [Port("usb0", "another", 0x2341, 0x43, "78"), Port("usb1", "a board", 0x2341, 0x43, "77")]
    bench.run_until(lambda: bench.status.phase == "ready", 6.0)
    assert bench.opened[-1] == "usb1"
    assert bench.status.identity.serial == board.serial


def test_while_it_is_not_plugged_in_no_other_port_is_opened(bench):
    bench.enable()
    lose(bench)
    bench.plugged = [Port("usb0", "another", 0x2341, 0x43, "78")]
    bench.run(5.0)
    assert bench.opened == ["usb0"]
    assert bench.status.phase == "lost"
    assert "not plugged in" in bench.status.sentence
    bench.order("disconnect")
    assert (bench.status.phase, bench.status.sentence) == ("none", "No robot is connected.")


def test_a_board_is_left_halted_when_the_connection_is_ended(bench):
    bench.home()
    bench.order("mirror", ANNA, (0.05, 0.0, -0.33))
    bench.run(0.3)
    bench.order("disconnect")
    assert bench.commands()["HALT"] == 1
    bench.run(0.7)
    assert not bench.board.powered


def test_noise_gets_a_sentence_and_stops_nothing(bench):
    bench.enable()
    bench.board.faults = Faults(noise=0.01)
    bench.run(12.0)
    assert bench.state is State.READY
    lines = [line.sentence for line in bench.status.log if "noisy" in line.sentence]
    assert lines and "check plugs and cable" in lines[0]


def test_a_busy_computer_gets_a_sentence(bench):
    bench.enable()
    for _ in range(18):
        bench.now += TURN_S
        bench.board.advance(TURN_S)
    bench.turn()
    assert "This computer was busy: the robot got nothing for" in bench.status.log[-1].sentence
    assert bench.state is State.READY


def telemetry(t_us: int) -> Telemetry:
    zero = (0.0,) * 4
    head = State.OFF, Flag(0), Fault.NONE, 0, Refusal.OK, 0
    return Telemetry(*head, t_us % 2**32, zero, zero, zero, 0, 0, 0)


@pytest.mark.parametrize(
    ("clocks", "reset"),
    [
        ([2**32 - 10_000, 2**32 + 10_000], False),  # the clock goes round every 71 minutes
        ([5_000_000, 20_000], True),
        ([3_000_000_000, 20_000], True),  # also where the way round would be the shorter one
        ([5_000_000, 5_020_000], False),
        ([5_000_000, 5_900_000], False),  # lost messages
    ],
)
def test_a_reset_is_told_from_a_clock_that_goes_round(clocks, reset):
    health = Health(0.0)
    assert not health.was_reset(telemetry(clocks[0]), 0.0)
    assert health.was_reset(telemetry(clocks[1]), 0.02) is reset
