"""The continuous PID: its forms, its transfer functions, and the loops of the paper that it closes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from app.control import PAR4_MOTOR, PID_APPROX, PID_AUTO, Pid
from tests.robots.golden import golden
from tests.support.oracles import control

UNTIMED = settings(deadline=None)
GOLDEN = golden("motor_steps")
GAINS = st.floats(0.01, 100.0)
GAINS_OR_NONE = st.one_of(st.just(0.0), GAINS)
PIDS = st.builds(
    Pid,
    kp=GAINS,
    ki=GAINS_OR_NONE,
    kd=GAINS_OR_NONE,
    n=st.one_of(st.just(math.inf), st.floats(1.0, 1000.0)),
    b=st.sampled_from([0.0, 0.3, 1.0]),
    c=st.sampled_from([0.0, 0.7, 1.0]),
)


def as_written(pid: Pid, s: complex, b: float, c: float) -> complex:
    """u / r of u = kp (b r - y) + ki / s (r - y) + kd N s / (s + N) (c r - y)."""
    derivative = s if math.isinf(pid.n) else pid.n * s / (s + pid.n)
    return pid.kp * b + pid.ki / s + pid.kd * c * derivative


@UNTIMED
@given(PIDS, st.floats(0.01, 1000.0))
@example(Pid(2.0, 1.0, 0.5, 100.0, 0.3, 0.7), 20.0)
@example(Pid(2.0, 1.0, 0.5, math.inf, 0.3, 0.7), 20.0)
def test_the_transfer_functions_are_the_formula(pid: Pid, omega: float):
    s = 1j * omega
    assert pid.transfer_function()(s) == pytest.approx(as_written(pid, s, 1.0, 1.0), rel=1e-9)
    assert pid.setpoint_transfer_function()(s) == pytest.approx(as_written(pid, s, pid.b, pid.c), rel=1e-9, abs=1e-9)


@UNTIMED
@given(PIDS)
def test_parts_that_are_switched_off_leave_no_poles(pid: Pid):
    expected = bool(pid.ki) + (bool(pid.kd) and math.isfinite(pid.n))
    assert len(pid.transfer_function().poles()) == expected


@UNTIMED
@given(GAINS, st.floats(0.01, 10.0), st.floats(0.0, 10.0))
def test_the_ideal_form_is_kp_times_the_times(kp: float, Ti: float, Td: float):
    pid, s = Pid.ideal(kp, Ti, Td), 0.3 + 2.0j
    assert pid.transfer_function()(s) == pytest.approx(kp * (1 + 1 / (Ti * s) + Td * s), rel=1e-9)
    assert pid.Ti == pytest.approx(Ti) and pid.Td == pytest.approx(Td)
    assert math.isinf(pid.n) and pid.b == pid.c == 1.0


def test_a_controller_without_a_part_has_no_time_for_it():
    assert Pid(2.0).Ti == math.inf and Pid(2.0).Td == 0.0
    assert Pid(0.0, 0.0, 1.0).Td == 0.0
    assert Pid.ideal(3.0) == Pid(3.0, 0.0, 0.0)


def test_the_papers_controllers():
    assert (PID_AUTO.kp, PID_AUTO.ki, PID_AUTO.kd, PID_AUTO.n) == (4.36210, 0.38231, 0.99919, 37.2929)
    assert PID_APPROX.kp == 2.2880
    assert PID_APPROX.ki == pytest.approx(7.19950, abs=5e-6) and PID_APPROX.kd == pytest.approx(0.279594, abs=5e-7)


@pytest.mark.parametrize(
    ("key", "pid"),
    [
        ("auto_N37.2929", PID_AUTO),
        ("auto_idealD", replace(PID_AUTO, n=math.inf)),
        ("approx_ideal", PID_APPROX),
        ("approx_N100", replace(PID_APPROX, n=100.0)),
    ],
)
def test_the_papers_loops_have_the_golden_poles_and_margins(key: str, pid: Pid):
    loop = PAR4_MOTOR.transfer_function() * pid.transfer_function()
    poles = np.sort_complex(control.feedback(loop, 1).poles())
    expected = np.sort_complex(np.array([complex(*pole) for pole in GOLDEN[key]["closed_loop_poles"]]))
    assert np.allclose(poles, expected, rtol=1e-6, atol=1e-9)
    _, phase_margin, _, crossover = control.margin(loop)
    assert phase_margin == pytest.approx(GOLDEN[key]["phase_margin_deg"], abs=1e-6)
    assert crossover == pytest.approx(GOLDEN[key]["w_cross"], rel=1e-8)


def test_set_point_weights_leave_the_feedback_as_it_is():
    weighted = replace(PID_AUTO, b=0.4, c=0.0)
    s = 2.0j
    assert weighted.transfer_function()(s) == pytest.approx(PID_AUTO.transfer_function()(s), rel=1e-12)
    assert abs(weighted.setpoint_transfer_function()(s)) < abs(PID_AUTO.setpoint_transfer_function()(s))
    assert PID_AUTO.setpoint_transfer_function()(s) == pytest.approx(PID_AUTO.transfer_function()(s), rel=1e-12)
