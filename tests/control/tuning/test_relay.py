"""Relay autotuning against the sampled loop's own phase crossover and the describing function."""

from __future__ import annotations

import math
import time

import control
import numpy as np
import pytest

from app.control.motor import PAR4_MOTOR, Motor
from app.control.tuning.reaction_curve import TuningError
from app.control.tuning.relay import RelayTest, relay_test

PERIOD_S = 0.01
MOTORS = [PAR4_MOTOR, Motor(9.4, 3.6), Motor(3.0, 1.0, 0.5)]
DELAYS_S = [0.02, 0.05, 0.1]


def delayed(motor: Motor, delay_s: float) -> control.TransferFunction:
    steps = round(delay_s / PERIOD_S)
    return motor.sampled(PERIOD_S) * control.tf([1.0], [1.0] + [0.0] * steps, PERIOD_S)


def ultimate(motor: Motor, delay_s: float) -> tuple[float, float]:
    """(Ku, Tu) where the phase of the sampled loop passes -180 degrees."""
    w = np.linspace(0.3, 60.0, 20_000)
    response = delayed(motor, delay_s)(np.exp(1j * w * PERIOD_S))
    phase = np.unwrap(np.angle(response))
    crossing = int(np.argmax(phase < -math.pi))
    assert crossing > 0
    return float(1.0 / abs(response[crossing])), float(math.tau / w[crossing])


@pytest.mark.parametrize("motor", MOTORS, ids=str)
@pytest.mark.parametrize("delay_s", DELAYS_S)
def test_ultimate_gain_within_10_percent_and_period_within_7(motor, delay_s):
    """The error left is the describing function's: the swing is not quite a sine."""
    test = relay_test(motor, delay_s=delay_s, duration_s=20.0)
    Ku, Tu = ultimate(motor, delay_s)
    assert test.Ku == pytest.approx(Ku, rel=0.10)
    assert test.Tu == pytest.approx(Tu, rel=0.07)


@pytest.mark.parametrize("hysteresis", [0.05, 0.2, 2.0])
@pytest.mark.parametrize("motor", MOTORS, ids=str)
def test_hysteresis_moves_the_swing_along_the_describing_function(motor, hysteresis):
    """G(jw) = -pi / (4 d) (sqrt(a^2 - eps^2) + j eps), within 6 %."""
    test = relay_test(motor, 6.0, hysteresis, delay_s=0.05, duration_s=60.0)
    response = delayed(motor, 0.05)(np.exp(2j * math.pi / test.Tu * PERIOD_S))
    expected = complex(-1.0 / test.Ku, -math.pi * hysteresis / 24.0)
    assert abs(response - expected) < 0.06 * abs(expected)


def test_ultimate_gain_is_read_off_the_last_swings():
    """4 d / (pi sqrt(a^2 - eps^2)), the swing being far from small beside the hysteresis."""
    test = relay_test(PAR4_MOTOR, 6.0, 2.0, duration_s=20.0)
    tail = test.y[1200:]
    swing = (tail.max() - tail.min()) / 2.0
    assert 0.4 * swing < 2.0 < swing
    assert test.Ku == pytest.approx(24.0 / (math.pi * math.sqrt(swing**2 - 4.0)), rel=0.01)


def test_the_hold_alone_makes_a_second_order_motor_swing():
    test = relay_test(PAR4_MOTOR)
    assert 0.2 < test.Tu < 0.3
    assert set(np.unique(test.u)) == {-6.0, 6.0}
    assert test.t.shape == test.u.shape == test.y.shape == (1000,)
    assert test.t[-1] == pytest.approx(9.99)


def test_more_volts_swing_wider_but_tell_the_same():
    small, large = relay_test(PAR4_MOTOR, 3.0, delay_s=0.05), relay_test(PAR4_MOTOR, 12.0, delay_s=0.05)
    assert large.y.max() == pytest.approx(4.0 * small.y.max(), rel=1e-9)
    assert [large.Ku, large.Tu] == pytest.approx([small.Ku, small.Tu], rel=1e-9)


@pytest.mark.parametrize("delay_s", DELAYS_S)
@pytest.mark.parametrize("motor", MOTORS, ids=str)
def test_tyreus_luyben_is_stable_and_calmer_than_ziegler_nichols(motor, delay_s):
    """The sampled loop with the delay, the controller held as well."""
    test = relay_test(motor, delay_s=delay_s, duration_s=20.0)
    margins = []
    for pid in (test.tyreus_luyben(), test.ziegler_nichols()):
        controller = control.sample_system(pid.transfer_function(), PERIOD_S, method="tustin")
        loop = controller * delayed(motor, delay_s)
        assert np.abs(control.poles(control.feedback(loop, 1))).max() < 1.0
        w = np.geomspace(0.1, 300.0, 5000)
        margins.append(np.abs(1.0 + loop(np.exp(1j * w * PERIOD_S))).min())
    assert margins[0] > margins[1] > 0.15


def test_gains_from_the_ultimate_point():
    nothing = np.zeros(0)
    test = RelayTest(nothing, nothing, nothing, 1.0, 0.0, Ku=2.2, Tu=6.3)
    lively, calm = test.ziegler_nichols(), test.tyreus_luyben(n=50.0)
    assert [lively.kp, lively.Ti, lively.Td, lively.n] == pytest.approx([1.32, 3.15, 0.7875, 100.0])
    assert [calm.kp, calm.Ti, calm.Td, calm.n] == pytest.approx([1.0, 13.86, 1.0, 50.0])


@pytest.mark.parametrize(("hysteresis", "duration_s"), [(0.0, 0.3), (400.0, 60.0), (20.0, 10.0)])
def test_no_swing_is_said_so(hysteresis, duration_s):
    with pytest.raises(TuningError, match="swing"):
        relay_test(PAR4_MOTOR, 6.0, hysteresis, duration_s=duration_s)


@pytest.mark.parametrize("values", [{"amplitude": 0.0}, {"hysteresis": -1.0}, {"delay_s": -0.1}])
def test_impossible_relays_are_refused(values):
    with pytest.raises(ValueError, match="amplitude"):
        relay_test(PAR4_MOTOR, **values)


def test_twenty_seconds_take_less_than_fifty_milliseconds():
    def seconds() -> float:
        start = time.perf_counter()
        relay_test(PAR4_MOTOR, duration_s=20.0)
        return time.perf_counter() - start

    assert min(seconds() for _ in range(5)) < 0.05
