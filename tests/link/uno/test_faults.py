"""What goes wrong on a real robot, and how an Uno stops then."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from app.link.protocol.codes import Command, Fault, Flag, Refusal, State, TargetKind
from app.link.protocol.messages import Setpoint
from tests.support.emulators.uno.build import VARIANTS, needs_uno
from tests.support.emulators.uno.plants import ESTOP, HOME_RAD, POWER, SWITCHES, DcPlant, StepperPlant
from tests.support.emulators.uno.rig import Rig

pytestmark = needs_uno
NewRig = Callable[..., Rig]


def wave(t: float) -> tuple[float, ...]:
    return (HOME_RAD + 0.3 * math.sin(5 * t),) * 3


def assert_fault(rig: Rig, fault: Fault, joint: int = 0) -> None:
    told = rig.telemetry
    assert (told.state, told.fault, told.fault_joint) == (State.FAULT, fault, joint)
    assert Flag.POWERED not in told.flags and not rig.uno.level(POWER)


@pytest.mark.parametrize("variant", VARIANTS)
def test_the_emergency_stop_takes_the_power_within_two_ticks(new_rig: NewRig, variant: str) -> None:
    rig = new_rig(variant)
    rig.make_ready(home=False)
    unpowered = variant == "linear_stepper"
    assert rig.uno.level(POWER) != unpowered
    rig.uno.drive_pin(ESTOP, True)
    assert rig.until(lambda: rig.uno.level(POWER) == unpowered, 0.1) <= 0.010
    rig.wait_for(State.FAULT)
    assert rig.telemetry.fault == Fault.ESTOP
    assert rig.order(Command.CLEAR) == Refusal.ESTOP
    rig.uno.drive_pin(ESTOP, False)
    rig.run(0.05)
    assert rig.telemetry.state == State.FAULT  # nothing resumes by itself
    assert rig.order(Command.CLEAR) == Refusal.OK
    rig.wait_for(State.OFF)


def test_a_broken_wire_of_a_potentiometer_is_noticed(new_rig: NewRig) -> None:
    plant = DcPlant()
    rig = new_rig("delta3_dc", plant)
    rig.make_ready()
    rig.follow(wave, 0.1)
    plant.broken_wire = 1
    rig.follow(lambda t: wave(t + 0.1), 0.05)
    assert_fault(rig, Fault.SENSOR, joint=2)


def test_a_stuck_joint_is_noticed(new_rig: NewRig) -> None:
    plant = DcPlant()
    rig = new_rig("delta3_dc", plant)
    rig.make_ready()
    plant.stuck = 2
    rig.follow(lambda t: (HOME_RAD + min(0.8 * t, 0.4),) * 3, 1.2)
    assert_fault(rig, Fault.FOLLOWING, joint=3)


def test_a_limit_switch_stops_a_motion(new_rig: NewRig) -> None:
    rig = new_rig("delta3_dc")
    rig.make_ready()
    rig.follow(wave, 0.1)
    rig.uno.drive_pin(SWITCHES[0], False)
    rig.follow(lambda t: wave(t + 0.1), 0.05)
    assert_fault(rig, Fault.SWITCH, joint=1)


def test_a_joint_pushed_beyond_its_limits_loses_power(new_rig: NewRig) -> None:
    plant = DcPlant()
    rig = new_rig("delta3_dc", plant)
    rig.make_ready()
    plant.joints[0] = math.radians(95)
    rig.run(0.03)
    assert_fault(rig, Fault.LIMIT, joint=1)


def test_a_stepper_whose_switch_never_closes_gives_up(new_rig: NewRig) -> None:
    rig = new_rig("linear_stepper", StepperPlant(dead_switch=1))
    assert rig.set(19, 0.01) == rig.set(15, 0.02) == Refusal.OK  # home and end of joint 2: a short rail
    rig.live(True)
    assert rig.order(Command.ENABLE) == rig.order(Command.HOME) == Refusal.OK
    rig.wait_for(State.FAULT, 3.0)
    assert (rig.telemetry.fault, rig.telemetry.fault_joint) == (Fault.HOMING, 2)
    assert rig.uno.level(POWER)  # high is off for the drivers
    assert rig.plant.joints[1] > -0.025


def test_when_set_points_stop_the_joints_stand_within_200_ms(new_rig: NewRig) -> None:
    rig = new_rig("delta3_dc")
    rig.make_ready()
    rig.follow(lambda t: (HOME_RAD + 2.0 * t,) * 3, 0.3)
    rig.send(Setpoint(TargetKind.JOINTS, (HOME_RAD + 0.6 + 0.8,) * 3))  # far: it is still on its way when time is up
    rig.run(0.09)
    before = np.array(rig.plant.joints)
    rig.run(0.01)
    assert (np.array(rig.plant.joints) - before > 0.02).all()  # more than 2 rad/s
    rig.run(0.1)
    stopped = np.array(rig.plant.joints)
    assert (stopped < HOME_RAD + 0.6 + 0.75).all()
    rig.run(0.1)
    np.testing.assert_allclose(rig.plant.joints, stopped, atol=0.05)
    assert rig.telemetry.state == State.HELD
    assert Flag.POWERED in rig.telemetry.flags
    rig.send(Setpoint(TargetKind.JOINTS, wave(0.0)))
    rig.run(0.05)
    assert (rig.telemetry.state, rig.telemetry.refusal) == (State.HELD, Refusal.HELD)
    assert rig.order(Command.FOLLOW) == Refusal.OK
    rig.wait_for(State.READY)


def test_a_silent_host_ends_in_off_after_half_a_second(new_rig: NewRig) -> None:
    rig = new_rig("delta3_dc")
    rig.make_ready()
    rig.follow(wave, 0.1)
    rig.live(False)
    rig.run(0.45)
    assert rig.telemetry.state == State.HELD
    off_s = 0.45 + rig.until(lambda: not rig.uno.level(POWER), 0.2)
    assert 0.48 < off_s < 0.55
    rig.wait_for(State.OFF)
