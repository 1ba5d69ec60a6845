"""The motor model against golden values, scipy and python-control."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from app.control import PAR4_MOTOR, Motor
from app.control.motor import Zoh
from tests.robots.golden import golden
from tests.support.oracles import control, signal

UNTIMED = settings(deadline=None)
GOLDEN = golden("motor_steps")
MOTORS = st.builds(
    Motor,
    K=st.floats(0.1, 2000.0),
    T1=st.floats(0.1, 100.0),
    T2=st.one_of(st.just(0.0), st.floats(1e-3, 500.0)),
)
PERIODS = st.floats(1e-4, 0.2)


def matrices(step: Zoh) -> tuple[np.ndarray, np.ndarray]:
    return np.array([[step.a11, step.a12], [step.a21, step.a22]]), np.array([step.b1, step.b2])


def test_the_paper_motor_has_the_golden_poles_and_gain():
    assert tuple(GOLDEN["plant"][name] for name in ("K", "T1", "T2")) == (PAR4_MOTOR.K, PAR4_MOTOR.T1, PAR4_MOTOR.T2)
    assert PAR4_MOTOR.poles.shape == (2,)
    assert np.allclose(PAR4_MOTOR.poles, GOLDEN["plant"]["poles"], rtol=1e-12)
    assert np.allclose(-1.0 / PAR4_MOTOR.poles[::-1].real, GOLDEN["plant"]["tau"], rtol=1e-12)
    assert PAR4_MOTOR.dc_gain == pytest.approx(GOLDEN["plant"]["dc_gain"], rel=1e-14)
    assert PAR4_MOTOR.unit == "deg"


@UNTIMED
@given(MOTORS)
def test_the_slow_pole_comes_last_and_both_solve_the_equation(motor: Motor):
    fast, slow = motor.poles
    assert abs(fast) >= abs(slow) * (1.0 - 1e-9)
    assert abs(fast + slow + motor.T1) < 1e-9 * motor.T1
    assert abs(fast * slow - motor.T2) < 1e-9 * max(1.0, motor.T2)


def test_a_motor_without_droop_is_an_integrator():
    motor = Motor(K=1000.0, T1=20.0)
    assert motor.dc_gain == float("inf")
    A, B = matrices(motor.zoh(0.01))
    assert A[:, 0] == pytest.approx([1.0, 0.0], abs=1e-15)
    speed = 0.0
    for _ in range(1000):
        speed = A[1, 1] * speed + B[1] * 6.0
    assert speed == pytest.approx(300.0, rel=1e-12)


def test_the_transfer_function_is_that_of_the_equation():
    G = PAR4_MOTOR.transfer_function()
    s = 0.7 + 2.0j
    assert G(s) == pytest.approx(9.4138 / (s * s + 3.5865 * s + 0.1790), rel=1e-12)
    assert G.dt == 0


def test_sampled_transfer_function_has_the_golden_coefficients():
    G = PAR4_MOTOR.sampled(0.01)
    assert G.dt == 0.01
    assert np.allclose(G.num[0][0], GOLDEN["plant_zoh_0.01"]["num"], rtol=1e-9)
    assert np.allclose(G.den[0][0], GOLDEN["plant_zoh_0.01"]["den"], rtol=1e-12)


def test_the_state_step_has_the_golden_coefficients():
    A, B = matrices(PAR4_MOTOR.zoh(0.01))
    assert np.allclose(np.poly(A), GOLDEN["plant_zoh_0.01"]["den"], rtol=1e-12)
    numerator = [B[0], A[0, 1] * B[1] - A[1, 1] * B[0]]
    assert np.allclose(numerator, GOLDEN["plant_zoh_0.01"]["num"], rtol=1e-9)


def test_a_step_of_one_volt_passes_through_the_golden_samples():
    """In one step of any length, and in many short ones."""
    assert len(GOLDEN["open_loop_step"]) > 10
    for t, y in GOLDEN["open_loop_step"]:
        assert PAR4_MOTOR.zoh(t).b1 == pytest.approx(y, rel=1e-9)
        A, B = matrices(PAR4_MOTOR.zoh(t / 100))
        state = np.zeros(2)
        for _ in range(100):
            state = A @ state + B
        assert state[0] == pytest.approx(y, rel=1e-9)


@UNTIMED
@given(MOTORS, PERIODS)
def test_the_state_step_is_scipys(motor: Motor, period: float):
    continuous = (np.array([[0.0, 1.0], [-motor.T2, -motor.T1]]), np.array([[0.0], [motor.K]]))
    A, B, *_ = signal.cont2discrete((*continuous, np.eye(2), np.zeros((2, 1))), period, method="zoh")
    ours_A, ours_B = matrices(motor.zoh(period))
    assert np.allclose(ours_A, A, rtol=1e-9, atol=1e-12)
    assert np.allclose(ours_B, B[:, 0], rtol=1e-9, atol=1e-12)


@UNTIMED
@given(MOTORS, PERIODS)
def test_two_half_steps_are_one_step(motor: Motor, period: float):
    A, B = matrices(motor.zoh(period))
    half_A, half_B = matrices(motor.zoh(period / 2))
    assert np.allclose(half_A @ half_A, A, rtol=1e-9, atol=1e-12)
    assert np.allclose(half_A @ half_B + half_B, B, rtol=1e-9, atol=1e-12)


@UNTIMED
@given(MOTORS, PERIODS)
def test_the_state_step_and_the_sampled_transfer_function_agree(motor: Motor, period: float):
    A, B = matrices(motor.zoh(period))
    G = motor.sampled(period)
    for angle in (0.3, 1.5, 3.0):
        z = np.exp(1j * angle)
        assert G(z) == pytest.approx(np.linalg.solve(z * np.eye(2) - A, B)[0], rel=1e-5)


def test_the_state_step_solves_the_differential_equation():
    motor, y0, v0, u, h = Motor(K=50.0, T1=3.0, T2=7.0), 2.0, -4.0, 1.5, 0.1
    solution = solve_ivp(
        lambda _, x: [x[1], motor.K * u - motor.T1 * x[1] - motor.T2 * x[0]], (0, h), [y0, v0], rtol=1e-11, atol=1e-12
    )
    A, B = matrices(motor.zoh(h))
    assert np.allclose(A @ [y0, v0] + B * u, solution.y[:, -1], rtol=1e-9)


def test_load_scales_inertia_and_adds_friction():
    """(inertia s^2 + (T1 + viscous) s + T2) y = K u."""
    loaded = PAR4_MOTOR.loaded(inertia_factor=2.5, viscous=1.2)
    expected = control.tf([9.4138], [2.5, 3.5865 + 1.2, 0.1790])
    for s in (0.1j, 3.0j, 1.0 + 50.0j):
        assert loaded.transfer_function()(s) == pytest.approx(expected(s), rel=1e-12)
    assert loaded.dc_gain == pytest.approx(PAR4_MOTOR.dc_gain)
    assert PAR4_MOTOR.loaded() == PAR4_MOTOR
    assert Motor(1.0, 2.0, unit="mm").loaded(3.0).unit == "mm"
