"""The PID as a program: exact discrete transfer functions, bumpless start, and what a limit does to it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.control import PID_AUTO, Pid
from app.control.sampled_pid import AntiWindup, Method, Sampling, sampled_pid
from tests.support.oracles import signal

UNTIMED = settings(deadline=None)
METHODS: tuple[Method, ...] = ("backward Euler", "Tustin")
ANTI_WINDUPS: tuple[AntiWindup, ...] = ("none", "clamping", "back-calculation")
GAINS_OR_NONE = st.one_of(st.just(0.0), st.floats(0.01, 50.0))
PIDS = st.builds(
    Pid,
    kp=GAINS_OR_NONE,
    ki=GAINS_OR_NONE,
    kd=GAINS_OR_NONE,
    n=st.floats(1.0, 500.0),
    b=st.floats(0.0, 1.0),
    c=st.floats(0.0, 1.0),
)
IDEAL_PIDS = st.builds(Pid, kp=GAINS_OR_NONE, ki=GAINS_OR_NONE, kd=GAINS_OR_NONE, b=st.floats(0, 1), c=st.floats(0, 1))
SAMPLINGS = st.builds(
    Sampling, period_s=st.floats(1e-3, 0.1), method=st.sampled_from(METHODS), anti_windup=st.sampled_from(ANTI_WINDUPS)
)
SEEDS = st.integers(0, 2**32 - 1)


def signals(seed: int, count: int = 60) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.normal(0.0, 10.0, count), rng.normal(0.0, 10.0, count).cumsum()


def by_filters(pid: Pid, sampling: Sampling, r: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Each part as a rational function of 1/z, run by scipy: s = (top / bottom) of the method."""
    h = sampling.period_s
    if sampling.method == "Tustin":
        top, bottom = np.array([2.0, -2.0]) / h, np.array([1.0, 1.0])
    else:
        top, bottom = np.array([1.0, -1.0]) / h, np.array([1.0, 0.0])
    u = pid.kp * (pid.b * r - y) + signal.lfilter(pid.ki * bottom, top, r - y)
    below = bottom if math.isinf(pid.n) else bottom + top / pid.n
    return u + signal.lfilter(pid.kd * top, below, pid.c * r - y)


@UNTIMED
@given(PIDS, SAMPLINGS, SEEDS)
def test_without_a_limit_it_is_the_discrete_transfer_function(pid: Pid, sampling: Sampling, seed: int):
    r, y = signals(seed)
    law = sampled_pid(pid, sampling)
    u = [law(*pair) for pair in zip(r.tolist(), y.tolist(), strict=True)]
    expected = by_filters(pid, sampling, r, y)
    assert np.allclose(u, expected, rtol=1e-9, atol=1e-9 * (1.0 + np.abs(expected).max()))


@UNTIMED
@given(IDEAL_PIDS, SAMPLINGS, SEEDS)
def test_an_ideal_derivative_is_the_methods_difference(pid: Pid, sampling: Sampling, seed: int):
    r, y = signals(seed)
    law = sampled_pid(pid, sampling)
    u = [law(*pair) for pair in zip(r.tolist(), y.tolist(), strict=True)]
    expected = by_filters(pid, sampling, r, y)
    assert np.allclose(u, expected, rtol=1e-9, atol=1e-9 * (1.0 + np.abs(expected).max()))


@UNTIMED
@given(PIDS, SAMPLINGS, st.floats(-200.0, 200.0))
def test_the_start_is_bumpless_wherever_the_drive_stands(pid: Pid, sampling: Sampling, start: float):
    law = sampled_pid(pid, sampling, 12.0, start)
    assert np.allclose([law(start, start) for _ in range(20)], 0.0, atol=1e-7)


@UNTIMED
@given(PIDS, SAMPLINGS, SEEDS, st.floats(-200.0, 200.0), st.floats(1.0, 1000.0))
def test_only_the_distance_from_the_start_counts(pid: Pid, sampling: Sampling, seed: int, start: float, u_max: float):
    r, y = signals(seed)
    here, there = sampled_pid(pid, sampling, u_max), sampled_pid(pid, sampling, u_max, start)
    u_here = np.array([here(*pair) for pair in zip(r.tolist(), y.tolist(), strict=True)])
    u_there = np.array([there(a + start, b + start) for a, b in zip(r.tolist(), y.tolist(), strict=True)])
    assert np.allclose(u_here, u_there, atol=1e-6 * (1.0 + pid.kd / sampling.period_s))


