"""Margins against python-control, against a dense grid, and against simulations at the edge of stability."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from app.control import PAR4_MOTOR, PID_APPROX, PID_AUTO, Motor, Pid
from app.control.frequency import OpenLoop
from app.control.margins import Margins, margins
from app.control.sampled_pid import Method, Sampling
from app.simulation.hardware import Hardware
from app.simulation.sampled_loop import DriveLoop, simulate
from tests.robots.golden import golden
from tests.support.oracles import control

GOLDEN = golden("motor_steps")
APPROX = replace(PID_APPROX, n=100.0)
METHODS: tuple[Method, ...] = ("backward Euler", "Tustin")
PATIENT = settings(max_examples=40, deadline=None)


@st.composite
def loops(draw: st.DrawFn, sampled: bool) -> OpenLoop:
    """Crossover somewhere around the motor's corner; the sampled ones 20 to 200 times a radian or so. A loop that
    the droop keeps below unity gain may cross it below the lowest frequency that is looked at, and is left out."""
    T1 = draw(st.floats(1.0, 60.0))
    motor = Motor(draw(st.floats(1.0, 1000.0)), T1, draw(st.sampled_from([0.0, 0.179, 5.0])))
    wanted = T1 * draw(st.floats(0.2, 3.0))
    kp = wanted * abs(complex(T1, wanted)) / motor.K
    assume(kp * motor.dc_gain > 2.0)
    ki = kp * wanted * draw(st.sampled_from([0.0, 0.02, 0.2, 0.6]))
    kd = kp / wanted * draw(st.sampled_from([0.0, 0.2, 1.0]))
    pid = Pid(kp, ki, kd, wanted * draw(st.floats(3.0, 30.0)))
    if not sampled:
        return OpenLoop(motor, pid)
    period = draw(st.floats(0.005, 0.05)) / wanted
    return OpenLoop(motor, pid, 0.0, Sampling(period, draw(st.sampled_from(METHODS))))


def parts(loop: OpenLoop) -> tuple[Any, list[Any]]:
    """Plant, and the parts of the controller that add up, as python-control objects."""
    pid, plant = loop.pid, loop.motor.transfer_function()
    if loop.sampling is None:
        return plant, [pid.transfer_function()]
    h = loop.sampling.period_s
    tustin = loop.sampling.method == "Tustin"
    top, bottom = (np.array([2.0, -2.0]) / h, [1.0, 1.0]) if tustin else (np.array([1.0, -1.0]) / h, [1.0, 0.0])
    law = [control.tf([pid.kp], [1.0], h)]
    if pid.ki:
        law.append(control.tf(pid.ki * np.array(bottom), top, h))
    if pid.kd:
        law.append(control.tf(pid.kd * top, np.array(bottom) + top / pid.n, h))
    return control.sample_system(plant, h), law


def by_control(loop: OpenLoop) -> Any:
    """The open loop in state space, where python-control keeps its digits."""
    plant, law = parts(loop)
    return control.ss(plant) * sum(map(control.ss, law[1:]), control.ss(law[0]))


def dense(loop: OpenLoop) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies, and the open loop there."""
    omega = np.geomspace(1e-3, min(1e4, 0.9999 * loop.highest_rad_s), 60_001)
    at = 1j * omega if loop.sampling is None else np.exp(1j * omega * loop.sampling.period_s)
    plant, law = parts(loop)
    return omega, np.asarray(plant(at)) * sum(np.asarray(part(at)) for part in law)


@PATIENT
@given(loops(sampled=False))
def test_continuous_margins_are_those_of_python_control(loop: OpenLoop):
    gain_margin, phase_margin, _, turn, crossover, _ = control.stability_margins(
        loop.motor.transfer_function() * loop.pid.transfer_function()
    )
    found = margins(loop)
    assert found.phase_margin_deg == pytest.approx(phase_margin, abs=1e-4)
    assert found.crossover_rad_s == pytest.approx(crossover, rel=1e-6, nan_ok=True)
    assert found.gain_margin == pytest.approx(gain_margin, rel=1e-4)
    assert math.isnan(found.phase_crossover_rad_s) or found.phase_crossover_rad_s == pytest.approx(turn, rel=1e-4)


