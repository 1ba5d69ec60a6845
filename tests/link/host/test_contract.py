"""The safety contract, section by section, as far as the host keeps it; an emulated board at the other end."""

from __future__ import annotations

import numpy as np
import pytest

from app.link.emulated.board import EmulatedBoard
from app.link.emulated.faults import Faults
from app.link.errors import LinkError
from app.link.health import LATE_S
from app.link.programs import Jog, Program
from app.link.protocol.codes import DriveKind, Flag, State, TargetKind
from app.link.protocol.messages import Alive, Hello, Order, Setpoint, Telemetry
from tests.support.link_bench import ANNA, BEN, CARLA, TURN_S, Bench

UP = Jog("pose", 2, 1, 0.1)
JOINT = Jog("joint", 0, 1, 0.5)


@pytest.fixture
def bench() -> Bench:
    return Bench(EmulatedBoard("delta3"))


def press(bench: Bench, jog: Jog, seconds: float, every_s: float = 0.05) -> None:
    """Hold a button down as the page does."""
    left = seconds
    while left > 1e-9:
        bench.order("jog", ANNA, jog)
        bench.run(min(every_s, left))
        left -= every_s


def report(bench: Bench) -> Telemetry:
    telemetry = bench.status.telemetry
    assert telemetry is not None
    return telemetry


def circle(bench: Bench, seconds: float = 4.0, radius: float = 0.03, **options: bool) -> Program:
    """About the home pose, from rest to rest, pen down from the start on."""
    robot = bench.board.robot
    t = np.linspace(0.0, seconds, 401)
    s = t / seconds
    turn = 2.0 * np.pi * (s**3 * (10.0 - 15.0 * s + 6.0 * s * s))
    pose = np.tile(robot.home, (len(t), 1))
    pose[:, 0] += radius * np.cos(turn)
    pose[:, 1] += radius * np.sin(turn)
    laser = np.where((s > 0.2) & (s < 0.8), 0.5, 0.0)
    return Program("circle", robot.name, t, robot.inverse(pose), np.ones(len(t), dtype=bool), laser, **options)


def speed_of(bench: Bench, seconds: float = 0.2) -> float:
    """Fastest set-point of a joint in the next while, rad/s."""
    fastest, before = 0.0, report(bench)
    for _ in range(round(seconds / 0.02)):
        bench.run(0.02)
        now = report(bench)
        fastest = max(fastest, *(abs(b - a) / 0.02 for a, b in zip(before.setpoint, now.setpoint, strict=True)))
        before = now
    return fastest


def test_contract_1_one_holder_and_a_queue_in_order(bench):
    bench.connect()
    for person in (ANNA, BEN, CARLA):
        bench.order("request", person)
    assert (bench.status.holder, bench.status.queue) == (ANNA, (BEN, CARLA))
    bench.order("release", ANNA)
    assert (bench.status.holder, bench.status.queue) == (BEN, (CARLA,))


def test_contract_1_the_countdown_is_seen_and_frees_the_robot(bench):
    bench.home()
    bench.order("request", BEN)
    bench.lively = {BEN}
    bench.order("run", ANNA, circle(bench, 60.0))
    bench.run(5.0)
    assert 9.0 < bench.status.holder_left_s < 11.0
    assert bench.status.activity == "run"
    bench.run_until(lambda: bench.status.holder == BEN, 11.0)
    assert bench.status.activity == "idle"
    bench.run(0.2)
    assert bench.state is State.READY
    assert bench.commands()["HALT"] == 1


def test_contract_1_the_instructor_takes_the_robot_back_at_once(bench):
    bench.home()
    bench.order("run", ANNA, circle(bench))
    bench.run(1.0)
    bench.order("take_over", CARLA)
    assert (bench.status.holder, bench.status.queue) == (CARLA, (ANNA,))
    assert bench.commands()["HALT"] == 1
    bench.run(0.2)
    assert speed_of(bench) == 0.0
    assert "Only an instructor" in bench.refused("take_over", BEN)


