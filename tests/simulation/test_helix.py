"""The linear delta on a helix: the spec's table (A6), what the thesis claims, and what holds only sometimes."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from app.control.laws import Tuning
from app.motion.trajectory import Trajectory
from app.simulation import ControlledRun, TrackingError, helix_tracking
from app.simulation.closed_loop import simulate
from app.simulation.helix import HELICES, HelixStart, helix_experiment

TABLE = {
    # law: RMSE in mm (x, y, z) for t >= 1 s: T1, T1 with friction, T2, T2 with friction
    "PD": ((0.103, 0.103, 2.785), (1.014, 1.014, 2.509), (0.256, 0.256, 2.669), (1.935, 1.935, 2.729)),
    "PID": ((0.033, 0.032, 0.0005), (0.465, 0.465, 0.057), (0.166, 0.166, 0.040), (1.130, 1.129, 0.491)),
    "PD+": ((0.050, 0.049, 0.0026), (0.999, 0.998, 0.278), (1.302, 1.300, 0.565), (2.387, 2.385, 0.545)),
    "PDff": ((0.005, 0.005, 0.0003), (0.989, 0.989, 0.278), (0.140, 0.140, 0.060), (1.910, 1.909, 0.237)),
    "CTC": ((0.002, 0.002, 0.0001), (0.372, 0.372, 0.264), (0.056, 0.056, 0.016), (0.726, 0.727, 0.161)),
    "CTC+DOB": ((0.000, 0.000, 0.0000), (0.019, 0.019, 0.010), (0.0012, 0.0012, 0.0001), (0.045, 0.045, 0.034)),
}
CASES = (("T1", False), ("T1", True), ("T2", False), ("T2", True))


@cache
def run_of(law: str, trajectory: str, friction: bool, start: HelixStart = "axis") -> ControlledRun:
    return helix_tracking(law, trajectory, friction, start=start)


def agrees(ours: np.ndarray, printed: tuple[float, ...]) -> bool:
    """Within 5 %, or within half a unit of the last digit where that is coarser."""
    digits = [len(f"{value}".split(".")[1]) for value in printed]
    coarse = [0.5 * 10.0 ** -max(count, 3) for count in digits]
    return bool(np.all(np.abs(ours - printed) <= np.maximum(0.05 * np.array(printed), coarse)))


@pytest.mark.parametrize("law", TABLE)
def test_the_spec_s_table(law: str):
    for (trajectory, friction), printed in zip(CASES, TABLE[law], strict=True):
        ours = run_of(law, trajectory, friction).rmse_after_1s_mm
        assert agrees(ours, printed), f"{trajectory}, friction {friction}: {ours}, printed {printed}"


def test_over_the_whole_run_the_start_decides():
    whole = {law: run_of(law, "T1", False).rmse_mm[1] for law in ("PD", "PID", "CTC")}
    assert whole == pytest.approx({"PD": 0.756, "PID": 0.825, "CTC": 0.641}, rel=0.002)
    assert whole["PD"] < whole["PID"]


def test_from_home_all_laws_look_alike_as_in_the_thesis():
    printed = {"PD": 6.85, "PID": 6.86, "PD+": 6.34, "CTC": 6.25}
    for law, error in printed.items():
        assert run_of(law, "T1", False, "home").rmse_mm[2] == pytest.approx(error, rel=0.002)
    assert run_of("CTC", "T1", False, "home").rmse_after_1s_mm[2] < 0.001


@pytest.mark.parametrize("case", CASES)
def test_the_thesis_ranking_holds_after_the_transient(case: tuple[str, bool]):
    pd, pid, ctc = (run_of(law, *case).rmse_after_1s_mm[:2] for law in ("PD", "PID", "CTC"))
    assert (ctc < pid).all() and (pid < pd).all()


def test_where_the_ranking_does_not_hold():
    gravity, pd = (run_of(law, "T2", False).rmse_after_1s_mm[:2] for law in ("PD+", "PD"))
    assert (gravity > pd).all()
    assert run_of("CTC", "T1", True).rmse_after_1s_mm[2] > run_of("PID", "T1", True).rmse_after_1s_mm[2]


def test_with_soft_gains_and_friction_the_integral_does_harm():
    soft = [
        helix_tracking(law, "T2", True, tuning=Tuning.from_gains("linear", law, (600.0,) * 3, (110.0,) * 3, 2500.0))
        for law in ("PD", "PID")
    ]
    pd, pid = (run.rmse_after_1s_mm[:2] for run in soft)
    assert (pid > pd).all()


def test_pd_sags_by_its_weight_over_its_stiffness():
    run = run_of("PD", "T1", False)
    assert run.rmse_after_1s_mm[2] == pytest.approx(np.abs(run.torque).mean() / 3000.0 * 1e3, rel=0.01)


def test_starts():
    for start, first in {"axis": (0, 0, -0.40), "home": (0, 0, -0.3164), "reference": (0, 0.01, -0.40)}.items():
        run = run_of("CTC", "T1", False, start)  # pyright: ignore[reportArgumentType]
        assert np.allclose(run.pose[0], first, atol=1e-12)
    assert run_of("CTC", "T1", False, "reference").peak.max() < 1e-5


def test_mujoco_agrees_with_the_analytic_plant():
    brief = replace(HELICES["T2"], duration_s=0.5)
    exact, mujoco = (helix_tracking("CTC", brief, True, plant, start="reference") for plant in ("exact", "mujoco"))
    assert mujoco.plant == "mujoco"
    assert np.abs(exact.pose - mujoco.pose).max() < 1e-5
    assert np.allclose(exact.rms, mujoco.rms, rtol=0.02)


def test_the_right_model_is_better_than_the_lumped_one():
    exact = simulate(helix_experiment("CTC", "T2", False).changed(model={}))
    assert (exact.rmse_after_1s_mm < 0.1 * run_of("CTC", "T2", False).rmse_after_1s_mm).all()


def test_a_helix_is_a_trajectory():
    helix: Trajectory = HELICES["T2"]
    t = np.linspace(0.5, 4.5, 9)
    pose, rate, acceleration = helix.sample(t)
    after, before = helix.sample(t + 1e-5), helix.sample(t - 1e-5)
    assert np.allclose((after.pose - before.pose) / 2e-5, rate, atol=1e-7)
    assert np.allclose((after.rate - before.rate) / 2e-5, acceleration, atol=1e-6)
    beyond = helix.sample(np.array([-1.0, 9.0]))
    assert np.allclose(beyond.pose, [[0.0, 0.08, -0.45], pose[0] * 0 + helix.sample(np.array([5.0])).pose[0]])
    assert not beyond.rate.any() and not beyond.acceleration.any()


def test_unknown_names_are_refused():
    with pytest.raises(TrackingError, match="T1 or T2"):
        helix_tracking("PD", "T3")
    with pytest.raises(TrackingError, match="axis, home or reference"):
        helix_tracking("PD", start="there")  # pyright: ignore[reportArgumentType]
    with pytest.raises(TrackingError, match="CTC"):
        helix_tracking("LQR")