@PATIENT
@given(loops(sampled=True))
def test_sampled_margins_are_those_of_a_dense_grid(loop: OpenLoop):
    omega, L = dense(loop)
    found = margins(loop)
    crossed = np.flatnonzero(np.diff(np.sign(np.abs(L) - 1.0)))
    phase_margins = [math.remainder(math.degrees(np.angle(L[k])) - 180.0, 360.0) for k in crossed]
    assert found.phase_margin_deg == pytest.approx(min(phase_margins, key=abs, default=math.inf), abs=0.1)
    turned = [k for k in np.flatnonzero(np.diff(np.sign(np.imag(L)))) if L[k].real < 0.0]
    nearest = min((float(-1.0 / L[k].real) for k in turned), key=lambda gain: abs(math.log(gain)), default=math.inf)
    assert found.gain_margin == pytest.approx(nearest, rel=3e-3)
    if len(crossed):
        assert np.isclose(omega[crossed], found.crossover_rad_s, rtol=1e-3).any()


@PATIENT
@given(st.booleans().flatmap(loops))
def test_ms_and_bandwidth_are_those_of_a_dense_grid(loop: OpenLoop):
    omega, L = dense(loop)
    found = margins(loop)
    assume(found.stable and found.Ms < 5.0)
    assert found.Ms == pytest.approx(np.max(1.0 / np.abs(1.0 + L)), rel=1e-3)
    closed = np.abs(L / (1.0 + L))
    fallen = closed < closed[0] / math.sqrt(2.0)
    if fallen.any():
        assert found.bandwidth_rad_s == pytest.approx(omega[np.argmax(fallen)], rel=1e-3)
    else:
        assert found.bandwidth_rad_s == math.inf


@PATIENT
@given(st.booleans().flatmap(loops))
def test_closed_loop_poles_are_those_of_python_control(loop: OpenLoop):
    expected = control.feedback(by_control(loop), 1).poles()
    found = loop.poles()
    if loop.sampling is not None:
        found = np.exp(found * loop.sampling.period_s)
        expected = expected[np.abs(expected) > 1e-9]
        found = found[np.abs(found) > 1e-9]
    scale = np.abs(expected).max()
    assert len(found) == len(expected)
    assert np.allclose(np.sort_complex(found.round(9)), np.sort_complex(expected.round(9)), atol=1e-5 * scale)
    inside = np.abs(expected) < 1.0 if loop.sampling is not None else expected.real < 0.0
    assert margins(loop).stable == inside.all()


@PATIENT
@given(st.booleans().flatmap(loops))
def test_the_gain_margin_is_where_stability_ends(loop: OpenLoop):
    found = margins(loop)
    assume(found.stable and math.isfinite(found.gain_margin))

    def stable(factor: float) -> bool:
        poles = control.feedback(factor * by_control(loop), 1).poles()
        return bool((np.abs(poles) < 1.0 if loop.sampling is not None else poles.real < 0.0).all())

    assert stable(1.0)
    inner, outer = (0.99, 1.01) if found.gain_margin > 1.0 else (1.01, 0.99)
    assert stable(inner * found.gain_margin) and not stable(outer * found.gain_margin)


@pytest.mark.parametrize(
    ("key", "pid", "sampling"),
    [
        ("auto_N37.2929", PID_AUTO, None),
        ("auto_idealD", replace(PID_AUTO, n=math.inf), None),
        ("approx_ideal", PID_APPROX, None),
        ("approx_N100", APPROX, None),
        ("auto_disc_BE", PID_AUTO, Sampling()),
        ("approx_disc_BE_N100", APPROX, Sampling()),
    ],
)
def test_the_papers_loops_have_the_golden_margins(key: str, pid: Pid, sampling: Sampling | None):
    expected, found = GOLDEN[key], margins(OpenLoop(PAR4_MOTOR, pid, 0.0, sampling))
    assert found.phase_margin_deg == pytest.approx(expected["phase_margin_deg"], abs=1e-5)
    assert found.crossover_rad_s == pytest.approx(expected["w_cross"], rel=1e-6)
    assert found.gain_margin == pytest.approx(float(expected["gain_margin"]), rel=1e-5)
    if "Ms" in expected:
        assert found.Ms == pytest.approx(expected["Ms"], rel=1e-3)
    assert found.stable