def test_contract_1_the_instructor_hands_a_moving_robot_over_and_it_halts(bench):
    bench.home()
    bench.order("run", ANNA, circle(bench))
    bench.run(1.0)
    bench.order("hand_to", CARLA, BEN)
    assert (bench.status.holder, bench.status.queue) == (BEN, (ANNA,))
    bench.run(0.2)
    assert speed_of(bench) == 0.0 and bench.status.activity == "idle"
    assert "Only an instructor" in bench.refused("hand_to", BEN, ANNA)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("enable", ()),
        ("home", ()),
        ("jog", (JOINT,)),
        ("step", (JOINT, 0.1)),
        ("mirror", ((0.0, 0.0, -0.33),)),
        ("pause", ()),
        ("cancel", ()),
        ("resume", ()),
        ("clear", ()),
        ("power_off", ()),
        ("set_override", (0.5,)),
        ("apply_settings", ({0: 1.0}, False)),
    ],
)
def test_contract_1_only_the_holder_is_obeyed(bench, name, arguments):
    bench.home()
    before = len(bench.said)
    assert "Anna has the robot" in bench.refused(name, BEN, *arguments)
    assert not any(isinstance(said, Order | Setpoint) for _, said in bench.said[before:])
    bench.order("release", ANNA)
    assert "Nobody has the robot" in bench.refused(name, BEN, *arguments)


def test_contract_2_a_jog_ends_125_ms_after_the_last_renewal_with_one_halt(bench):
    bench.enable()
    press(bench, JOINT, 0.5)
    last = bench.now
    bench.run(0.4)
    halts = [time for time, said in bench.said if isinstance(said, Order) and said.command.name == "HALT"]
    assert len(halts) == 1
    # `press` waits 50 ms after its last renewal; the loop turns every 10 ms
    assert 0.07 <= halts[0] - last <= 0.09 + TURN_S
    assert bench.state is State.READY
    assert bench.count(Setpoint, since=halts[0] + 1e-6) == 0


def test_contract_2_a_release_sends_exactly_one_halt(bench):
    bench.enable()
    press(bench, JOINT, 0.4)
    bench.order("jog_release", ANNA)
    bench.order("jog_release", ANNA)
    bench.run(0.5)
    assert bench.commands()["HALT"] == 1
    assert bench.status.activity == "idle"


def test_contract_2_late_renewals_do_not_start_it_again(bench):
    bench.enable()
    press(bench, JOINT, 0.4)
    bench.run(0.2)
    where = bench.board.true_joints
    for _ in range(5):  # the browser catches up
        assert "press it again" in bench.refused("jog", ANNA, JOINT)
        bench.run(0.1)
    assert bench.commands()["HALT"] == 1
    assert bench.board.true_joints == pytest.approx(where, abs=0.01)
    bench.order("jog_release", ANNA)
    press(bench, JOINT, 0.3)
    assert bench.status.activity == "jog"


def test_contract_2_the_stream_ends_when_the_host_hangs(bench):
    bench.enable()
    press(bench, JOINT, 0.4)
    for _ in range(40):  # 0.2 s in which nobody calls the host
        bench.board.advance(TURN_S)
        bench.now += TURN_S
    bench.turn()
    assert bench.state is State.HELD
    assert "holds" in bench.status.sentence
    assert "press it again" in bench.refused("jog", ANNA, JOINT)
    bench.run(0.4)
    press(bench, JOINT, 0.2)  # a new press lets the board follow first
    assert bench.commands()["FOLLOW"] == 1
    assert bench.state is State.MOVING