@UNTIMED
@given(PIDS, SAMPLINGS, SEEDS, st.floats(0.1, 100.0))
def test_the_output_never_exceeds_its_limit(pid: Pid, sampling: Sampling, seed: int, u_max: float):
    law = sampled_pid(pid, sampling, u_max)
    assert all(-u_max <= law(a, b) <= u_max for a, b in zip(*(x.tolist() for x in signals(seed)), strict=True))


@UNTIMED
@given(PIDS, st.sampled_from(METHODS), SEEDS)
def test_anti_windup_does_nothing_where_nothing_is_limited(pid: Pid, method: Method, seed: int):
    r, y = (x.tolist() for x in signals(seed))
    laws = [sampled_pid(pid, Sampling(0.01, method, kind), 1e9) for kind in ANTI_WINDUPS]
    plain, clamped, tracked = ([law(a, b) for a, b in zip(r, y, strict=True)] for law in laws)
    assert plain == clamped == tracked


def test_two_programs_do_not_share_their_memory():
    first, second = sampled_pid(PID_AUTO, Sampling()), sampled_pid(PID_AUTO, Sampling())
    opening = [first(10.0, 0.0) for _ in range(5)]
    assert [second(10.0, 0.0) for _ in range(5)] == opening
    assert first(10.0, 0.0) not in opening


@pytest.mark.parametrize("method", METHODS)
def test_derivative_on_measurement_has_no_kick(method: Method):
    """The first output after a step holds nothing but the proportional and the integral part."""
    h, step = 0.01, 25.0
    kick = sampled_pid(PID_AUTO, Sampling(h, method))(step, 0.0)
    calm = sampled_pid(replace(PID_AUTO, c=0.0), Sampling(h, method))(step, 0.0)
    integral = PID_AUTO.ki * h * step / (1 if method == "backward Euler" else 2)
    assert calm == pytest.approx(PID_AUTO.kp * step + integral, rel=1e-12)
    assert kick > 5 * calm
    still = sampled_pid(replace(PID_AUTO, b=0.0, c=0.0, ki=0.0), Sampling(h, method))
    assert still(step, 0.0) == 0.0 and still(step, 1.0) < 0.0


def test_clamping_freezes_the_integral_while_the_limit_holds():
    """After the error turns round, a PI is at once where it would be had the limited time not been."""
    pid = Pid(1.0, 5.0)
    waited = sampled_pid(pid, Sampling(0.01, anti_windup="clamping"), 12.0)
    assert {waited(100.0, 0.0) for _ in range(500)} == {12.0}
    fresh = sampled_pid(pid, Sampling(0.01, anti_windup="clamping"), 12.0)
    assert waited(-1.0, 0.0) == pytest.approx(fresh(-1.0, 0.0), abs=1e-12)
    wound = sampled_pid(pid, Sampling(0.01), 12.0)
    assert [wound(100.0, 0.0) for _ in range(500)][-1] == 12.0
    assert wound(-1.0, 0.0) == 12.0


@pytest.mark.parametrize("pid", [Pid(1.0, 5.0), Pid(2.0, 4.0, 0.5, 100.0, c=0.0)], ids=["PI", "PID"])
def test_back_calculation_settles_where_growth_and_forgetting_balance(pid: Pid):
    """Under a constant error e the wanted output ends ki e Tt above the limit; Tt = sqrt(Ti Td), Ti for a PI."""
    error, u_max, h = 10.0, 12.0, 0.01
    tracking_time = math.sqrt(pid.Ti * pid.Td) if pid.kd else pid.Ti
    law = sampled_pid(pid, Sampling(h, anti_windup="back-calculation"), u_max)
    assert [law(error, 0.0) for _ in range(5000)][-1] == u_max
    integral = u_max + pid.ki * error * tracking_time - pid.kp * error - pid.ki * h * error
    assert law(0.0, 0.0) == pytest.approx(integral, abs=1e-9)
