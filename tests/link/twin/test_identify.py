"""A motor found in the samples of pulses, by exact solutions of its equation; steps in the control lab's numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from app.control import Motor
from app.control.drives import DRIVES
from app.link.errors import LinkError
from app.link.protocol.codes import TestKind
from app.link.protocol.messages import Test
from app.link.twin.identify import identify_drive
from app.link.twin.pulses import GUARD, pulse_plan
from app.link.twin.recording import Recording, TestSamples
from app.link.twin.steps import measured_step
from app.robots import make_robot

Array = NDArray[np.float64]

NONE = np.empty(0)


def recording(robot: str, t: Array, y: Array, drive: Array, joint: int = 0) -> Recording:
    factor = 1e-3 if robot == "linear" else math.pi / 180.0
    empty = NONE.reshape(0, 4)
    close = TestSamples(joint, t, factor * y, drive)
    codes = NONE.astype(int)
    return Recording(robot, "", NONE, empty, empty, empty, codes, codes, NONE, DRIVES[robot].supply_v, close)


def driven(motor: Motor, volts: float, t: Array, y0: float = 0.0, v0: float = 0.0) -> Array:
    """The exact answer of a motor without droop to a constant voltage."""
    final = motor.K * volts / motor.T1
    return y0 + final * t + (v0 - final) * (1.0 - np.exp(-motor.T1 * t)) / motor.T1


def pulses(robot: str, motor: Motor, noise: float, seed: int = 0) -> Recording:
    built, drive, rng = make_robot(robot), DRIVES[robot], np.random.default_rng(seed)
    plan = pulse_plan(0, float(built.inverse(built.home)[0]), built.joint_limits[0], drive)
    parts, start = [], 1.0
    for test in plan:
        count = test.duration_ms // 4 + 1
        t = np.linspace(0.0, 0.004 * (count - 1), count)
        y = driven(motor, test.amplitude * drive.supply_v, t, 5.0, 2.0) + rng.normal(0.0, noise, len(t))
        parts.append((start + t, y, np.full(len(t), test.amplitude)))
        start += t[-1] + 0.7
    return recording(robot, *joined(parts))


def joined(parts: list[tuple[Array, Array, Array]]) -> tuple[Array, Array, Array]:
    t, y, drive = (np.concatenate(column) for column in zip(*parts, strict=True))
    return t, y, drive


def assert_same(found: Motor, true: Motor, rel: float) -> None:
    np.testing.assert_allclose([found.K, found.T1, found.T2], [true.K, true.T1, true.T2], rtol=rel)


@pytest.mark.parametrize("robot", ["delta3", "linear", "fivebar"])
def test_the_motor_comes_out_of_pulses(robot):
    motor = DRIVES[robot].motor
    found = identify_drive([pulses(robot, motor, 0.0)]).found.motor
    assert_same(found, motor, 1e-5)
    assert found.unit == motor.unit


def test_the_intervals_hold_the_motor_at_their_rate():
    motor = DRIVES["delta3"].motor
    hits = []
    for seed in range(25):
        found = identify_drive([pulses("delta3", motor, 0.05, seed)]).found
        hits += [
            low <= value <= high for value, (low, high) in zip((motor.K, motor.T1), found.confidence, strict=False)
        ]
    assert 0.85 <= np.mean(hits) <= 1.0


def test_droop_is_found_where_there_is_droop_and_only_there():
    """y'' + T1 y' + T2 y = K u by its two exponentials."""
    motor = DRIVES["par4"].motor
    t = np.linspace(0.0, 1.196, 300)
    slow, fast = sorted(np.roots([1.0, motor.T1, motor.T2]).real, key=abs)
    parts = []
    for number, share in enumerate((0.8, -0.8)):
        rest, y0 = motor.K * 12.0 * share / motor.T2, 20.0
        a = (y0 - rest) * fast / (fast - slow)
        parts.append(
            (2.0 * number + t, rest + a * np.exp(slow * t) + (y0 - rest - a) * np.exp(fast * t), 0 * t + share)
        )
    found = identify_drive([recording("par4", *joined(parts))]).found.motor
    assert_same(found, motor, 1e-3)
    plain = pulses("delta3", DRIVES["delta3"].motor, 0.05)
    assert identify_drive([plain]).found.motor.T2 == 0.0