@pytest.mark.parametrize("person", [ANNA, BEN, CARLA])
def test_contract_3_anyone_may_press_stop_and_it_is_written_at_once(bench, person):
    bench.home()
    bench.order("run", ANNA, circle(bench))
    bench.run(2.0)
    before = bench.now
    answer = bench.order("stop", person)
    assert bench.said[-1] == (before, Order(bench.said[-1][1].command))
    assert bench.said[-1][1].command.name == "STOP"
    bench.run_until(answer.done, 0.1)
    answer.result()
    bench.run(0.1)
    assert bench.state is State.STOPPED
    assert bench.board.laser == 0.0


def test_contract_3_stop_clears_every_queue(bench):
    bench.enable()
    waiting = [bench.order("apply_settings", ANNA, {10: 1.0, 20: 2.0}, False), bench.order("home", ANNA)]
    bench.order("stop", BEN)
    for answer in waiting:
        with pytest.raises(LinkError, match="pressed Stop"):
            answer.result(0)
    bench.run(0.5)
    assert bench.state is State.STOPPED


def test_contract_3_nothing_resumes_by_itself(bench):
    bench.home()
    bench.order("run", ANNA, circle(bench))
    bench.run(1.5)
    bench.answer("stop", BEN)
    bench.run(0.3)
    stands = bench.board.true_joints
    assert "has the robot" in bench.refused("clear", BEN)
    bench.answer("clear", ANNA)
    bench.run(2.0)
    assert bench.state is State.READY
    assert bench.status.activity == "idle"
    assert bench.board.true_joints == stands


def test_contract_3_stop_clears_a_paused_program(bench):
    bench.home()
    bench.order("run", ANNA, circle(bench))
    bench.run(1.5)
    bench.order("pause", ANNA)
    bench.run(0.2)
    bench.answer("stop", ANNA)
    bench.run(0.1)
    bench.answer("clear", ANNA)
    bench.answer("resume", ANNA)
    bench.run(0.5)
    assert speed_of(bench) == 0.0


def test_contract_3_an_instructor_may_clear_without_holding(bench):
    bench.enable()
    bench.answer("stop", BEN)
    bench.answer("clear", CARLA)
    bench.run(0.1)
    assert bench.state is State.READY


def test_contract_3_nothing_resumes_after_a_reconnect(bench):
    bench.home()
    bench.order("run", ANNA, circle(bench))
    bench.run(1.5)
    bench.board.faults = Faults(unplugged=True)
    bench.run(0.1)
    assert bench.status.phase == "lost"
    assert "cable" in bench.status.sentence
    stands = bench.board.true_joints
    bench.board.faults = Faults()
    bench.run_until(lambda: bench.status.phase == "ready" and bench.status.telemetry is not None, 6.0)
    bench.run(1.0)
    assert bench.state is State.OFF
    assert bench.status.activity == "idle"
    assert report(bench).flags & Flag.HOMED == 0
    assert bench.board.true_joints == stands


def test_contract_3_stop_without_a_confirmation_says_so(bench):
    bench.enable()
    bench.board.faults = Faults(loss=1.0)
    answer = bench.order("stop", BEN)
    bench.run(0.3)
    assert bench.commands()["STOP"] >= 4  # repeated until it is answered
    bench.run(1.0)
    assert answer.exception(0) is not None


def test_contract_3_stop_without_a_robot_sends_people_to_the_switch(bench):
    assert "emergency stop" in bench.refused("stop", BEN)


def test_contract_4_stop_holds_and_power_off_lets_go(bench):
    bench.enable()
    bench.answer("stop", ANNA)
    bench.run(0.2)
    assert bench.board.powered
    bench.answer("power_off", ANNA)
    bench.run(0.1)
    assert not bench.board.powered
    assert bench.state is State.OFF


def test_contract_5_coordinates_only_when_homed(bench):
    bench.enable()
    for name, arguments in (("jog", (UP,)), ("step", (UP, 0.01)), ("mirror", ((0.0, 0.0, -0.33),))):
        assert "home it first" in bench.refused(name, ANNA, *arguments)
    assert "home it first" in bench.refused("run", ANNA, circle(bench))
    assert bench.count(Setpoint) == 0
    bench.answer("step", ANNA, JOINT, 0.1)  # joints may be jogged
    assert bench.status.activity == "step"


