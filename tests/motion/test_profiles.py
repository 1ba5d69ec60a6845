"""The time laws: from rest to rest, with the derivatives and peaks that are known of them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.motion.pieces import joined, quintic_between
from app.motion.profiles import JERK_SHARE, PROFILES, Sin2, s_curve, trapezoid

few = settings(max_examples=30)
FAMILIES = {name: kind for name, kind in PROFILES.items() if kind.law is not None}
U = np.linspace(0.0, 1.0, 20001)


def law_of(name: str, ramp: float):
    build = PROFILES[name].law
    assert build is not None
    return build(ramp)


@few
@given(st.sampled_from(sorted(FAMILIES)), st.floats(0.02, 0.5))
def test_a_law_goes_from_rest_to_rest_without_turning_back(name, ramp):
    value, rate, _ = law_of(name, ramp).at(U)
    assert value[0] == pytest.approx(0.0, abs=1e-12) and value[-1] == pytest.approx(1.0, abs=1e-12)
    assert np.allclose(rate[[0, -1]], 0.0, atol=1e-9)
    assert rate.min() > -1e-9


@few
@given(st.sampled_from(sorted(FAMILIES)), st.floats(0.02, 0.5))
def test_derivatives_equal_central_differences(name, ramp):
    law, u, h = law_of(name, ramp), np.linspace(0.0003, 0.9997, 401), 1e-6
    corners = np.array(PROFILES[name].knots(ramp))
    u = u[np.abs(u[:, None] - corners).min(axis=1) > 2 * h]
    after, at, before = law.at(u + h), law.at(u), law.at(u - h)
    assert np.allclose((after[0] - before[0]) / (2 * h), at[1], atol=1e-5)
    assert np.allclose((after[1] - before[1]) / (2 * h), at[2], atol=1e-5 * np.abs(at[2]).max())


@pytest.mark.parametrize("name", FAMILIES)
def test_a_law_is_constant_beyond_its_ends(name):
    value, rate, acceleration = law_of(name, 0.3).at([-2.0, -1e-9, 1.0 + 1e-9, 7.0])
    assert np.allclose(value, [0, 0, 1, 1], atol=1e-12)
    assert not np.abs(rate).max() > 1e-12 and not np.abs(acceleration).max() > 1e-9


@few
@given(st.sampled_from(["trapezoidal", "jerk-limited", "sin2"]), st.floats(0.02, 0.49))
def test_cruising_laws_cruise_between_their_ramps(name, ramp):
    rate, acceleration = law_of(name, ramp).at(np.linspace(ramp + 1e-9, 1.0 - ramp - 1e-9, 50))[1:]
    assert np.allclose(rate, 1.0 / (1.0 - ramp)) and np.allclose(acceleration, 0.0, atol=1e-6 / ramp)


def test_known_peaks_of_the_polynomials():
    assert law_of("cubic", 0.5).at(U)[1].max() == pytest.approx(1.5)
    assert np.abs(law_of("cubic", 0.5).at(U)[2]).max() == pytest.approx(6.0)
    assert law_of("quintic", 0.5).at(U)[1].max() == pytest.approx(15 / 8)
    assert np.abs(law_of("quintic", 0.5).at(U)[2]).max() == pytest.approx(10 / np.sqrt(3), rel=1e-6)


@few
@given(st.floats(0.02, 0.5))
def test_the_s_curve_is_what_ruckig_calls_time_optimal(ramp):
    """Under its own peak speed, acceleration and jerk nothing is faster than its one unit of time."""
    from ruckig import InputParameter, Ruckig, Trajectory

    _, rate, acceleration = s_curve(ramp).at(np.linspace(0.0, 1.0, 4001))
    wanted, found = InputParameter(1), Trajectory(1)
    wanted.current_position, wanted.target_position = [0.0], [1.0]
    peak = acceleration.max()
    wanted.max_velocity, wanted.max_acceleration = [rate.max()], [peak]
    wanted.max_jerk = [peak / (JERK_SHARE * ramp)]
    Ruckig(1).calculate(wanted, found)
    assert found.duration == pytest.approx(1.0, abs=2e-3)


def test_the_sin2_law_has_the_figures_of_the_work_cycle():
    """D = 0.318 m, T = 0.48 s, v = 1.16 m/s: tau = 0.20586 s, A = 11.27 m/s^2, greatest jerk 172 m/s^3."""
    tau = 0.48 - 0.318 / 1.16
    assert tau == pytest.approx(0.20586, abs=1e-5)
    t = np.linspace(0.0, 0.48, 48001)
    value, rate, acceleration = Sin2(0.318, 0.48, tau).at(t)
    assert value[-1] == pytest.approx(0.318) and rate.max() == pytest.approx(1.16)
    assert acceleration.max() == pytest.approx(11.27, abs=0.005)
    assert np.abs(np.gradient(acceleration, t)).max() == pytest.approx(172, abs=0.5)


def test_a_trapezoid_has_three_levels_of_acceleration():
    acceleration = trapezoid(0.25).at(np.array([0.0, 0.1, 0.3, 0.7, 0.8, 1.0]))[2]
    assert np.allclose(acceleration, np.array([1, 1, 0, 0, -1, -1]) / (0.25 * 0.75))


@few
@given(*[st.floats(-2.0, 2.0)] * 4, st.floats(0.1, 3.0))
def test_a_quintic_meets_its_end_conditions(start, end, start_rate, end_rate, duration):
    law = joined([(duration, quintic_between(start, end, duration, start_rate, end_rate))])
    value, rate, acceleration = law.at(np.array([0.0, duration]))
    assert np.allclose(value, [start, end], atol=1e-9)
    assert np.allclose(rate, [start_rate, end_rate], atol=1e-8)
    assert np.allclose(acceleration, 0.0, atol=1e-6 / duration**2)


@few
@given(st.floats(0.1, 9.0))
def test_stretching_keeps_the_values_and_divides_the_derivatives(factor):
    law = s_curve(0.3)
    slow, quick = law.stretched(factor).at(U * factor), law.at(U)
    assert np.allclose(slow[0], quick[0], atol=1e-9)
    assert np.allclose(slow[1] * factor, quick[1], atol=1e-9)
