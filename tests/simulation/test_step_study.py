"""The step study: golden responses and margins, an independent state-space simulation, and every odd input."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

from app.control import PAR4_MOTOR, PID_APPROX, PID_AUTO, Motor, Pid
from app.control.drives import DRIVES
from app.control.sampled_pid import Sampling
from app.simulation.hardware import Hardware
from app.simulation.sampled_loop import DriveLoop
from app.simulation.step_study import MAX_PERIODS, Question, Response, Study, board_response, study
from tests.robots.golden import golden
from tests.support.oracles import control

GOLDEN = golden("motor_steps")
APPROX = replace(PID_APPROX, n=100.0)
PATIENT = settings(max_examples=50, deadline=None, suppress_health_check=[HealthCheck.too_slow])
PARTS = {"P": Pid(2.0), "PI": Pid(2.0, 1.0), "PD": Pid(2.0, 0.0, 0.3), "I": Pid(0.0, 0.5)}
UNSTABLE = {
    "integral": Pid(1.0, 60.0),
    "sign": Pid(-4.0, -1.0, -0.2, 50.0),
    "gain": Pid(1e6, 1e6, 1e6),
    "enormous": Pid(1e200),
}


def ask(
    pid: Pid,
    setpoint: float = 1.0,
    duration_s: float = 3.0,
    hardware: Hardware | None = None,
    sampling: Sampling | None = None,
    motor: Motor = PAR4_MOTOR,
) -> Study:
    with np.errstate(all="ignore"):
        loop = DriveLoop(motor, pid, sampling or Sampling(), hardware or Hardware())
        return study(Question(loop, setpoint, duration_s))


def at_golden_times(response: Response, samples: list[list[float]]) -> list[tuple[float, float]]:
    """Ours and theirs at the instants that both have."""
    shared = [(k, y) for t, y in samples for k in np.flatnonzero(np.isclose(response.t, t, atol=1e-9))]
    return [(float(response.y[k]), y) for k, y in shared]


@pytest.mark.parametrize(("key", "pid"), [("auto_N37.2929", PID_AUTO), ("approx_N100", APPROX)])
def test_the_ideal_curve_and_its_metrics_are_golden(key: str, pid: Pid):
    expected, fine, long = GOLDEN[key], ask(pid).ideal, ask(pid, duration_s=6.0).ideal
    pairs = at_golden_times(fine, expected["samples"])
    assert len(pairs) >= 9
    assert all(ours == pytest.approx(theirs, abs=1e-7) for ours, theirs in pairs)
    assert fine.metrics.overshoot_pct == pytest.approx(expected["overshoot_pct"], abs=0.01)
    assert fine.metrics.peak_s == pytest.approx(expected["t_peak"], abs=0.005)
    assert fine.metrics.rise_s == pytest.approx(expected["rise_10_90"], abs=0.0005)
    assert long.metrics.settling_s == pytest.approx(expected["settle_2pct"], abs=0.011)
    assert long.metrics.ise == pytest.approx(expected["ISE_unit_step"], rel=1e-3)


@pytest.mark.parametrize(("key", "pid"), [("auto_disc_BE", PID_AUTO), ("approx_disc_BE_N100", APPROX)])
def test_the_boards_curve_and_its_metrics_are_golden(key: str, pid: Pid):
    expected, board = GOLDEN[key], ask(pid, duration_s=50.01).board
    pairs = at_golden_times(ask(pid).board, expected["samples"])
    assert len(pairs) >= 9 and all(ours == pytest.approx(theirs, abs=1e-9) for ours, theirs in pairs)
    assert board.u[0] == pytest.approx(expected["u0"], rel=1e-12)
    for ours, theirs in (
        (board.metrics.overshoot_pct, "overshoot_pct"),
        (board.metrics.peak, "peak"),
        (board.metrics.peak_s, "t_peak"),
        (board.metrics.rise_s, "rise_10_90"),
        (board.metrics.settling_s, "settle_2pct"),
    ):
        assert ours == pytest.approx(expected[theirs], abs=1e-9)
    assert board.metrics.ise == pytest.approx(expected["ISE_unit_step"], rel=1e-5)


@pytest.mark.parametrize("u_max", [12.0, 100.0])
@pytest.mark.parametrize(("name", "pid"), [("auto", PID_AUTO), ("approx_N100", APPROX)])
def test_a_saturated_step_is_golden(name: str, pid: Pid, u_max: float):
    expected = GOLDEN[f"sat_step25_{name}_U{u_max:g}"]
    short, long = (ask(pid, 25.0, duration, Hardware(supply_v=u_max)).board for duration in (3.0, 30.0))
    pairs = at_golden_times(short, expected["samples"])
    assert len(pairs) >= 9 and all(ours == pytest.approx(theirs, abs=1e-8) for ours, theirs in pairs)
    assert long.metrics.overshoot_pct == pytest.approx(expected["overshoot_pct"], abs=1e-7)
    assert long.metrics.peak_s == pytest.approx(expected["t_peak"], abs=1e-9)
    assert long.metrics.rise_s == pytest.approx(expected["rise_10_90"], abs=1e-9)
    assert long.metrics.settling_s == pytest.approx(expected["settle_2pct"], abs=1e-9)
    assert long.metrics.ise == pytest.approx(expected["ISE"], rel=5e-4), "theirs runs longer"
    assert np.abs(long.u).max() == u_max and long.metrics.saturation_pct > 0.0


@pytest.mark.parametrize(
    ("board", "ideal", "pid"),
    [("auto_disc_BE", "auto_N37.2929", PID_AUTO), ("approx_disc_BE_N100", "approx_N100", APPROX)],
)
def test_margins_and_poles_are_golden_for_board_and_ideal(board: str, ideal: str, pid: Pid):
    answer = ask(pid)
    for key, frequency in ((board, answer.board_frequency), (ideal, answer.ideal_frequency)):
        expected, found = GOLDEN[key], frequency.margins
        assert found.phase_margin_deg == pytest.approx(expected["phase_margin_deg"], abs=1e-5)
        assert found.crossover_rad_s == pytest.approx(expected["w_cross"], rel=1e-6)
        assert found.gain_margin == pytest.approx(float(expected["gain_margin"]), rel=1e-5)
        assert found.stable
    poles = np.sort_complex(np.array([complex(*pole) for pole in GOLDEN[ideal]["closed_loop_poles"]]))
    assert np.allclose(np.sort_complex(answer.ideal_frequency.poles), poles, rtol=1e-6)


def test_the_frequency_curves_are_python_controls():
    answer = ask(PID_AUTO)
    ideal, board = answer.ideal_frequency, answer.board_frequency
    L = PAR4_MOTOR.transfer_function() * PID_AUTO.transfer_function()
    magnitude, phase, _ = control.frequency_response(L, ideal.omega)
    assert np.allclose(ideal.gain_db, 20 * np.log10(magnitude), atol=1e-9)
    assert np.allclose(np.degrees(phase), ideal.phase_deg, atol=1e-6)
    beyond = board.omega >= math.pi / 0.01
    assert beyond.any() and np.isnan(board.gain_db[beyond]).all() and np.isnan(board.phase_deg[beyond]).all()
    assert np.isfinite(board.gain_db[~beyond]).all()
    low = board.omega < 1.0
    assert np.allclose(board.gain_db[low], ideal.gain_db[low], atol=0.1)
    crossover = ideal.margins.crossover_rad_s
    assert ideal.omega[0] < crossover / 50 and ideal.omega[-1] > 50 * crossover


@pytest.mark.parametrize("pid", [PID_AUTO, APPROX], ids=["auto", "approx"])
def test_metrics_agree_with_python_controls_step_info(pid: Pid):
    G = PAR4_MOTOR.transfer_function()
    t = np.linspace(0.0, 6.0, 6001)
    closed = control.feedback(G * pid.transfer_function(), 1)
    y = control.forced_response(closed, t, np.ones_like(t)).outputs
    info, found = control.step_info(y, t, yfinal=1.0), ask(pid, duration_s=6.0).ideal.metrics
    assert found.overshoot_pct == pytest.approx(info["Overshoot"], abs=0.02)
    assert found.rise_s == pytest.approx(info["RiseTime"], abs=0.003)
    assert found.settling_s == pytest.approx(info["SettlingTime"], abs=0.011)
    assert found.peak == pytest.approx(info["Peak"], abs=2e-4)


def by_exponential(motor: Motor, pid: Pid, t: np.ndarray, setpoint: float) -> tuple[np.ndarray, np.ndarray]:
    """y and u of the continuous loop, its five states (the last is constant) moved on by a matrix exponential."""
    n = pid.n if pid.kd else 1.0
    u = np.array([-pid.kp - n * pid.kd, 0.0, 1.0, -n, (pid.kp * pid.b + n * pid.kd * pid.c) * setpoint])
    A = np.array(
        [
            [0.0, 1.0, 0.0, 0.0, 0.0],
            motor.K * u - [motor.T2, motor.T1, 0.0, 0.0, 0.0],
            [-pid.ki, 0.0, 0.0, 0.0, pid.ki * setpoint],
            [-n * pid.kd, 0.0, 0.0, -n, n * pid.kd * pid.c * setpoint],
            [0.0] * 5,
        ]
    )
    step, states = expm(A * t[1]), [np.array([0.0, 0.0, 0.0, 0.0, 1.0])]
    for _ in t[1:]:
        states.append(step @ states[-1])
    return np.array(states)[:, 0], np.array(states) @ u


MOTORS = st.builds(Motor, K=st.floats(1.0, 1000.0), T1=st.floats(1.0, 60.0), T2=st.sampled_from([0.0, 0.179, 5.0]))


@st.composite
def tuned(draw: st.DrawFn) -> tuple[Motor, Pid]:
    """Sensible to bold gains for a random motor, with any set-point weights."""
    motor = draw(MOTORS)
    wanted = draw(st.floats(1.0, 30.0))
    kp = wanted * abs(complex(motor.T1, wanted)) / motor.K
    ki, kd = kp * wanted * draw(st.sampled_from([0.0, 0.1, 0.5])), kp / wanted * draw(st.sampled_from([0.0, 0.5, 1.5]))
    b, c = draw(st.sampled_from([0.0, 0.5, 1.0])), draw(st.sampled_from([0.0, 1.0]))
    return motor, Pid(kp, ki, kd, wanted * draw(st.floats(3.0, 30.0)), b, c)


@PATIENT
@given(tuned(), st.sampled_from([1.0, -30.0]))
def test_the_ideal_curves_are_those_of_a_matrix_exponential(case: tuple[Motor, Pid], setpoint: float):
    motor, pid = case
    found = ask(pid, setpoint, motor=motor).ideal
    y, u = by_exponential(motor, pid, found.t, setpoint)
    assert np.allclose(found.y, y, atol=1e-5 * (abs(setpoint) + np.abs(y).max()))
    assert np.allclose(found.u, u, atol=1e-4 * (1.0 + np.abs(u).max()))


@PATIENT
@given(tuned())
def test_a_fast_board_comes_close_to_the_ideal(case: tuple[Motor, Pid]):
    motor, pid = case
    answer = ask(pid, 1.0, 1.0, sampling=Sampling(2e-4), motor=motor)
    ideal, _ = by_exponential(motor, pid, np.linspace(0.0, 1.0, 5001), 1.0)
    k = np.round(answer.board.t / 2e-4).astype(int)
    if answer.ideal_frequency.margins.stable:
        assert np.allclose(answer.board.y, ideal[k], atol=0.05)


@pytest.mark.parametrize("weights", [(0.0, 0.0), (0.5, 0.0), (1.0, 0.0), (0.0, 1.0)])
def test_set_point_weights_calm_the_step_and_leave_the_margins(weights: tuple[float, float]):
    plain, weighted = ask(PID_AUTO), ask(replace(PID_AUTO, b=weights[0], c=weights[1]))
    assert weighted.ideal_frequency.margins == plain.ideal_frequency.margins
    assert weighted.board.u[0] < plain.board.u[0] and weighted.ideal.u[0] < plain.ideal.u[0]


def test_an_infinite_filter_is_drawn_as_a_very_fast_one():
    endless, golden_ideal = ask(replace(PID_AUTO, n=math.inf)), GOLDEN["auto_idealD"]
    assert endless.ideal.metrics.overshoot_pct == pytest.approx(golden_ideal["overshoot_pct"], abs=0.05)
    assert endless.ideal_frequency.margins.phase_margin_deg == pytest.approx(golden_ideal["phase_margin_deg"], abs=1e-5)


@pytest.mark.parametrize("name", PARTS)
def test_controllers_with_parts_missing_are_studied_alike(name: str):
    answer = ask(PARTS[name], duration_s=2.0, sampling=Sampling(0.001))
    ideal = np.interp(answer.board.t, answer.ideal.t, answer.ideal.y)
    assert np.allclose(answer.board.y, ideal, atol=0.02)
    assert not answer.ideal_frequency.margins.stable or np.isfinite(answer.ideal.metrics.ise)


@pytest.mark.parametrize("name", UNSTABLE)
@pytest.mark.parametrize("hardware", [Hardware(), Hardware(adc_bits=10, pwm_steps=99, noise=0.1)], ids=["bare", "all"])
def test_an_unstable_loop_is_answered_without_good_figures(name: str, hardware: Hardware):
    answer = ask(UNSTABLE[name], 10.0, 3.0, hardware)
    assert not answer.board_frequency.margins.stable
    assert math.isnan(answer.board.metrics.settling_s)
    assert not abs(answer.board.metrics.steady_state_error) < 100.0


def test_slow_sampling_destabilises_what_is_stable_on_paper():
    fast, slow = (ask(PID_AUTO, sampling=Sampling(period), duration_s=6.0) for period in (0.01, 0.3))
    assert fast.board_frequency.margins.stable and not slow.board_frequency.margins.stable
    assert slow.ideal_frequency.margins == fast.ideal_frequency.margins and fast.ideal_frequency.margins.stable
    assert math.isnan(slow.board.metrics.settling_s) and slow.board.metrics.overshoot_pct > 100.0


def test_between_slow_instants_the_curve_is_the_motors_own():
    board = ask(Pid(1.0), duration_s=2.0, sampling=Sampling(0.25)).board
    assert len(board.t) >= 300
    held = board.t < 0.25
    assert np.allclose(board.y[held], [PAR4_MOTOR.zoh(t).b1 for t in board.t[held]], atol=1e-9)
    assert len(np.unique(board.u)) <= 8


def test_imperfections_reach_the_boards_margins():
    heavy = ask(PID_AUTO, hardware=Hardware(inertia_factor=3.0, viscous=2.0, delay_s=0.02))
    loaded = ask(PID_AUTO, motor=PAR4_MOTOR.loaded(3.0, 2.0))
    at = heavy.board_frequency.margins
    assert at.crossover_rad_s == pytest.approx(loaded.board_frequency.margins.crossover_rad_s)
    lag = math.degrees(0.02 * at.crossover_rad_s)
    assert at.phase_margin_deg == pytest.approx(loaded.board_frequency.margins.phase_margin_deg - lag, abs=1e-6)
    assert heavy.ideal_frequency.margins == ask(PID_AUTO).ideal_frequency.margins


@pytest.mark.parametrize("duration", [1e-6, 1e9])
def test_the_length_of_a_study_is_bounded(duration: float):
    board = board_response(Question(DriveLoop(PAR4_MOTOR, PID_AUTO), 1.0, duration))
    assert 2 <= len(board.t) <= 2 * MAX_PERIODS


def typed(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers as people type them, often 0."""
    return st.one_of(st.just(0.0), st.floats(low, high).map(lambda value: round(value, 4)))


