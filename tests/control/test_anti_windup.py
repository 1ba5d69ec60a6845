"""A motor after a step that its supply cannot follow: what anti-windup is worth, and what it costs."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from app.control import PAR4_MOTOR, PID_APPROX, PID_AUTO, Motor, Pid
from app.control.frequency import OpenLoop
from app.control.margins import margins
from app.control.sampled_pid import AntiWindup, Method, Sampling, sampled_pid

METHODS: tuple[Method, ...] = ("backward Euler", "Tustin")
KINDS: tuple[AntiWindup, ...] = ("none", "clamping", "back-calculation")
APPROX = replace(PID_APPROX, n=100.0)
ROUNDING = 1e-9
PATIENT = settings(
    max_examples=60, deadline=None, suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow]
)


class Outcome(NamedTuple):
    overshoot: float
    """Share of the step."""
    ise: float


class Case(NamedTuple):
    motor: Motor
    pid: Pid
    sampling: Sampling
    u_max: float
    step: float
    duration_s: float

    def outcome(self, kind: AntiWindup) -> Outcome:
        """Of a plain loop around the program: read, compute, hold."""
        law = sampled_pid(self.pid, replace(self.sampling, anti_windup=kind), self.u_max)
        a11, a12, a21, a22, b1, b2 = self.motor.zoh(self.sampling.period_s)
        y = v = top = ise = 0.0
        for _ in range(round(self.duration_s / self.sampling.period_s)):
            top, ise = max(top, y), ise + (self.step - y) ** 2 * self.sampling.period_s
            u = law(self.step, y)
            y, v = a11 * y + a12 * v + b1 * u, a21 * y + a22 * v + b2 * u
        return Outcome(max(0.0, top / self.step - 1.0), ise)


@st.composite
def stable_cases(draw: st.DrawFn) -> Case:
    """Phase margin above 30 degrees, sampled 20 times a radian, and a supply that the step exceeds up to 30 times.
    Time counts in time constants of the motor."""
    motor = Motor(1.0, 1.0, draw(st.sampled_from([0.0, 0.01, 0.1])))
    crossover = draw(st.floats(0.1, 2.0))
    kp = crossover * abs(complex(1.0, crossover))
    Ti = draw(st.floats(1.0, 30.0)) / crossover
    Td = draw(st.one_of(st.just(0.0), st.floats(0.05, 0.5))) / crossover
    pid = Pid(kp, kp / Ti, kp * Td, 10.0 / Td if Td else math.inf, c=draw(st.sampled_from([0.0, 1.0])))
    sampling = Sampling(0.05 / crossover, draw(st.sampled_from(METHODS)))
    u_max = kp * draw(st.floats(0.03, 1.0))
    assume(u_max * motor.dc_gain > 1.5)
    margin = margins(OpenLoop(motor, pid, 0.0, sampling))
    assume(margin.stable and margin.phase_margin_deg > 30.0)
    duration = 40.0 / crossover + 10.0 * Ti + 3.0 / u_max
    return Case(motor, pid, sampling, u_max, 1.0, min(duration, 3000 * sampling.period_s))


@PATIENT
@given(stable_cases())
def test_anti_windup_never_overshoots_more(case: Case):
    none, clamping, tracking = (case.outcome(kind) for kind in KINDS)
    assert clamping.overshoot <= none.overshoot + ROUNDING
    assert tracking.overshoot <= none.overshoot + ROUNDING


@PATIENT
@given(stable_cases())
def test_where_windup_is_severe_clamping_never_costs_error(case: Case):
    """Beyond 30 % of overshoot. Below that the wound-up integral can be of help: it pushes a sluggish loop."""
    none = case.outcome("none")
    assume(none.overshoot > 0.3)
    assert case.outcome("clamping").ise <= none.ise * (1.0 + ROUNDING)


@pytest.mark.parametrize("supply", [12.0, 24.0, 100.0])
@pytest.mark.parametrize("step", [5.0, 25.0, 90.0])
@pytest.mark.parametrize("pid", [PID_AUTO, APPROX], ids=["auto", "approx"])
def test_on_the_par4_motor_clamping_never_loses(pid: Pid, step: float, supply: float):
    case = Case(PAR4_MOTOR, pid, Sampling(), supply, step, 40.0)
    none, clamping = case.outcome("none"), case.outcome("clamping")
    assert clamping.overshoot <= none.overshoot + ROUNDING
    assert clamping.ise <= none.ise * (1.0 + ROUNDING)


def test_the_papers_second_tuning_is_what_anti_windup_was_made_for():
    case = Case(PAR4_MOTOR, APPROX, Sampling(), 12.0, 25.0, 40.0)
    none, clamping, tracking = (case.outcome(kind) for kind in KINDS)
    assert none.overshoot == pytest.approx(0.963, abs=0.001)
    assert clamping.overshoot < none.overshoot / 6 and tracking.overshoot < none.overshoot / 4
    assert clamping.ise < none.ise / 3 and tracking.ise < none.ise / 3


def test_back_calculation_trades_the_papers_first_tuning_overshoot_for_error():
    """A long integral time and a large gain: what the limit cuts off empties the integral, and the drive creeps."""
    case = Case(PAR4_MOTOR, PID_AUTO, Sampling(), 12.0, 25.0, 40.0)
    none, clamping, tracking = (case.outcome(kind) for kind in KINDS)
    assert tracking.overshoot < clamping.overshoot < none.overshoot
    assert tracking.ise > 1.5 * none.ise > clamping.ise


@pytest.mark.parametrize("kind", KINDS)
def test_without_integral_there_is_nothing_to_wind_up(kind: AntiWindup):
    case = Case(Motor(1.0, 1.0), Pid(2.0, 0.0, 0.5, 50.0), Sampling(0.02), 0.5, 1.0, 40.0)
    assert case.outcome(kind) == case.outcome("none")
    assert np.isfinite(case.outcome(kind).ise)
