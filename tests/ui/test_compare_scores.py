"""The figures on the page are those of the runs; what is kept of a run is every millisecond of it."""

from __future__ import annotations

import csv
import io
import pickle
from dataclasses import replace

import numpy as np
import pytest

from app.robots import ROBOTS
from app.simulation import ControlledRun
from app.simulation.closed_loop import simulate
from app.ui.compare.jobs import Result, comparison_csv, experiment, run_law, thinned
from app.ui.compare.score import LATER, WHOLE, error_columns, quantities, ranking, score_of, unit_of
from app.ui.compare.settings import CompareSettings, default_compare
from app.ui.refusal import Refusal

LAWS = ("PD", "PID", "CTC")


def ran(settings: CompareSettings, law: str) -> Result:
    result = run_law(settings, law, {}, None)
    assert isinstance(result, Result), result
    return result


@pytest.fixture(scope="module")
def helix() -> dict[str, Result]:
    return {law: ran(default_compare("linear"), law) for law in LAWS}


@pytest.fixture(scope="module")
def rough_helix() -> dict[str, Result]:
    return {law: ran(replace(default_compare("linear"), friction=1.0), law) for law in LAWS}


@pytest.fixture(scope="module")
def cycle_run() -> ControlledRun:
    """As simulated, at 4 kHz."""
    return simulate(experiment(default_compare("fivebar"), "PID", {}, None))


def test_the_thesis_comparison_gives_the_figures_of_the_spec(helix: dict[str, Result]):
    scores = {law: result.score for law, result in helix.items()}
    assert ranking(scores, "position", LATER) == ["CTC", "PID", "PD"]
    assert scores["PD"].rms_of("z", LATER) == pytest.approx(2.785, rel=0.05), "spec A6, T1 ideal"
    assert scores["PID"].rms_of("x", LATER) == pytest.approx(0.033, rel=0.05)
    assert scores["CTC"].rms_of("y", WHOLE) == pytest.approx(0.641, rel=0.05), "and over the whole run"


def test_friction_lets_the_integral_win_in_z(rough_helix: dict[str, Result]):
    scores = {law: result.score for law, result in rough_helix.items()}
    assert ranking(scores, "z", LATER) == ["PID", "CTC", "PD"], "spec A6, T1 with friction: .057, .264, 2.509"
    assert scores["CTC"].rms_of("z", LATER) == pytest.approx(0.264, rel=0.05)


def test_a_score_is_what_the_run_says(cycle_run: ControlledRun):
    score = score_of(cycle_run, ("x", "y", "z", "phi"))
    assert score.quantities == ("position", "in plane", "x", "y", "z", "φ") and unit_of("φ") == "mrad"
    axes = slice(2, None)
    assert score.rms[WHOLE][axes] == pytest.approx(cycle_run.rmse_mm)
    assert score.rms[LATER][axes] == pytest.approx(cycle_run.rmse_after_1s_mm)
    assert score.peak[WHOLE][axes] == pytest.approx(1e3 * cycle_run.peak)
    assert score.rms_of("position", WHOLE) == pytest.approx(1e3 * cycle_run.rms_distance_m())
    assert score.peak_of("in plane", WHOLE) == pytest.approx(1e3 * cycle_run.in_plane_error.max())
    assert score.effort_limit == pytest.approx((89.6, 89.6, 28.8, 28.8))
    assert sum(share[2] for share in score.shares.values()) == pytest.approx(1.0)


def test_what_is_kept_is_every_millisecond(cycle_run: ControlledRun):
    kept = thinned(cycle_run)
    assert kept.t == pytest.approx(np.arange(0.0, cycle_run.t[-1] + 1e-9, 1e-3))
    at = slice(None, None, 4)
    for name in ("pose", "pose_ref", "q", "q_ref", "u"):
        assert (getattr(kept, name) == getattr(cycle_run, name)[at]).all(), name
    assert (kept.components["i"] == cycle_run.components["i"][at]).all()
    assert kept.effort_limit == pytest.approx(cycle_run.effort_limit)
    assert (error_columns(kept) == error_columns(cycle_run)[at]).all()
    assert len(pickle.dumps(kept)) < 2e6, "six of them are kept for every student"


def test_all_runs_go_into_one_file(helix: dict[str, Result]):
    rows = [*csv.DictReader(io.StringIO(comparison_csv([result.run for result in helix.values()]).decode()))]
    assert len(rows) == sum(len(result.run.t) for result in helix.values())
    assert [*dict.fromkeys(row["law"] for row in rows)] == [*LAWS]
    last = helix["CTC"].run
    assert float(rows[-1]["z_actual_mm"]) == pytest.approx(1e3 * last.pose[-1, 2], rel=1e-5)


def test_every_setting_reaches_the_simulation():
    settings = CompareSettings(
        "linear", "T2", LAWS, "equal", 20.0, {}, 0.5, 0.3, -0.1, 1e-5, 2, 200.0, limit_effort=False, plant="mujoco"
    )
    made = experiment(settings, "CTC", {"l": 0.37}, None)
    assert made.dimensions == {"l": 0.37} and made.law == "CTC" and made.tuned.bandwidth_hz == (20.0,) * 3
    assert (made.friction, made.payload_kg, made.model_error) == (0.5, 0.3, -0.1)
    assert (made.encoder_step, made.delay_samples, made.velocity_filter_hz) == (1e-5, 2, 200.0)
    assert (made.limit_effort, made.plant) == (False, "mujoco")


def test_what_cannot_be_followed_is_refused_in_a_sentence():
    result = run_law(CompareSettings("linear", "T2", LAWS), "PD", {"l": 0.26}, None)
    assert isinstance(result, Refusal) and result.reason.endswith(".")


@pytest.mark.parametrize("name", ROBOTS)
def test_every_coordinate_of_every_robot_can_be_looked_at(name: str):
    found = quantities(ROBOTS[name].build.pose_names)
    assert len(found) == len(ROBOTS[name].build.pose_names) + 2
    assert found[:2] == ("position", "in plane") and all(unit_of(quantity) in ("mm", "mrad") for quantity in found)