def envelope(loop: DriveLoop, duration_s: float) -> tuple[float, float]:
    """Largest distance from the set-point early and late."""
    periods = round(duration_s / loop.sampling.period_s)
    error = np.abs(np.array(simulate(loop, [1.0] * periods).y) - 1.0)
    return error[periods // 4 : periods // 2].max(), error[-periods // 4 :].max()


@pytest.mark.parametrize("pid", [Pid(4.0, 0.0, 0.9, 60.0), APPROX], ids=["PD", "PID"])
@pytest.mark.parametrize("method", METHODS)
def test_the_delay_margin_really_destabilises(pid: Pid, method: Method):
    """Whole periods of delay, one fewer and one more than the loop can bear."""
    sampling, motor = Sampling(0.002, method), Motor(9.4138, 3.5865, 0.1790)
    found = margins(OpenLoop(motor, pid, 0.0, sampling))
    periods = found.delay_margin_s / sampling.period_s
    assert found.stable and periods > 20
    early, late = envelope(DriveLoop(motor, pid, sampling, Hardware(delay_s=0.95 * found.delay_margin_s)), 15.0)
    offset = abs(1.0 - pid.kp * motor.dc_gain / (1.0 + pid.kp * motor.dc_gain)) if not pid.ki else 0.0
    assert late < early and late - offset < 0.7 * (early - offset)
    early, late = envelope(DriveLoop(motor, pid, sampling, Hardware(delay_s=1.05 * found.delay_margin_s)), 15.0)
    assert late > 1.5 * early


@pytest.mark.parametrize("sampling", [None, Sampling(0.005)], ids=["continuous", "sampled"])
def test_a_delay_beyond_the_margin_is_reported_unstable(sampling: Sampling | None):
    loop = OpenLoop(PAR4_MOTOR, PID_AUTO, 0.0, sampling)
    limit = margins(loop).delay_margin_s
    below, above = (margins(replace(loop, delay_s=factor * limit)) for factor in (0.999, 1.001))
    assert below.stable and not above.stable
    assert below.delay_margin_s == pytest.approx(0.001 * limit, rel=1e-3)
    assert below.phase_margin_deg > 0.0 > above.phase_margin_deg


@PATIENT
@given(st.booleans().flatmap(loops))
def test_at_the_delay_margin_the_loop_oscillates_whether_stable_or_not(loop: OpenLoop):
    """L is -1 at some frequency; a delay cannot be negative."""
    delay = margins(loop).delay_margin_s
    assume(math.isfinite(delay))
    assert delay > 0.0
    omega, L = dense(loop)
    assert np.abs(1.0 + L * np.exp(-1j * omega * delay)).min() < 0.01


def test_the_delay_margin_is_phase_margin_over_crossover():
    found = margins(OpenLoop(PAR4_MOTOR, PID_AUTO))
    assert found.delay_margin_s == pytest.approx(math.radians(found.phase_margin_deg) / found.crossover_rad_s)
    unstable = margins(OpenLoop(Motor(1.0, 1.0), Pid(1.0, 3.0)))
    turn = math.radians(unstable.phase_margin_deg + 360.0)
    assert not unstable.stable and unstable.delay_margin_s == pytest.approx(turn / unstable.crossover_rad_s)


def test_a_loop_that_never_reaches_unity_gain_bears_any_delay():
    found = margins(OpenLoop(Motor(1.0, 2.0, 10.0), Pid(0.5)))
    assert found.phase_margin_deg == found.delay_margin_s == math.inf and math.isnan(found.crossover_rad_s)
    assert found.stable and found.gain_margin == math.inf and math.isnan(found.phase_crossover_rad_s)


def test_an_unstable_loop_says_so():
    too_much_integral: Margins = margins(OpenLoop(Motor(1.0, 1.0), Pid(1.0, 3.0)))
    assert not too_much_integral.stable and too_much_integral.phase_margin_deg < 0.0
    assert not margins(OpenLoop(PAR4_MOTOR, Pid(-1.0))).stable
    coarse = OpenLoop(PAR4_MOTOR, PID_AUTO, 0.0, Sampling(0.3))
    assert not margins(coarse).stable and margins(replace(coarse, sampling=None)).stable
