"""Identification against golden estimates, against known motors, and what it says about poor data."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from app.control.identification import Identification, IdentificationError, identify
from app.control.identification.advice import autocorrelation
from app.control.identification.excitation import prbs, pulses, square, staircase
from app.control.identification.open_loop import open_loop
from app.control.motor import PAR4_MOTOR, Motor
from tests.robots.golden import golden

PERIOD_S = 0.01
GOLDEN = golden("motor_ident")
TRUE = np.array(GOLDEN["true"])
SIGNALS = {"prbs": prbs, "steps": staircase}
ABSURD_STARTS = [(1, 1, 1), (100, 50, 0.01), (1, 0.1, 10), (0.1, 10, 0.1), (1000, 100, 1)]
ABSURD_STARTS += [(3e-3, 150, 0.1), (0.003, 0.002, 455), (1e6, 1e6, 1e6)]


def golden_input(name: str, duration_s: float) -> tuple[np.ndarray, np.ndarray]:
    """The golden square is 12 sign(sin(2 pi t / 8)) with 12 at its zeros, so one sample longer than a clean one."""
    if name != "square":
        return SIGNALS[name](12.0, duration_s, PERIOD_S)
    t, _ = square(12.0, duration_s, PERIOD_S)
    return t, np.where(np.sin(2 * np.pi * t / 8.0) > -1e-9, 12.0, -12.0)


def noisy(motor: Motor, u: np.ndarray, sigma: float = 0.5, seed: int = 7) -> np.ndarray:
    return open_loop(motor, u, PERIOD_S) + sigma * np.random.default_rng(seed).standard_normal(len(u))


def parameters(found: Identification) -> np.ndarray:
    return np.array([found.motor.K, found.motor.T1, found.motor.T2])


@pytest.fixture(scope="module")
def recording() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    t, u = prbs(12.0, 40.0, PERIOD_S)
    return t, u, noisy(PAR4_MOTOR, u)


@pytest.mark.parametrize("row", GOLDEN["rows"], ids=lambda row: f"{row['input']}{row['T']}-{row['sigma_deg']}")
def test_golden_estimates(row):
    t, u = golden_input(row["input"], row["T"])
    found = identify(t, u, noisy(PAR4_MOTOR, u, row["sigma_deg"]), start=(5, 2, 0.5))
    y = found.model_output
    assert np.allclose(parameters(found), row["est"], rtol=1e-5, atol=0)
    assert np.allclose(parameters(found), TRUE, rtol=0.01, atol=0)
    assert [y.min(), y.max()] == pytest.approx(row["y_range"], rel=0.02)
    assert found.evaluations <= 29
    if row["sigma_deg"]:
        assert np.allclose(found.standard_deviations, row["sd"], rtol=2e-3, atol=0)
        assert np.sqrt(np.mean(found.residuals**2)) == pytest.approx(row["rms"], rel=1e-6)
    assert found.warnings == ()


def test_all_starts_lead_to_the_same_motor(recording):
    best = identify(*recording)
    assert best.fit_percent > 98.0
    for start in ABSURD_STARTS:
        found = identify(*recording, start=start)
        assert np.allclose(parameters(found), parameters(best), rtol=1e-4, atol=0)
        assert found.evaluations <= 29


def test_twenty_seconds_with_twice_the_noise_are_still_enough():
    t, u = prbs(12.0, 20.0, PERIOD_S)
    assert parameters(identify(t, u, noisy(PAR4_MOTOR, u, sigma=1.0)))[0] == pytest.approx(9.4138, rel=0.01)


def test_intervals_cover_the_truth_as_often_as_they_say():
    """57 of 60 on average; 52 or more with probability 0.997, while intervals half as wide would give about 40."""
    t, u = prbs(12.0, 20.0, PERIOD_S)
    runs = [identify(t, u, noisy(PAR4_MOTOR, u, seed=seed), start=(9.4, 3.6, 0.18)) for seed in range(60)]
    lower, upper = np.moveaxis(np.array([run.confidence for run in runs]), -1, 0)
    assert (np.sum((lower < TRUE) & (upper > TRUE), axis=0) >= 52).all()
    scatter = np.std([parameters(run) for run in runs], axis=0, ddof=1)
    assert np.allclose(runs[0].standard_deviations, scatter, rtol=0.3, atol=0)
    assert sum(not run.warnings for run in runs) >= 58


def test_an_integrator_is_found_and_named():
    motor = Motor(420.0, 16.8, unit="mm")
    t, u = pulses(12.0, 30.0, PERIOD_S, motor=motor)
    found = identify(t, u, noisy(motor, u, sigma=0.1), unit="mm")
    assert found.motor.unit == "mm"
    speed_per_volt = found.motor.K / found.motor.T1
    assert speed_per_volt == pytest.approx(25.0, rel=1e-3)
    assert found.confidence[2, 0] == 0.0 < found.confidence[2, 1] < 0.1
    assert [text for text in found.warnings if "T2 cannot be told from 0" in text] == list(found.warnings)


def test_short_pulses_for_a_mounted_arm_are_enough():
    t, u = pulses(12.0, 60.0, PERIOD_S)
    found = identify(t, u, noisy(PAR4_MOTOR, u, sigma=0.1))
    assert np.allclose(parameters(found), TRUE, rtol=0.01, atol=0)


def test_estimated_initial_state(recording):
    t, u, y = (column[1234:] for column in recording)
    assumed_at_rest = identify(t, u, y)
    found = identify(t, u, y, initial_state="estimated")
    assert any("initial state" in text for text in assumed_at_rest.warnings)
    assert found.warnings == ()
    assert np.allclose(parameters(found), TRUE, rtol=0.01, atol=0)
    before, now, after = open_loop(PAR4_MOTOR, recording[1], PERIOD_S)[1233:1236]
    assert found.initial_state[0] == pytest.approx(now, abs=0.3)
    assert found.initial_state[1] == pytest.approx((after - before) / 0.02, abs=3.0)


def test_jittering_times_are_interpolated():
    """Some samples early or late by 5 % of a period; its output measured then, its input held until the next."""
    rng = np.random.default_rng(2)
    even, u = prbs(12.0, 8.0, PERIOD_S)
    t = even + 0.05 * PERIOD_S * rng.choice([-1, 0, 1], size=len(even))
    zoh, y, v = cache(PAR4_MOTOR.zoh), [0.0], 0.0
    for period_s, volt in zip(np.diff(t).round(12), u, strict=False):
        step = zoh(period_s)
        y_next = step.a11 * y[-1] + step.a12 * v + step.b1 * volt
        v = step.a21 * y[-1] + step.a22 * v + step.b2 * volt
        y.append(y_next)
    found = identify(t, u, y)
    assert np.allclose(np.diff(found.t), np.diff(found.t)[0])
    assert np.allclose(parameters(found), TRUE, rtol=1e-4, atol=0)
    assert not np.allclose(parameters(identify(even, u, y)), TRUE, rtol=1e-4, atol=0)


def test_advice_on_short_still_and_wrongly_wired_recordings(recording):
    t, u, y = (column[:1500] for column in recording)
    assert any("Only 10 s of data" in text for text in identify(t[:1000], u[:1000], y[:1000]).warnings)
    assert any("against the voltage" in text for text in identify(t, u, -y).warnings)
    held = np.full(len(t), 3.0)
    assert any("voltage never changes" in text for text in identify(t, held, noisy(PAR4_MOTOR, held)).warnings)
    noise = np.random.default_rng(1).standard_normal(500)
    assert any("explains only" in text for text in identify(t[:500], u[:500], noise).warnings)
    assert any("is known only to" in text for text in identify(t[:60], u[:60], y[:60]).warnings)


def test_a_motor_with_dry_friction_leaves_coloured_residuals():
    t, u = prbs(6.0, 20.0, PERIOD_S)
    y, v, out = 0.0, 0.0, []
    for volt in u:
        out.append(y)
        for _ in range(10):
            pull = volt - 1.5 * np.tanh(v)
            v += 1e-3 * (PAR4_MOTOR.K * pull - PAR4_MOTOR.T1 * v - PAR4_MOTOR.T2 * y)
            y += 1e-3 * v
    found = identify(t, u, np.array(out) + 0.05 * np.random.default_rng(0).standard_normal(len(t)))
    assert any("not white" in text for text in found.warnings)


def test_autocorrelation():
    assert autocorrelation(np.tile([1.0, -1.0], 500), 3) == pytest.approx([-0.999, 0.998, -0.997])


N = 100
RAMP, PUSH = np.arange(N) * PERIOD_S, np.ones(N)


@pytest.mark.parametrize(
    ("t", "u", "y", "complaint"),
    [
        (RAMP[:5], PUSH[:5], RAMP[:5], "only 5 samples"),
        (RAMP, PUSH[:-1], RAMP, "same length"),
        (RAMP, PUSH, np.zeros(N), "output never changes"),
        (RAMP, np.zeros(N), RAMP, "voltage is always zero"),
        (RAMP, np.append(np.zeros(N - 1), 1.0), RAMP, "voltage is always zero"),
        (RAMP, PUSH, np.append(RAMP[:-1], np.nan), "not finite"),
        (np.append(RAMP[:-1], np.inf), PUSH, RAMP, "not finite"),
        (RAMP, PUSH, RAMP * 1e12, "absurdly large"),
        (RAMP[::-1], PUSH, RAMP, "time does not increase after 0.99 s"),
        (np.delete(np.arange(N + 1), 40) * PERIOD_S, PUSH, RAMP, "step after 0.39 s is not the usual 0.01 s"),
        (RAMP * 1e3, PUSH, RAMP, "times in seconds"),
    ],
)
def test_unusable_data_are_refused_in_one_sentence(t, u, y, complaint):
    with pytest.raises(IdentificationError, match=complaint) as refusal:
        identify(t, u, y)
    assert str(refusal.value).endswith(".") and "\n" not in str(refusal.value)


@pytest.mark.parametrize("start", [(0, 1, 1), (-1, 1, 1), (np.nan, 1, 1), (np.inf, 1, 1), (1, 1)])
def test_an_impossible_start_is_refused(start, recording):
    with pytest.raises(IdentificationError, match="three positive numbers"):
        identify(*recording, start=start)
