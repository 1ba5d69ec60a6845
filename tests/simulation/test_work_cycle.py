"""The 5R's work cycle: the spec's tables (B7), the paper's orderings, and what is different."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from app.control.laws import Tuning
from app.motion import CYCLES, MotionError
from app.simulation import ControlledRun, TrackingError, work_cycle
from app.simulation.closed_loop import simulate
from app.simulation.work_cycle import ON_BELTS_S, cycle_experiment

FRICTION = {
    # W2, ideal measurement: peak, RMS and RMS on the belts in mm and mrad
    "PD": ((0.433, 0.196, 0.185, 5.74), (0.145, 0.128, 0.051, 2.38), (0.041, 0.154, 0.072, 0.87)),
    "PID": ((0.230, 0.194, 0.098, 3.94), (0.060, 0.030, 0.029, 0.81), (0.011, 0.007, 0.040, 0.42)),
    "TSIDC": ((0.262, 0.151, 0.091, 3.72), (0.128, 0.120, 0.021, 2.15), (0.040, 0.147, 0.029, 1.09)),
    "TSIIDC": ((0.170, 0.168, 0.077, 3.21), (0.035, 0.024, 0.018, 0.57), (0.009, 0.007, 0.025, 0.50)),
}
NO_FRICTION = {
    "PD": (0.283, 0.088, 0.069, 2.56),
    "PID": (0.132, 0.096, 0.045, 1.35),
    "TSIDC": (0.001, 0.000, 0.000, 0.006),
}
REAL_SENSORS = {
    "PD": (0.366, 0.187, 0.169, 5.32),
    "PID": (0.195, 0.199, 0.094, 3.75),
    "TSIDC": (0.278, 0.150, 0.076, 3.85),
    "TSIIDC": (0.191, 0.172, 0.073, 3.07),
}
"""One period of delay, 1e-5 rad, 200 Hz; peaks."""

SHARES = {
    # joint (from 0) -> percent
    ("PD", 0): {"p": 91.5, "d": 8.5},
    ("PID", 0): {"p": 24, "d": 6, "i": 70},
    ("TSIDC", 0): {"p": 52, "d": 5, "M": 36, "n": 7},
    ("TSIIDC", 0): {"p": 13, "d": 4, "i": 45, "M": 32, "n": 6},
    ("PD", 2): {"p": 83, "d": 17},
    ("PID", 2): {"p": 49, "d": 12, "i": 39},
    ("TSIDC", 2): {"p": 36, "d": 10, "M": 54, "n": 0},
    ("TSIIDC", 2): {"p": 22, "d": 10, "i": 27, "M": 40, "n": 0},
    ("PD", 3): {"p": 93, "d": 7},
    ("PID", 3): {"p": 24, "d": 6, "i": 70},
    ("TSIDC", 3): {"p": 63, "d": 4, "M": 33, "n": 0},
    ("TSIIDC", 3): {"p": 14, "d": 4, "i": 53, "M": 29, "n": 0},
}
DIGIT = 0.00051, 0.00051, 0.00051, 0.0051
"""What a printed digit leaves open, mm and mrad."""


@cache
def run_of(law: str, friction: bool = True) -> ControlledRun:
    return work_cycle(law, "W2", friction)


def agrees(ours: np.ndarray, printed: tuple[float, ...]) -> bool:
    return bool(np.all(np.abs(ours * 1e3 - printed) <= np.maximum(0.05 * np.array(printed), DIGIT)))


@pytest.mark.parametrize("law", FRICTION)
def test_the_spec_s_table_with_friction(law: str):
    run, (peak, rms, on_belts) = run_of(law), FRICTION[law]
    assert agrees(run.peak, peak) and agrees(run.rms, rms) and agrees(run.rms_within(ON_BELTS_S), on_belts)
    assert np.allclose(run.torque_peak, [38.3, 35.9, 28.8, 6.5], rtol=0.02)
    assert 0.088 < run.saturation[2] < 0.106 and not run.saturation[[0, 1, 3]].any()


@pytest.mark.parametrize("law", NO_FRICTION)
def test_the_spec_s_table_without_friction(law: str):
    assert agrees(run_of(law, False).peak, NO_FRICTION[law])


@pytest.mark.parametrize("law", REAL_SENSORS)
def test_the_spec_s_table_with_delay_encoder_and_filter(law: str):
    experiment = cycle_experiment(law, "W2").changed(delay_samples=1, encoder_step=1e-5, velocity_filter_hz=200.0)
    if law == "TSIIDC":
        experiment = experiment.changed(tuning=experiment.tuned.changed(integral_limit=(20.0, 20.0, 1.25, 300.0)))
    assert agrees(simulate(experiment).peak, REAL_SENSORS[law])


def test_shares_of_the_components():
    for (law, joint), printed in SHARES.items():
        shares = run_of(law).shares
        ours = {name: 100.0 * float(share[joint]) for name, share in shares.items()}
        assert ours == pytest.approx(printed, abs=0.7), (law, joint)


def test_torques_of_w1_without_friction_are_those_of_the_rigid_body():
    run = work_cycle("TSIDC", "W1", friction=False)
    assert np.allclose(run.torque_peak, [25.06, 24.01, 4.93, 2.90], rtol=0.005)
    assert np.allclose(run.torque_rms, [7.35, 7.02, 2.63, 1.29], rtol=0.005)
    assert run.overspeed.max() < 1.0 < run_of("TSIDC").overspeed[2]
    assert run_of("TSIDC").overspeed[2] == pytest.approx(4.5, rel=0.02)


def test_the_paper_s_orderings_that_hold():
    pd, pid, ts, tsi = (run_of(law) for law in FRICTION)
    assert (ts.peak[:2] < pd.peak[:2]).all() and (tsi.peak[:2] < pid.peak[:2]).all()
    assert tsi.rms[0] < pid.rms[0] < min(ts.rms[0], pd.rms[0])
    assert pd.peak[3] > ts.peak[3] > tsi.peak[3]
    assert (pid.rms < pd.rms).all() and (tsi.rms < ts.rms).all()
    shares = [run.shares["p"][0] for run in (pd, ts, pid, tsi)]
    assert shares == sorted(shares, reverse=True)


def test_the_orderings_that_do_not():
    _, pid, ts, tsi = (run_of(law) for law in FRICTION)
    assert pid.rms[1] < ts.rms[1], "friction decides, not the model"
    assert tsi.peak[1] > ts.peak[1]


def test_a_ranking_is_fair_at_equal_bandwidth_only():
    hard = Tuning.default("fivebar", "PD").changed(bandwidth_hz=(45.0, 45.0, 28.0, 28.0))
    quick = work_cycle("PD", "W2", tuning=hard)
    assert (quick.rms[:2] < run_of("TSIDC").rms[:2]).all()


def test_clamping_prevents_windup_of_z_only_with_a_tight_bound():
    experiment = cycle_experiment("TSIIDC", "W2")

    def peak_z_mm(bound: float) -> float:
        tuning = experiment.tuned.changed(integral_rate=150.0, integral_limit=(20.0, 20.0, bound, 300.0))
        return float(simulate(experiment.changed(tuning=tuning)).peak[2]) * 1e3

    assert peak_z_mm(10.0) > 2.0
    assert peak_z_mm(3.0) < 0.3


def test_a_model_too_light_is_a_loop_too_soft():
    """Friction makes nearly all of the error, and what resists it is the model's mass times kp."""
    run = simulate(cycle_experiment("TSIDC", "W2").changed(model_error=-0.1))
    assert np.allclose(run.rms[:2], run_of("TSIDC").rms[:2] / 0.9, rtol=0.02)


def test_mujoco_carries_the_item_as_a_body():
    cycle = replace(CYCLES["W1"], payload_kg=0.5)
    exact, mujoco = (work_cycle("TSIDC", cycle, True, plant) for plant in ("exact", "mujoco"))
    assert np.abs(exact.pose - mujoco.pose)[:, :3].max() < 2e-6
    empty = work_cycle("TSIDC", "W1")
    t, carried = empty.t, (0.84, 1.94)
    heavier = np.abs(exact.torque - empty.torque).max(axis=1)
    assert heavier[t < carried[0]].max() < 1e-9 < 0.5 < heavier[(t > carried[0]) & (t < carried[1])].max()
    assert exact.items is not None and mujoco.items is not None
    assert np.abs(exact.items - mujoco.items)[..., :3].max() < 5e-4
    handled = exact.items[:, 2, :3]
    inside = (t >= carried[0]) & (t < carried[1])
    assert np.allclose(handled[inside], exact.pose[inside, :3])


def test_unknown_or_impossible_cycles_are_refused():
    with pytest.raises(TrackingError, match="W1 or W2"):
        work_cycle("PD", "W3")
    with pytest.raises(MotionError):
        work_cycle("PD", replace(CYCLES["W1"], belt_speed_m_s=1.5))
