"""Homing and moving, seen on the joints themselves and not only in what the board says."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from app.link.protocol.codes import Command, Flag, Refusal, State, TargetKind
from app.link.protocol.messages import Setpoint
from app.robots import make_robot
from tests.support.emulators.uno.build import VARIANTS, needs_uno
from tests.support.emulators.uno.plants import HOME_M, HOME_RAD, LASER, PEN, SWITCHES, StepperPlant
from tests.support.emulators.uno.rig import Rig

pytestmark = needs_uno
NewRig = Callable[..., Rig]
HOME = {"delta3_servo": HOME_RAD, "delta3_dc": HOME_RAD, "linear_stepper": HOME_M}
SWING = {"delta3_servo": 0.3, "delta3_dc": 0.3, "linear_stepper": 0.03}
CLOSE = {"delta3_servo": 0.01, "delta3_dc": 0.02, "linear_stepper": 0.0003}


@pytest.mark.parametrize("variant", VARIANTS)
def test_homing_and_a_path_move_the_real_joints(new_rig: NewRig, variant: str) -> None:
    rig, home, swing = new_rig(variant), HOME[variant], SWING[variant]
    rig.make_ready()
    rig.run(0.2)
    np.testing.assert_allclose(rig.plant.joints, home, atol=CLOSE[variant])
    assert rig.telemetry.flags == Flag.HOMED | Flag.POWERED

    def path(t: float) -> tuple[float, ...]:
        return tuple(home + swing * (1 - math.cos(3 * min(t, 1.0))) * side for side in (1.0, 0.5, -0.2))

    rig.follow(path, 1.0)
    assert rig.telemetry.state == State.MOVING
    goal = path(1.0)
    rig.follow(lambda t: goal, 0.2)  # a host stays until the board has arrived
    assert rig.telemetry.state == State.READY
    rig.run(0.2)
    np.testing.assert_allclose(rig.plant.joints, goal, atol=CLOSE[variant])
    np.testing.assert_allclose(rig.telemetry.setpoint[:3], goal, rtol=1e-6)
    assert rig.missed_ticks == 0


def test_the_board_solves_poses_as_the_app_does(new_rig: NewRig) -> None:
    robot = make_robot("delta3")
    rig = new_rig("delta3_dc")
    rig.make_ready()
    goal = robot.home[:3] + np.array([0.01, -0.005, 0.008])
    for k in range(1, 41):
        pose = robot.home[:3] + k / 40 * (goal - robot.home[:3])
        rig.send(Setpoint(TargetKind.POSE, tuple(pose.tolist())))
        rig.run(0.01)
    rig.run(0.3)
    np.testing.assert_allclose(rig.telemetry.setpoint[:3], robot.inverse(goal), atol=1e-5)
    np.testing.assert_allclose(rig.plant.joints, robot.inverse(goal), atol=0.01)


def test_a_pose_needs_homing(new_rig: NewRig) -> None:
    rig = new_rig("delta3_dc")
    rig.make_ready(home=False)
    rig.send(Setpoint(TargetKind.POSE, (0.0, 0.0, -0.33)))
    rig.run(0.05)
    assert (rig.telemetry.state, rig.telemetry.refusal) == (State.READY, Refusal.NOT_HOMED)


def test_steppers_find_their_switches_and_count_from_there(new_rig: NewRig) -> None:
    rig = new_rig("linear_stepper", StepperPlant(joints=[0.002, 0.010, 0.006]))
    rig.make_ready()
    rig.run(0.1)
    np.testing.assert_allclose(rig.plant.joints, HOME_M, atol=0.0004)
    np.testing.assert_allclose(rig.telemetry.position[:3], rig.plant.joints, atol=0.0004)


def test_steppers_make_7000_steps_a_second_without_losing_one(new_rig: NewRig) -> None:
    rig = new_rig("linear_stepper", StepperPlant(joints=[0.001] * 3))
    rig.make_ready()
    rig.run(0.1)
    joints, told = np.array(rig.plant.joints), np.array(rig.telemetry.position[:3])
    rig.follow(lambda t: (HOME_M + 0.175 * min(t, 0.8),) * 3, 1.0)
    rig.run(0.1)
    np.testing.assert_allclose(rig.telemetry.position[:3], HOME_M + 0.14, atol=26e-6)
    np.testing.assert_allclose(rig.plant.joints - joints, rig.telemetry.position[:3] - told, atol=1e-6)
    assert rig.missed_ticks == 0


def test_servos_get_the_pulses_of_their_angles(new_rig: NewRig) -> None:
    rig = new_rig("delta3_servo")
    rig.make_ready()
    rig.follow(lambda t: (HOME_RAD + 0.5 * min(t, 0.4), HOME_RAD, HOME_RAD - 0.5 * min(t, 0.4)), 0.5)
    rig.run(0.1)
    angles = HOME_RAD + np.array([0.2, 0.0, -0.2])
    pulses = [rig.uno.pulse_us(pin) for pin in (9, 10, 11)]
    np.testing.assert_allclose(pulses, 1500 + angles * 2000 / math.pi, atol=10)  # another interrupt may come between
    assert rig.order(Command.OFF) == Refusal.OK
    rises = rig.uno.rises(9)
    rig.run(0.1)
    assert rig.uno.rises(9) <= rises + 1  # limp


def test_pen_and_laser_follow_the_set_points(new_rig: NewRig) -> None:
    rig = new_rig("delta3_dc")
    rig.make_ready()
    rig.follow(lambda t: (HOME_RAD + t, HOME_RAD, HOME_RAD), 0.2, pen_down=True, laser=128)
    assert rig.uno.pwm(LASER) == pytest.approx(0.5, abs=0.01)
    assert rig.uno.pulse_us(PEN) == pytest.approx(1700, abs=10)
    assert Flag.PEN_DOWN | Flag.LASER_ON in rig.telemetry.flags
    rig.order(Command.STOP)
    rig.run(0.03)
    assert rig.uno.pwm(LASER) == 0.0
    assert rig.uno.pulse_us(PEN) == pytest.approx(1700, abs=10)
    rig.order(Command.OFF)
    rig.run(0.06)
    assert rig.uno.pulse_us(PEN) == pytest.approx(1300, abs=10)


def test_targets_beyond_the_limits_or_too_far_are_refused(new_rig: NewRig) -> None:
    rig = new_rig("delta3_servo")
    rig.make_ready()
    for target, refusal in (((1.6, 0.2, 0.2), Refusal.LIMIT), ((1.4, 0.2, 0.2), Refusal.JUMP)):
        rig.send(Setpoint(TargetKind.JOINTS, target))
        rig.run(0.05)
        assert (rig.telemetry.state, rig.telemetry.refusal) == (State.READY, refusal)
    assert max(rig.plant.joints) < 0.2
    rig.send(Setpoint(TargetKind.JOINTS, (math.nan, 0.2, 0.2)))
    rig.run(0.05)
    assert rig.telemetry.refusal == Refusal.VALUE


def test_switches_are_told(new_rig: NewRig) -> None:
    rig = new_rig("delta3_dc")
    rig.run(0.03)
    for j, pin in enumerate(SWITCHES):
        rig.uno.drive_pin(pin, False)
        rig.run(0.05)
        assert rig.telemetry.limit_switches == 1 << j
        rig.uno.drive_pin(pin, True)
