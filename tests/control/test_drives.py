"""Every robot has a drive that fits it."""

from __future__ import annotations

import numpy as np
import pytest

from app.control import PAR4_MOTOR, Pid
from app.control.drives import DRIVES, Drive
from app.control.frequency import OpenLoop
from app.control.margins import margins
from app.control.sampled_pid import Sampling
from app.robots import ROBOTS, make_robot
from app.simulation import Task
from app.simulation.run import SHOWN
from app.simulation.tracking import resting_joints


def reasonable(drive: Drive, share: float = 0.05) -> Pid:
    """A PID whose crossover lies at a share of the controller's sampling frequency."""
    motor, crossover = drive.motor, share * 2.0 * np.pi / drive.period_s
    kp = crossover * abs(complex(motor.T1, crossover)) / motor.K / 1.5
    return Pid(kp, 0.1 * crossover * kp, kp / crossover, 10.0 * crossover)


def test_every_robot_has_exactly_one():
    assert list(DRIVES) == list(ROBOTS)
    assert DRIVES["par4"].motor is PAR4_MOTOR


@pytest.mark.parametrize("name", ROBOTS)
def test_the_drive_moves_in_the_unit_its_joints_are_read_in(name: str):
    drive, robot = DRIVES[name], make_robot(name)
    assert drive.unit == drive.motor.unit == SHOWN[robot.joint_units[0]][0]
    assert {SHOWN[unit][0] for unit in robot.joint_units} == {drive.unit}


@pytest.mark.parametrize("name", ["par4", "delta3", "linear"])
def test_the_sensor_sees_the_whole_travel(name: str):
    robot = make_robot(name)
    low, high = robot.joint_limits.T * SHOWN[robot.joint_units[0]][1]
    assert ((high - low) <= DRIVES[name].sensor_range).all()


@pytest.mark.parametrize("name", ROBOTS)
def test_the_suggested_step_stays_within_the_joint_limits(name: str):
    drive, robot = DRIVES[name], Task(robot=name).build()
    factor = SHOWN[robot.joint_units[0]][1]
    rest, (low, high) = resting_joints(robot) * factor, robot.joint_limits.T * factor
    fits = (rest + drive.setpoint <= high) | (rest - drive.setpoint >= low)
    assert drive.setpoint > 0.0 and fits.all()


@pytest.mark.parametrize(
    ("name", "speed", "time_constant_s"),
    [("delta3", 300.0, 0.050), ("linear", 600.0, 0.060), ("fivebar", 448.0, 0.015)],
)
def test_the_declared_motors_have_the_figures_of_their_notes(name: str, speed: float, time_constant_s: float):
    drive = DRIVES[name]
    assert drive.motor.K / drive.motor.T1 * drive.supply_v == pytest.approx(speed, rel=0.01)
    assert pytest.approx(1.0 / time_constant_s, rel=0.02) == drive.motor.T1
    assert f"{speed:g}" in drive.note and "Declared" in drive.note
    assert drive.motor.T2 == 0.0


@pytest.mark.parametrize("name", ROBOTS)
def test_a_reasonable_pid_makes_a_stable_loop_at_the_drives_period(name: str):
    drive = DRIVES[name]
    found = margins(OpenLoop(drive.motor, reasonable(drive), 0.0, Sampling(drive.period_s)))
    assert found.stable and found.phase_margin_deg > 30.0 and found.gain_margin > 2.0


@pytest.mark.parametrize("name", ROBOTS)
def test_the_reading_is_finer_than_a_hundredth_of_the_suggested_step(name: str):
    drive = DRIVES[name]
    assert drive.sensor_range / 2**drive.adc_bits < drive.setpoint / 50