def test_lost_messages_and_several_recordings_do_no_harm():
    motor = DRIVES["delta3"].motor
    whole = pulses("delta3", motor, 0.0)
    assert whole.samples is not None
    kept = np.ones(len(whole.samples.t), dtype=bool)
    kept[[25, 90, 91]] = False
    s = whole.samples
    holed = recording("delta3", s.t[kept], np.degrees(s.position[kept]), s.drive[kept])
    result = identify_drive([holed, whole])
    assert_same(result.found.motor, motor, 1e-5)
    assert (np.diff(result.recording.t) > 0.0).all() and result.recording.unit == "deg"
    np.testing.assert_allclose(np.abs(result.recording.u).max(), 0.8 * 6.0)


def test_what_holds_no_motor_is_refused():
    good = pulses("delta3", DRIVES["delta3"].motor, 0.0)
    s = good.samples
    assert s is not None
    still = recording("delta3", s.t, np.ones(len(s.t)), s.drive)
    short = recording("delta3", s.t[:10], s.position[:10], s.drive[:10])
    backward = recording("delta3", s.t, -np.degrees(s.position), s.drive)
    other = recording("delta3", s.t, np.degrees(s.position), s.drive, joint=1)
    for made, complaint in [(still, "longer"), (short, "longer"), (backward, "wires")]:
        with pytest.raises(LinkError, match=complaint):
            identify_drive([made])
    with pytest.raises(LinkError, match="different joints"):
        identify_drive([good, other])
    with pytest.raises(LinkError, match="run a pulse"):
        identify_drive([])


@pytest.mark.parametrize("robot", DRIVES)
@pytest.mark.parametrize("stronger", [1.0, 1.3])
def test_pulses_stay_inside_the_limits_even_with_a_stronger_motor(robot, stronger):
    drive, built = DRIVES[robot], make_robot(robot)
    factor = 1e-3 if robot == "linear" else math.pi / 180.0
    low, high = built.joint_limits[0]
    for place in np.linspace(low + 0.15 * (high - low), high - 0.15 * (high - low), 15):
        position = float(place)
        for test in pulse_plan(0, position, (low, high), drive):
            t = np.linspace(0.0, 1e-3 * test.duration_ms, 50)
            motor = Motor(stronger * drive.motor.K, drive.motor.T1)
            way = factor * driven(motor, test.amplitude * drive.supply_v, t)
            assert low + GUARD <= (position + way).min() and (position + way).max() <= high - GUARD
            assert abs(way[-1]) > 0.01 and test.duration_ms >= 160
            # and while it coasts to rest afterwards
            speed = (way[-1] - way[-2]) / (t[-1] - t[-2])
            assert low <= position + way[-1] + speed / drive.motor.T1 <= high
            position += float(way[-1])


def test_a_joint_at_its_limit_gets_no_pulse():
    with pytest.raises(LinkError, match="middle"):
        pulse_plan(1, 0.77, (-0.785, 0.785), DRIVES["par4"])


def test_a_step_is_measured_in_degrees_and_volts():
    """A first-order answer: 10 to 90 % in T ln 9, settled to 2 % after T ln 50."""
    t = np.linspace(0.0, 1.596, 400)
    y = 30.0 + 10.0 * (1.0 - np.exp(-t / 0.1))
    made = recording("par4", 2.0 + t, y, np.exp(-t), joint=1)
    step = measured_step(made, Test(TestKind.STEP, 1, math.radians(10.0), 1600))
    assert step.metrics.rise_s == pytest.approx(0.1 * math.log(9.0), rel=0.01)
    assert step.metrics.settling_s == pytest.approx(0.1 * math.log(50.0), abs=0.005)
    assert (step.unit, step.setpoint, step.u[0]) == ("deg", pytest.approx(10.0), 12.0)
    with pytest.raises(LinkError, match="step test"):
        measured_step(made, Test(TestKind.PULSE, 1, 0.1, 1600))
