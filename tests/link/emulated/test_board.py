"""Emulated boards, with either core: home, go where they are sent, and fail as real ones do."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
import pytest

from app.link.board_geometry import BOARD_ROBOTS, geometry_hash, geometry_values
from app.link.emulated import EmulatedBoard, Faults
from app.link.errors import LinkError
from app.link.protocol.codes import (
    BoardKind,
    Command,
    DriveKind,
    Fault,
    Flag,
    Refusal,
    Reset,
    State,
    TargetKind,
    TestKind,
)
from app.link.protocol.messages import Ack, Get, Hello, Identity, Sample, Set, Setpoint, Test
from app.link.protocol.settings import setting_id
from tests.link.emulated.host import PACE_S, Host, way
from tests.support.machines import reachable_poses
from tests.support.tools import needs

Kind = Literal["compiled", "twin"]
CORES = [pytest.param("compiled", marks=needs("gcc")), "twin"]
NEAR = {"par4": 0.01, "delta3": 1e-5, "linear": 1e-4, "fivebar": 0.06}
"""rad or m: potentiometers have steps (of ten turns, 0.015 rad), and a switch is seen a moment late."""


def ask(host: Host, setting: str, joint: int) -> float:
    answer = host.ask(Get(setting_id(setting, joint)))
    assert isinstance(answer, Ack)
    return answer.value


both_cores = pytest.mark.parametrize("core", CORES)
every_robot = pytest.mark.parametrize("robot", BOARD_ROBOTS)


def homed(robot: str, core: Kind | None = "twin", drive: DriveKind | None = None) -> Host:
    host = Host(EmulatedBoard(robot, core=core, drive=drive))
    host.home()
    return host


@both_cores
@every_robot
def test_it_homes_and_goes_where_it_is_sent(robot: str, core: Kind):
    host = homed(robot, core)
    board = host.board
    np.testing.assert_allclose(board.true_joints, board.robot.inverse(board.robot.home), atol=NEAR[robot])
    pose = board.robot.home + np.array([0.02, 0.015, -0.01, 0.2])[: board.robot.dof]
    host.go(pose.tolist())
    np.testing.assert_allclose(board.true_joints, board.robot.inverse(pose), atol=NEAR[robot])
    assert host.telemetry and host.telemetry.flags == Flag.HOMED | Flag.POWERED
    assert host.telemetry.bad == 0 and host.decoder.bad == 0


@both_cores
@every_robot
def test_the_boards_joints_are_those_of_our_inverse(robot: str, core: Kind):
    host = homed(robot, core)
    machine, n = host.board.robot, len(host.board.robot.joint_names)
    here, speeds = machine.inverse(machine.home), np.array([ask(host, "speed", joint) for joint in range(n)])
    for pose in reachable_poses(machine, 3 if core == "compiled" else 1, seed=2):
        there = machine.inverse(pose)
        steps = 2 + int(np.abs((there - here) / (0.6 * PACE_S * speeds)).max())
        host.stream(TargetKind.JOINTS, way(here, there, steps).tolist())
        host.rest(pose.tolist())
        assert host.telemetry
        np.testing.assert_allclose(host.telemetry.setpoint[:n], there, atol=5e-6)
        here = there


@every_robot
def test_it_says_which_board_it_imitates(robot: str):
    board = EmulatedBoard(robot)
    answer = Host(board).ask(Hello())
    assert isinstance(answer, Identity)
    assert answer.robot == BOARD_ROBOTS[robot] and answer.joints == len(board.robot.joint_names)
    assert answer.board == (BoardKind.UNO if robot == "delta3" else BoardKind.STM32F407)
    assert answer.serial == 1_000_000 + BOARD_ROBOTS[robot]
    assert answer.geometry == geometry_hash(geometry_values(board.robot))
    assert answer.version == "1.0" and answer.reset == Reset.POWER


def test_other_drives_and_numbers():
    board = EmulatedBoard("delta3", drive=DriveKind.DC, serial=77)
    answer = Host(board).ask(Hello())
    assert isinstance(answer, Identity) and (answer.drive, answer.serial) == (DriveKind.DC, 77)
    host = homed("delta3", drive=DriveKind.DC)
    np.testing.assert_allclose(host.board.true_joints, board.robot.inverse(board.robot.home), atol=0.02)


@both_cores
def test_a_robot_or_drive_that_does_not_exist_is_refused(core: Kind):
    with pytest.raises(LinkError, match="no emulated board"):
        EmulatedBoard("scara")
    with pytest.raises(LinkError, match="another drive"):
        EmulatedBoard("linear", drive=DriveKind.SERVO, core=core)


@pytest.mark.parametrize("fault", [Faults(noise=0.01), Faults(loss=0.005), Faults(delay_s=0.03)])
def test_it_goes_where_it_is_sent_on_a_bad_cable(fault: Faults):
    host = homed("delta3")
    host.board.faults = fault
    pose = host.board.robot.home + np.array([0.02, 0.0, 0.01])
    host.stream(TargetKind.POSE, way(host.board.robot.home, pose.tolist(), 100).tolist())
    for _ in range(10):
        host.stream(TargetKind.POSE, [pose.tolist()])
    host.wait(0.3)
    np.testing.assert_allclose(host.board.true_joints, host.board.robot.inverse(pose), atol=1e-5)
    spoilt = bool(fault.noise or fault.loss)
    assert host.telemetry and (host.telemetry.bad > 0) == spoilt == (host.decoder.bad > 0)


def test_a_delay_is_as_long_as_it_is_said_to_be():
    host = Host(EmulatedBoard("delta3", core="twin", faults=Faults(delay_s=0.1), boot_s=0.0))
    host.send(Hello())
    for _ in range(19):
        host.wait(0.01, alive=False)
    assert not host.heard
    host.wait(0.02, alive=False)
    assert len(host.heard) == 1


@pytest.mark.parametrize(
    ("robot", "broken", "wanted"),
    [
        ("par4", Faults(sensor_broken=2), (Fault.SENSOR, 3)),
        ("par4", Faults(stuck_joint=1), (Fault.FOLLOWING, 2)),
        ("linear", Faults(limit_switch=0), (Fault.SWITCH, 1)),
        ("fivebar", Faults(estop=True), (Fault.ESTOP, 0)),
    ],
)
def test_what_breaks_during_motion_is_a_fault(robot: str, broken: Faults, wanted: tuple[Fault, int]):
    host = homed(robot)
    home = host.board.robot.inverse(host.board.robot.home)
    targets = way(home, home + (0.02 if robot == "linear" else 0.4), 80).tolist()
    host.stream(TargetKind.JOINTS, targets[:20])
    host.board.faults = broken
    host.stream(TargetKind.JOINTS, targets[20:] + targets[-1:] * 40)
    assert host.telemetry
    assert (host.telemetry.state, host.telemetry.fault, host.telemetry.fault_joint) == (State.FAULT, *wanted)
    assert not host.board.powered
    host.board.faults = Faults()
    host.wait(0.1)
    assert host.order(Command.CLEAR) == Refusal.OK
    assert host.until(lambda seen: seen.state == State.OFF).fault == Fault.NONE


def test_a_pulled_cable_switches_the_motors_off_and_nothing_is_heard():
    host = homed("par4")
    host.stream(TargetKind.POSE, way(host.board.robot.home, host.board.robot.home + 0.01, 20).tolist())
    host.board.faults = Faults(unplugged=True)
    silent_since = host.telemetry
    host.wait(1.0)
    assert host.telemetry == silent_since
    assert not host.board.powered
    host.board.faults = Faults()
    assert host.until(lambda seen: seen.t_us > 0).state == State.OFF


def test_a_carriage_that_was_held_is_elsewhere_until_it_is_homed_again():
    host = homed("linear")
    board = host.board
    board.faults = Faults(stuck_joint=1)
    pose = board.robot.home + np.array([0.0, 0.0, -0.03])
    host.go(pose.tolist(), 1.5)
    wanted = board.robot.inverse(pose)
    assert board.true_joints[0] == pytest.approx(wanted[0], abs=1e-4)
    assert board.true_joints[1] == pytest.approx(wanted[1] - 0.03, abs=2e-3)
    board.faults = Faults()
    assert host.order(Command.HOME) == Refusal.OK
    host.until(lambda seen: seen.state == State.READY)
    np.testing.assert_allclose(board.true_joints, board.robot.inverse(board.robot.home), atol=1e-4)


@every_robot
def test_a_misaligned_joint_is_elsewhere_than_the_board_believes(robot: str):
    errors = (0.02, -0.01, 0.03, 0.0)[: len(EmulatedBoard(robot).robot.joint_names)]
    host = Host(EmulatedBoard(robot, core="twin", misaligned=errors))
    host.home()
    assert host.telemetry
    believed = np.array(host.telemetry.position[: len(errors)])
    np.testing.assert_allclose(believed - host.board.true_joints, errors, atol=NEAR[robot] / 2)


def test_a_servo_takes_its_time_and_nobody_sees_it():
    """The board believes what it asks for."""
    host = Host(EmulatedBoard("delta3", core="twin"))
    host.wait(0.3)
    before = host.board.true_joints
    host.order(Command.ENABLE)
    assert host.telemetry
    np.testing.assert_allclose(host.telemetry.position[:3], host.board.robot.inverse(host.board.robot.home), atol=1e-6)
    host.wait(0.3)
    assert max(abs(a - b) for a, b in zip(before, host.board.true_joints, strict=True)) > 0.05
    np.testing.assert_allclose(host.board.true_joints, host.telemetry.position[:3], atol=1e-5)


def test_a_uno_loses_what_comes_while_it_boots():
    board = EmulatedBoard("delta3", core="twin", boot_s=0.5)
    host = Host(board)
    host.send(Hello())
    host.wait(0.6)
    assert not host.heard
    host.send(Hello())
    host.wait(0.1)
    assert len(host.heard) == 1
    board.reset()
    host.send(Hello())
    host.wait(0.4)
    assert len(host.heard) == 1
    answer = host.ask(Hello(), within_s=2.0)
    assert isinstance(answer, Identity) and answer.reset == Reset.LINE


@both_cores
def test_settings_survive_a_reset_only_when_saved(core: Kind):
    host = Host(EmulatedBoard("par4", core=core))
    kp = setting_id("kp", 1)
    built_in = host.ask(Get(kp))
    assert host.ask(Set(kp, 123.0)) == Ack(Refusal.OK, 123.0)
    host.board.reset()
    assert host.ask(Get(kp)) == built_in
    host.ask(Set(kp, 123.0))
    assert host.order(Command.SAVE) == Refusal.OK
    host.board.reset(Reset.WATCHDOG)
    assert host.ask(Get(kp)) == Ack(Refusal.OK, 123.0)
    assert host.telemetry and host.telemetry.fault == Fault.WATCHDOG


def test_a_reset_while_it_moves_leaves_it_off_and_not_homed():
    host = homed("par4")
    host.stream(TargetKind.POSE, way(host.board.robot.home, host.board.robot.home + 0.01, 20).tolist())
    host.board.reset()
    assert not host.board.powered
    host.wait(0.05)
    assert host.telemetry and host.telemetry.state == State.OFF and not host.telemetry.flags
    host.send(Setpoint(TargetKind.POSE, tuple(host.board.robot.home.tolist())))
    assert host.until(lambda seen: seen.refusal).refusal == Refusal.NOT_ENABLED


def test_pen_and_laser_do_as_they_are_told():
    host = homed("delta3")
    pose = tuple((host.board.robot.home + 0.001).tolist())
    assert (host.board.pen, host.board.laser) == (False, 0.0)
    host.send(Setpoint(TargetKind.POSE, pose, pen_down=True, laser=51))
    host.board.advance(0.01)
    assert host.board.pen and host.board.laser == pytest.approx(0.2)
    host.wait(0.3)
    assert host.board.pen and host.board.laser == 0.0


@both_cores
def test_a_pulse_is_recorded_and_moves_its_joint_only(core: Kind):
    host = homed("par4", core)
    before = host.board.true_joints
    assert isinstance(answer := host.ask(Test(TestKind.PULSE, 2, 0.5, 200)), Ack) and answer.result == Refusal.OK
    host.until(lambda seen: seen.state == State.READY)
    samples = [m for m, _ in host.heard if isinstance(m, Sample)]
    assert len(samples) == pytest.approx(50, abs=2)
    assert {sample.joint for sample in samples} == {2} and samples[5].drive == pytest.approx(0.5)
    moved = np.abs(np.subtract(host.board.true_joints, before))
    assert moved[2] > 0.008 and max(moved[[0, 1, 3]]) < 0.003
    times = np.diff([sample.t_us for sample in samples])
    assert set(times.tolist()) <= {4000}


def test_the_same_calls_give_the_same_bytes():
    def life() -> bytes:
        board = EmulatedBoard("delta3", core="twin", drive=DriveKind.DC, faults=Faults(noise=0.02, loss=0.01))
        host, said = Host(board), b""
        for step in range(200):
            host.send(Hello())
            board.advance(0.007)
            said += board.transmit()
            board.faults = replace(board.faults, delay_s=0.001 * (step % 5))
        return said

    assert life() == life()


def test_time_is_made_of_whole_periods_and_none_is_lost():
    board = EmulatedBoard("delta3", core="twin")
    for _ in range(1000):
        board.advance(0.0013)
    assert board.time_s == pytest.approx(1.3, abs=0.0051)
