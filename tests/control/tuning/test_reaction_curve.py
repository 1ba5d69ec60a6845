"""The tangent at the inflection: golden values, Table 3 digit for digit, and recordings that have no such tangent."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.control.motor import PAR4_MOTOR, Motor
from app.control.tuning.reaction_curve import TuningError, exact, from_step, paper_reaction_curve
from app.control.tuning.rules import paper
from tests.robots.golden import golden

GOLDEN = golden("motor_steps")["reaction_curve"]


def test_closed_form_reproduces_the_golden_values():
    curve, expected = exact(PAR4_MOTOR), GOLDEN["exact"]
    found = [curve.t_inflection, curve.y_inflection, curve.slope, curve.k, curve.T0, curve.T]
    wanted = [expected[name] for name in ("t_inflection", "y_inflection", "slope", "k", "T0", "T")]
    assert found == pytest.approx(wanted, rel=1e-9)


def test_paper_emulation_reproduces_the_golden_values():
    curve, expected = paper_reaction_curve(), GOLDEN["paper_emulation"]
    assert [curve.k, curve.T0, curve.T] == pytest.approx([expected[name] for name in ("k", "T0", "T")], rel=1e-9)


def test_table_3_digit_for_digit():
    curve = paper_reaction_curve()
    pid = paper(curve)
    printed = [f"{value:.4f}" for value in (curve.k, curve.T0, curve.T, pid.kp, pid.Ti, pid.Td)]
    assert printed == ["52.5561", "0.2445", "20.9963", "2.2880", "0.3178", "0.1222"]


def step(motor: Motor, t: np.ndarray, volts: float) -> np.ndarray:
    """The step response by partial fractions, for two different real poles."""
    fast, slow = motor.poles.real
    k = motor.K / (fast * slow)
    return volts * k * (1.0 - (fast * np.exp(slow * t) - slow * np.exp(fast * t)) / (fast - slow))


@given(st.floats(0.05, 2.0), st.floats(1.3, 200.0), st.floats(0.01, 1e3), st.sampled_from([-5.0, 0.1, 1.0, 24.0]))
def test_a_fine_recording_agrees_with_the_closed_form(slow, ratio, gain, volts):
    fast = slow * ratio
    motor = Motor(gain, slow + fast, slow * fast)
    curve = exact(motor)
    t = np.concatenate([np.linspace(0.0, 3.0 * curve.t_inflection, 4001), np.linspace(4.0, 20.0, 200) / slow])
    t = np.unique(t)
    recorded = from_step(t, step(motor, t, volts), volts)
    assert recorded.k == pytest.approx(curve.k, rel=1e-6)
    assert recorded.slope == pytest.approx(curve.slope, rel=1e-5)
    assert abs(recorded.T0 / curve.T0 - 1.0) < 1e-3


def test_two_equal_poles_are_the_limit_of_two_close_ones():
    equal, close = exact(Motor(3.0, 4.0, 4.0)), exact(Motor(3.0, 4.0, 4.0 - 1e-9))
    assert equal.t_inflection == pytest.approx(0.5)
    assert equal.slope == pytest.approx(1.5 / math.e)
    assert np.allclose([close.T0, close.T], [equal.T0, equal.T], rtol=1e-6, atol=0)


@pytest.mark.parametrize(
    ("motor", "advice"),
    [
        (replace(PAR4_MOTOR, T2=0.0), "SIMC"),
        (Motor(1.0, 1.0, 5.0), "loop shaping"),
        (Motor(1.0, -1.0, 5.0), "T1"),
        (Motor(1.0, 1.0, -0.1), "T2"),
    ],
)
def test_motors_without_a_reaction_curve(motor, advice):
    with pytest.raises(TuningError, match=advice):
        exact(motor)


T = np.linspace(0.0, 10.0, 1001)


@pytest.mark.parametrize(
    ("y", "advice"),
    [
        (T - (1.0 - np.exp(-T)), "still climbing"),
        (1.0 - np.exp(-T), "loop shaping"),
        (-step(Motor(1.0, 3.0, 2.0), T, 1.0), "sign"),
        (np.zeros_like(T), "sign"),
    ],
)
def test_recordings_without_a_reaction_curve(y, advice):
    with pytest.raises(TuningError, match=advice):
        from_step(T, y)


def test_rows_of_different_length_are_refused():
    with pytest.raises(ValueError, match="same length"):
        from_step(T, T[:-1])


def test_a_step_of_no_volts_is_refused():
    with pytest.raises(ValueError, match="0 V"):
        from_step(T, T, 0.0)
