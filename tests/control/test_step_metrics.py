"""Step metrics against closed forms and against python-control."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.control.step_metrics import StepMetrics, step_metrics
from tests.support.oracles import control

UNTIMED = settings(deadline=None)
SETPOINTS = st.sampled_from([1.0, 25.0, -40.0])


def first_order(tau: float, setpoint: float, duration: float = 20.0, count: int = 20001) -> tuple[StepMetrics, float]:
    t = np.linspace(0.0, duration * tau, count)
    y = setpoint * (1.0 - np.exp(-t / tau))
    return step_metrics(t, y, setpoint, np.full_like(t, 2.0)), t[1]


@UNTIMED
@given(st.floats(0.01, 10.0), SETPOINTS)
def test_a_first_order_lag_has_its_closed_forms(tau: float, setpoint: float):
    found, step = first_order(tau, setpoint)
    assert found.overshoot_pct == 0.0
    assert found.rise_s == pytest.approx(tau * math.log(9.0), rel=1e-5)
    assert found.settling_s == pytest.approx(tau * math.log(50.0), abs=1.01 * step)
    assert found.ise == pytest.approx(setpoint**2 * tau / 2, rel=1e-5)
    assert found.iae == pytest.approx(abs(setpoint) * tau, rel=1e-5)
    assert found.itae == pytest.approx(abs(setpoint) * tau**2, rel=1e-5)
    assert found.control_energy == pytest.approx(4.0 * 20.0 * tau, rel=1e-9)
    assert abs(found.steady_state_error) < 1e-7 * abs(setpoint)
    assert found.peak == pytest.approx(setpoint, rel=1e-8) and found.peak_s == pytest.approx(20.0 * tau)


@UNTIMED
@given(st.floats(0.15, 0.75), st.floats(0.5, 20.0), SETPOINTS)
def test_a_second_order_lag_overshoots_as_the_textbook_says(zeta: float, omega: float, setpoint: float):
    damped = omega * math.sqrt(1.0 - zeta**2)
    t = np.linspace(0.0, 15.0 / (zeta * omega), 20001)
    decay = np.exp(-zeta * omega * t)
    y = setpoint * (1.0 - decay * (np.cos(damped * t) + zeta * omega / damped * np.sin(damped * t)))
    found = step_metrics(t, y, setpoint, np.zeros_like(t))
    overshoot = math.exp(-math.pi * zeta / math.sqrt(1.0 - zeta**2))
    assert found.overshoot_pct == pytest.approx(100.0 * overshoot, rel=1e-3)
    assert found.peak == pytest.approx(setpoint * (1.0 + overshoot), rel=1e-4)
    assert found.peak_s == pytest.approx(math.pi / damped, abs=1.5 * t[1])
    assert found.ise == pytest.approx(setpoint**2 * (1.0 + 4.0 * zeta**2) / (4.0 * zeta * omega), rel=1e-4)
    info = control.step_info(y, t, yfinal=setpoint)
    assert found.settling_s == pytest.approx(info["SettlingTime"], abs=1.01 * t[1])
    assert found.rise_s == pytest.approx(info["RiseTime"], abs=2.01 * t[1])
    assert found.overshoot_pct == pytest.approx(info["Overshoot"], abs=1e-6)


def test_times_count_from_the_first_instant():
    t = np.linspace(0.0, 10.0, 2001)
    y = 1.0 - np.exp(-t)
    here, later = (step_metrics(t + shift, y, 1.0, np.zeros_like(t)) for shift in (0.0, 100.0))
    for name in ("rise_s", "settling_s", "peak_s", "ise", "itae"):
        assert getattr(here, name) == pytest.approx(getattr(later, name), rel=1e-9)


def test_what_never_happens_is_not_a_number():
    t = np.linspace(0.0, 10.0, 1001)
    half = step_metrics(t, 0.5 * (1.0 - np.exp(-5.0 * t)), 1.0, np.zeros_like(t))
    assert math.isnan(half.rise_s) and math.isnan(half.settling_s)
    assert half.overshoot_pct == 0.0 and half.steady_state_error == pytest.approx(0.5)
    wrong_way = step_metrics(t, -t, 1.0, np.zeros_like(t))
    assert math.isnan(wrong_way.rise_s) and wrong_way.overshoot_pct == 0.0 and wrong_way.peak == 0.0
    ringing = step_metrics(t, 1.0 + 0.03 * np.sin(7.0 * t), 1.0, np.zeros_like(t))
    assert math.isnan(ringing.settling_s)
    quiet = step_metrics(t, 1.0 + 0.019 * np.sin(7.0 * t), 1.0, np.zeros_like(t))
    assert quiet.settling_s == 0.0


@pytest.mark.parametrize("last", [math.nan, math.inf])
def test_a_response_that_blows_up_has_no_good_figures(last: float):
    y = np.array([0.0, 3.0, -50.0, 1e200, last])
    with np.errstate(all="ignore"):
        found = step_metrics(np.arange(5.0), y, 1.0, np.array([1.0, -1.0, 1.0, math.inf, math.nan]))
    assert math.isnan(found.settling_s) and not math.isfinite(found.ise)
    assert not found.overshoot_pct < 1000.0
    assert found.saturation_pct == 0.0, "there is no limit to stand at"


def test_saturation_is_the_share_of_samples_at_the_limit():
    u = np.array([12.0, 12.0, -12.0, 11.999, 0.0, 3.0, -3.0, 1.0])
    t = np.arange(8.0)
    assert step_metrics(t, t, 1.0, u, 12.0).saturation_pct == pytest.approx(37.5)
    assert step_metrics(t, t, 1.0, u).saturation_pct == 0.0


def test_steady_state_error_is_the_mean_of_the_last_twentieth():
    t = np.linspace(0.0, 1.0, 100)
    y = np.where(np.arange(100) < 95, 100.0, 0.9)
    assert step_metrics(t, y, 1.0, np.zeros(100)).steady_state_error == pytest.approx(0.1)


@UNTIMED
@given(st.floats(0.1, 50.0), st.floats(0.2, 0.7))
def test_metrics_scale_with_the_step(setpoint: float, zeta: float):
    t = np.linspace(0.0, 20.0, 2001)
    y = control.forced_response(control.tf([1.0], [1.0, 2.0 * zeta, 1.0]), t, np.ones_like(t)).outputs
    one, many = step_metrics(t, y, 1.0, y), step_metrics(t, setpoint * y, setpoint, setpoint * y)
    assert many.overshoot_pct == pytest.approx(one.overshoot_pct, rel=1e-6)
    assert many.rise_s == pytest.approx(one.rise_s, rel=1e-6)
    assert many.ise == pytest.approx(setpoint**2 * one.ise, rel=1e-6)
    assert many.iae == pytest.approx(setpoint * one.iae, rel=1e-6)
    assert many.control_energy == pytest.approx(setpoint**2 * one.control_energy, rel=1e-6)