def test_contract_5_manual_set_points_carry_their_flag_and_keep_the_tool_slow(bench):
    bench.home()
    fastest, before = 0.0, np.array(bench.status.commanded_pose)
    bench.order("mirror", ANNA, (0.10, 0.0, -0.33))
    for _ in range(60):
        bench.run(0.02)
        now = bench.board.robot.forward(report(bench).setpoint[:3])
        fastest, before = max(fastest, np.linalg.norm(now - before) / 0.02), now
    assert 0.2 < fastest <= 0.2501
    manual = [said.manual for _, said in bench.said if isinstance(said, Setpoint)]
    assert manual and all(manual)
    assert {said.kind for _, said in bench.said if isinstance(said, Setpoint)} == {TargetKind.JOINTS}


def test_contract_5_no_jog_leaves_the_limits(bench):
    bench.enable()
    bench.answer("jog", ANNA, Jog("joint", 1, 1, 9.0))
    press(bench, Jog("joint", 1, 1, 9.0), 4.0)
    high = bench.board.robot.joint_limits[1, 1]
    assert high - 0.01 < bench.board.true_joints[1] <= high + 1e-6
    assert "Joint 2 is at its limit of 90.0 deg" in bench.status.sentence
    assert report(bench).refusal.name == "OK"


def test_contract_6_a_refusal_carries_its_reason(bench):
    bench.connect()
    bench.give(ANNA)
    with pytest.raises(LinkError, match="motors are off; switch them on"):
        bench.answer("home", ANNA)
    assert "switch them on" in bench.refused("jog", ANNA, JOINT)


def test_contract_6_another_robot_is_refused_and_both_are_named(bench):
    with pytest.raises(LinkError, match=r"delta3, not par4.*firmware upload"):
        bench.answer("connect", bench.port, "par4")
    assert bench.status.phase == "refused"
    assert bench.status.telemetry is None
    assert "delta3" in bench.status.sentence


def test_contract_7_an_uno_is_left_alone_until_it_speaks():
    bench = Bench(EmulatedBoard("delta3", boot_s=1.2))
    bench.order("connect", bench.port, "delta3")
    bench.run(1.1)
    assert bench.said == []
    assert bench.status.phase == "connecting"
    bench.run_until(lambda: bench.status.phase == "ready", 1.0)
    assert isinstance(bench.said[0][1], Hello)


def test_contract_7_a_board_that_had_power_is_switched_off_first():
    board = EmulatedBoard("delta3", drive=DriveKind.DC)
    first = Bench(board)
    first.home()
    second = Bench(board)  # the program is started anew, the board has still power
    second.connect()
    second.run(0.1)
    assert second.state is State.OFF
    assert not board.powered
    assert Flag.HOMED not in report(second).flags
    second.give(ANNA)
    second.answer("enable", ANNA)
    assert "home it first" in second.refused("step", ANNA, UP, 0.01)


def test_contract_7_another_board_does_not_take_its_place(bench):
    bench.enable()
    bench.board.faults = Faults(unplugged=True)
    bench.run(0.1)
    bench.boards[bench.port] = EmulatedBoard("delta3", serial=77)
    bench.run_until(lambda: bench.status.phase == "refused", 6.0)
    assert "Arduino Uno 77 (delta3) instead of Arduino Uno 1000002 (delta3)" in bench.status.sentence
    bench.run(3.0)
    assert bench.status.phase == "refused"
    bench.connect()  # somebody decides to take it
    assert bench.status.identity.serial == 77


def test_while_powered_the_board_hears_from_the_host(bench):
    bench.enable()
    start = bench.now
    bench.run(1.0)
    assert 45 <= bench.count(Alive, since=start) <= 55
    assert bench.count(Setpoint) == 0
    assert LATE_S > 0.02