@PATIENT
@given(
    st.builds(
        Pid,
        kp=typed(-10.0, 1000.0),
        ki=typed(-1.0, 1000.0),
        kd=typed(-0.1, 100.0),
        n=st.one_of(st.just(math.inf), st.floats(0.1, 1e4)),
        b=typed(0.0, 1.0),
        c=typed(0.0, 1.0),
    ),
    st.builds(
        Sampling,
        period_s=st.floats(5e-4, 1.0),
        method=st.sampled_from(["backward Euler", "Tustin"]),
        anti_windup=st.sampled_from(["none", "clamping", "back-calculation"]),
    ),
    st.builds(
        Hardware,
        supply_v=st.one_of(st.just(math.inf), st.floats(1.0, 100.0)),
        pwm_steps=st.integers(0, 1000),
        adc_bits=st.integers(0, 16),
        noise=st.floats(0.0, 1.0),
        delay_s=st.floats(0.0, 0.1),
        coulomb_v=st.floats(0.0, 2.0),
        backlash=st.floats(0.0, 3.0),
    ),
    st.sampled_from([drive.motor for drive in DRIVES.values()]),
)
def test_no_setting_makes_it_raise(pid: Pid, sampling: Sampling, hardware: Hardware, motor: Motor):
    answer = ask(pid, 10.0, 1.0, hardware, sampling, motor)
    for curves in (answer.board, answer.ideal):
        assert curves.t.shape == curves.y.shape == curves.u.shape and len(curves.t) > 250
    if math.isfinite(hardware.supply_v):
        assert np.isfinite(answer.board.y).all() and np.abs(answer.board.u).max() <= hardware.supply_v
    if not answer.ideal_frequency.margins.stable and np.abs(answer.ideal.y[-30:]).max() > 100.0:
        assert math.isnan(answer.ideal.metrics.settling_s)
