"""Motions with a board: programs, pauses, tests, recordings, settings; also on a bad line."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.toolpath import default_placement, plan_toolpath
from app.link.emulated.board import EmulatedBoard
from app.link.emulated.faults import Faults
from app.link.errors import LinkError
from app.link.motions.motion import Target
from app.link.programs import Jog, Program
from app.link.protocol.codes import DriveKind, Fault, Flag, Refusal, State, TestKind
from app.link.protocol.messages import Order, Setpoint, Telemetry, Test
from app.link.protocol.settings import setting_id
from app.robots import make_robot
from tests.support.link_bench import ANNA, BEN, CARLA, Bench

DOWN = Jog("pose", 2, -1, 0.05)


@pytest.fixture
def bench() -> Bench:
    return Bench(EmulatedBoard("delta3"))


@pytest.fixture
def motors() -> Bench:
    return Bench(EmulatedBoard("delta3", drive=DriveKind.DC))


def report(bench: Bench) -> Telemetry:
    telemetry = bench.status.telemetry
    assert telemetry is not None
    return telemetry


def square() -> Program:
    """A drawing of 20 mm."""
    robot = make_robot("delta3")
    corners = np.array([[-10.0, -10.0], [10.0, -10.0], [10.0, 10.0], [-10.0, 10.0], [-10.0, -10.0]])
    return Program.from_toolpath(plan_toolpath([corners], robot, default_placement(robot)), "delta3", "Square")


def setpoints(bench: Bench, since: float = 0.0) -> list[Setpoint]:
    return [said for time, said in bench.said if isinstance(said, Setpoint) and time >= since]


def test_a_drawing_is_drawn(bench):
    program = square()
    bench.home()
    start = bench.now
    bench.order("run", ANNA, program)
    drawn = []
    while bench.status.activity == "run" and bench.now < start + 60.0:
        bench.run(0.02)
        if bench.board.pen:
            drawn.append(bench.board.robot.forward(bench.board.true_joints))
    assert bench.status.program_title == ""
    bench.run(0.2)
    assert (bench.state, bench.status.activity) == (State.READY, "idle")
    assert bench.commands(start) == {}  # the board comes to rest by itself
    xy = 1e3 * np.array(drawn)[:, :2]
    assert np.abs(xy).max() == pytest.approx(10.0, abs=0.5)
    on_square = np.abs(np.abs(xy).max(axis=1) - 10.0)
    assert on_square.max() < 0.5
    assert bench.now - start < program.duration_s + 2.5


def test_set_points_come_at_100_hz_only_while_something_moves(bench):
    bench.home()
    start = bench.now
    bench.answer("step", ANNA, DOWN, 0.05)
    bench.run_until(lambda: bench.status.activity == "idle")
    took = bench.now - start
    assert bench.count(Setpoint, since=start) == pytest.approx(100.0 * took, abs=5)
    assert report(bench).state is State.READY
    quiet = bench.now
    bench.run(1.0)
    assert bench.count(Setpoint, since=quiet) == 0
    assert bench.status.measured_pose == pytest.approx((0.0, 0.0, -0.38), abs=1e-5)
    assert 0.0 < bench.status.round_trip_ms < 30.0


def test_pause_halts_at_once_and_resume_goes_on_where_it_was(bench):
    program = square()
    bench.home()
    bench.order("run", ANNA, program)
    bench.run_until(lambda: bench.status.progress > 0.5, 30.0)
    bench.order("pause", ANNA)
    assert bench.said[-1][1] == Order(bench.said[-1][1].command)
    assert bench.commands()["HALT"] == 1
    paused, at = bench.now, bench.status.progress
    bench.run(1.0)
    assert (bench.status.activity, bench.status.progress) == ("paused", at)
    assert bench.count(Setpoint, since=paused + 1e-6) == 0
    assert "resume or cancel" in bench.refused("jog", ANNA, DOWN)
    assert "resume or cancel" in bench.refused("run", ANNA, program)
    bench.answer("resume", ANNA)
    bench.run(0.1)
    assert bench.status.activity == "run"
    assert bench.status.progress == pytest.approx(at, abs=0.01)
    bench.run_until(lambda: bench.status.activity == "idle", 30.0)
    last = setpoints(bench)[-1]
    assert last.target[:3] == pytest.approx(program.q[-1], abs=1e-5)


def test_a_board_that_held_pauses_the_program(bench):
    bench.home()
    bench.order("run", ANNA, square())
    bench.run(1.5)
    for _ in range(40):  # the host hangs
        bench.now += 0.005
        bench.board.advance(0.005)
    bench.run(0.5)
    assert (bench.state, bench.status.activity) == (State.HELD, "paused")
    bench.answer("resume", ANNA)
    bench.run(0.8)
    assert (bench.state, bench.status.activity) == (State.MOVING, "run")
    assert bench.commands()["FOLLOW"] == 1


def test_resume_without_a_program_only_lets_the_board_follow(bench):
    bench.enable()
    bench.answer("jog", ANNA, Jog("joint", 0, 1, 0.5))
    bench.run(0.05)
    for _ in range(40):
        bench.now += 0.005
        bench.board.advance(0.005)
    bench.run(0.1)
    assert bench.state is State.HELD
    bench.answer("resume", CARLA)
    bench.run(0.5)
    assert (bench.state, bench.status.activity) == (State.READY, "idle")


def test_cancel_ends_for_good(bench):
    bench.home()
    bench.order("run", ANNA, square())
    bench.run(1.5)
    bench.order("cancel", ANNA)
    bench.run(0.3)
    assert (bench.state, bench.status.activity, bench.status.progress) == (State.READY, "idle", 0.0)
    assert bench.commands()["HALT"] == 1


def test_the_override_slows_a_program_down(bench):
    bench.home()
    bench.order("set_override", ANNA, 0.25)
    bench.order("run", ANNA, square())
    bench.run_until(lambda: bench.status.progress > 0.2, 60.0)
    start, at = bench.now, bench.status.progress
    bench.run(1.0)
    rate = (bench.status.progress - at) * square().duration_s / (bench.now - start)
    assert rate == pytest.approx(0.25, rel=0.05)
    assert bench.status.override == 0.25
    assert "5 to 100 %" in bench.refused("set_override", ANNA, 0.01)


def test_one_percent_of_garbled_bytes_does_not_stop_a_drawing(bench):
    bench.home()
    bench.board.faults = Faults(noise=0.01)
    bench.order("run", ANNA, square())
    bench.run_until(lambda: bench.status.activity != "run", 60.0)
    bench.run(0.2)
    assert (bench.state, bench.status.activity) == (State.READY, "idle")


def test_a_motion_ends_when_the_board_reports_a_fault(motors):
    motors.home()
    motors.order("mirror", ANNA, (0.06, 0.0, -0.35))
    motors.run(0.4)
    motors.board.faults = Faults(estop=True)
    motors.run(0.1)
    assert report(motors).fault is Fault.ESTOP
    assert motors.status.activity == "idle"
    assert "emergency stop is pressed" in motors.status.sentence
    quiet = motors.now
    motors.run(0.3)
    assert motors.count(Setpoint, since=quiet) == 0
    with pytest.raises(LinkError, match="emergency stop is still pressed"):
        motors.answer("clear", ANNA)


def test_a_set_point_that_the_board_refuses_ends_the_motion(bench):
    bench.home()
    bench.answer("step", ANNA, DOWN, 0.06)
    bench.run(0.2)
    motion = bench.pilot.mover.motion
    assert motion is not None
    motion.advance = lambda dt_s, share: Target((9.0, 9.0, 9.0))
    bench.run(0.3)
    assert bench.status.activity == "idle"
    assert "outside of the joint limits" in bench.status.sentence
    assert bench.commands()["HALT"] == 1


def test_a_mirror_that_was_ended_is_not_begun_again_by_the_next_event(bench):
    bench.home()
    bench.order("mirror", ANNA, (0.05, 0.0, -0.33))
    bench.run(0.3)
    bench.answer("stop", BEN)
    bench.answer("clear", ANNA)
    bench.run(0.1)
    bench.order("mirror", ANNA, (0.05, 0.0, -0.33))  # Stop forgot the hand, so this is a new beginning
    bench.run(0.1)
    assert bench.status.activity == "mirror"
    bench.order("mirror_end", ANNA)
    bench.run(0.3)
    assert (bench.state, bench.status.activity) == (State.READY, "idle")


def test_targets_wait_for_a_board_that_is_slower(bench):
    """It may have reasons of its own to go slowly; a target too far ahead would be refused as a jump."""
    bench.home()
    bench.order("apply_settings", ANNA, {setting_id("tool_speed"): 0.02}, False)
    bench.run(0.2)
    bench.pilot.connection.settings[setting_id("tool_speed")] = 0.25  # the host does not know
    bench.answer("step", ANNA, Jog("pose", 2, -1, 0.25), 0.04)
    farthest = 0.0
    while bench.status.activity == "step":
        bench.run(0.02)
        telemetry = report(bench)
        assert telemetry.refusal is Refusal.OK
        gaps = np.subtract(setpoints(bench)[-1].target, telemetry.setpoint)
        farthest = max(farthest, float(np.abs(gaps).max()))
    assert 0.02 < farthest < 0.15 * 4.0
    assert bench.status.measured_pose == pytest.approx((0.0, 0.0, -0.37), abs=1e-5)


def test_built_in_settings_come_back(bench):
    bench.connect()
    bench.give(ANNA)
    bench.run(2.0)
    id = setting_id("home", 0)
    built_in = bench.status.settings[id]
    bench.answer("apply_settings", ANNA, {id: 0.4}, False)
    bench.answer("restore_defaults", ANNA)
    bench.run_until(lambda: id in bench.status.settings, 5.0)
    assert bench.status.settings[id] == built_in


def test_settings_are_read_back(motors):
    motors.enable()
    id = setting_id("kp", 1)
    motors.answer("apply_settings", ANNA, {id: 41.5}, False)
    assert motors.status.settings[id] == pytest.approx(41.5)
    with pytest.raises(LinkError, match=r"Upper limit of joint 1 was not changed\. .*present state"):
        motors.answer("apply_settings", ANNA, {setting_id("max", 0): 1.0}, False)
    assert "must be a number" in motors.refused("apply_settings", ANNA, {id: float("nan")}, False)
    assert "no setting number 99" in motors.refused("apply_settings", ANNA, {99: 1.0}, False)


def test_limits_may_be_given_in_any_order(bench):
    bench.connect()
    bench.give(ANNA)
    low, high = setting_id("min", 0), setting_id("max", 0)
    bench.answer("apply_settings", ANNA, {low: -0.5, high: -0.3, setting_id("home", 0): -0.4}, False)
    bench.answer("apply_settings", ANNA, {low: 0.1, high: 0.6}, False)
    assert (bench.status.settings[low], bench.status.settings[high]) == pytest.approx((0.1, 0.6))
    with pytest.raises(LinkError, match="was not changed"):
        bench.answer("apply_settings", ANNA, {low: 0.7}, False)


def test_saved_settings_outlive_the_power(bench):
    bench.connect()
    bench.give(ANNA)
    id = setting_id("home", 2)
    bench.answer("apply_settings", ANNA, {id: 0.3}, True)
    bench.board.reset()
    bench.run_until(lambda: bench.status.phase == "connecting", 1.0)
    bench.run_until(lambda: bench.status.settings.get(id) is not None, 5.0)
    assert bench.status.settings[id] == pytest.approx(0.3)


def test_a_setting_that_the_board_does_not_keep_is_noticed(bench):
    bench.connect()
    bench.give(ANNA)
    bench.run(2.0)
    original = bench.pilot.conversation.hear
    bench.pilot.conversation.hear = lambda reply, number, now: original(
        reply.__class__(reply.result, reply.value + 1.0), number, now
    )
    with pytest.raises(LinkError, match=r"should be 0\.2, but the board keeps 1\.2"):
        bench.answer("apply_settings", ANNA, {setting_id("home", 2): 0.2}, False)


def test_a_test_on_the_board_gives_samples(motors):
    motors.home()
    motors.run(1.0)
    recording = motors.answer("test", ANNA, Test(TestKind.STEP, 1, 0.1, 400), within_s=3.0)
    assert motors.status.activity == "idle"
    samples = recording.samples
    assert samples is not None and samples.joint == 1
    assert np.ptp(samples.t) == pytest.approx(0.4, abs=0.02)
    assert np.median(np.diff(samples.t)) == pytest.approx(0.004, abs=0.0011)
    assert samples.position[-1] - samples.position[0] == pytest.approx(0.1, abs=0.05)
    assert recording.robot == "delta3"


def test_a_test_is_refused_where_it_teaches_nothing(bench, motors):
    bench.home()
    assert "Only DC drives" in bench.refused("test", ANNA, Test(TestKind.STEP, 0, 0.1, 400))
    motors.enable()
    assert "home it first" in motors.refused("test", ANNA, Test(TestKind.STEP, 0, 0.1, 400))


def test_stop_ends_a_test(motors):
    motors.home()
    answer = motors.order("test", ANNA, Test(TestKind.PULSE, 0, 0.2, 1000))
    motors.run(0.1)
    assert motors.status.activity == "test"
    motors.order("stop", BEN)
    with pytest.raises(LinkError, match="Ben pressed Stop"):
        answer.result(0)
    motors.run(0.1)
    assert motors.state is State.STOPPED


def test_telemetry_is_recorded_at_full_rate(bench):
    bench.home()
    bench.order("start_recording")
    bench.answer("step", ANNA, DOWN, 0.02)
    bench.run(2.0)
    assert bench.status.recording_s == pytest.approx(2.0, abs=0.2)
    recording = bench.order("stop_recording")
    assert len(recording.t) == pytest.approx(100, abs=10)
    assert np.isfinite(recording.latency_s[-1])
    assert "Nothing is being recorded" in bench.refused("stop_recording")


def test_homing_ends_when_the_robot_goes_to_somebody_else():
    bench = Bench(EmulatedBoard("linear"))
    bench.enable()
    bench.answer("home", ANNA)
    bench.run(0.3)
    assert bench.state is State.HOMING
    bench.order("take_over", CARLA)
    bench.run(0.2)
    assert bench.state is State.READY
    assert Flag.HOMED not in report(bench).flags


def test_two_people_at_once(bench):
    """Both press at the same time; only the holder moves the robot, and it changes hands only by the queue."""
    bench.home()
    bench.give(BEN)
    bench.answer("jog", ANNA, Jog("joint", 0, 1, 0.2))
    for _ in range(10):
        assert "Anna has the robot" in bench.refused("jog", BEN, Jog("joint", 0, -1, 0.2))
        bench.order("jog", ANNA, Jog("joint", 0, 1, 0.2))
        bench.order("jog_release", BEN)  # means nothing
        bench.run(0.05)
    assert bench.status.activity == "jog"
    bench.order("release", ANNA)
    assert bench.status.holder == BEN
    bench.run(0.2)
    assert bench.state is State.READY
    bench.answer("jog", BEN, Jog("joint", 0, -1, 0.2))
    assert bench.status.activity == "jog"
    assert bench.commands()["HALT"] == 1


def test_the_revision_grows_when_there_is_something_to_see(bench):
    bench.home()
    bench.lively = set()
    bench.pilot.lease.alive(ANNA, bench.now)
    bench.run(0.1)
    revision = bench.status.revision
    bench.run(0.1)
    assert bench.status.revision == revision
    bench.answer("step", ANNA, DOWN, 0.01)
    seen = set()
    for _ in range(10):
        bench.run(0.05)
        seen.add(bench.status.revision)
    assert len(seen) > 5
