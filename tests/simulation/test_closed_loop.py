"""Every law on every robot, and what is not ideal does what it must."""

from __future__ import annotations

import math
import pickle
from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.typing import ArrayLike

from app.control.laws import LAWS, Tuning
from app.motion.trajectory import Sample
from app.robots import ROBOTS, make_robot
from app.robots.dynamics import dynamics_of
from app.simulation.closed_loop import Experiment, compare, ranking, simulate
from app.simulation.helix import helix_experiment
from app.simulation.tracking import TrackingError

RISE_S = 0.2


@dataclass(frozen=True)
class Sway:
    """About home and back once: home + size sin^2(pi t / T), from rest to rest."""

    robot: str
    size_m: float = 0.01
    duration_s: float = RISE_S
    title: str = "Sway"

    def sample(self, t: ArrayLike) -> Sample:
        w, home = math.tau / self.duration_s, make_robot(self.robot).home
        phase = w * np.clip(np.asarray(t, dtype=float), 0.0, self.duration_s)[:, None]
        way = self.size_m * np.array([1.0, 0.7, 0.3, 2.0])[: len(home)]
        rate, acceleration = 0.5 * way * w * np.sin(phase), 0.5 * way * w * w * np.cos(phase)
        return Sample(home + 0.5 * way * (1.0 - np.cos(phase)), rate, acceleration)


def swaying(robot: str, law: str, **changes: object) -> Experiment:
    return Experiment(robot, {}, Sway(robot), law).changed(**changes)


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("law", LAWS)
def test_every_law_controls_every_robot(robot: str, law: str):
    run = simulate(swaying(robot, law))
    assert set(run.components) == set(LAWS[law].parts)
    n = len(make_robot(robot).joint_names)
    assert all(part.shape == (len(run.t), n) for part in run.components.values())
    assert np.allclose(sum(run.components.values()), run.torque, rtol=1e-9, atol=1e-8)
    assert np.allclose(sum(run.shares.values()), 1.0)
    assert (run.saturation == 0.0).all()
    assert run.peak[:3].max() < 0.012
    assert np.abs(run.tool_error[-1, :3]).max() < 0.012


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_right_model_without_friction_leaves_nearly_no_error(robot: str):
    perfect, wrong, heavy = compare(
        [
            swaying(robot, "CTC", friction=0.0),
            swaying(robot, "CTC", friction=0.0, model_error=0.1),
            swaying(robot, "CTC", friction=0.0, payload_kg=0.1),
        ]
    )
    assert perfect.peak[:3].max() < 3e-5
    assert wrong.peak[:3].max() > 3.0 * perfect.peak[:3].max()
    assert heavy.peak[:3].max() > 3.0 * perfect.peak[:3].max()
    assert [row.run for row in ranking([wrong, perfect])] == [perfect, wrong]


def test_components_add_up_with_wrong_sensors_and_a_wrong_model_too():
    run = simulate(
        swaying("linear", "TSIIDC", encoder_step=1e-5, velocity_filter_hz=100.0, model_error=-0.1, payload_kg=0.2)
    )
    assert np.allclose(sum(run.components.values()), run.torque, atol=1e-8)


def test_a_delay_holds_efforts_back_by_whole_periods():
    run = simulate(swaying("linear", "PD", delay_samples=3))
    wanted = np.sum(list(run.components.values()), axis=0)
    assert np.allclose(run.torque[:3], 0.0)
    assert np.allclose(run.torque[3:], wanted[:-3])


def test_an_encoder_tells_steps():
    step = 2e-4
    run = simulate(swaying("linear", "PD", encoder_step=step))
    gains = Tuning.default("linear", "PD").joint_gains()[0]
    read = run.q_ref - run.components["p"] / gains
    assert np.allclose(read, step * np.round(run.q / step), atol=1e-9)
    assert len(np.unique(np.round(read[:, 0] / step))) > 5


def test_a_filter_lags_behind_the_true_rate():
    run = simulate(swaying("linear", "PD", velocity_filter_hz=20.0))
    truth, sample = run.qd, Sway("linear").sample(run.t)
    wanted = dynamics_of(make_robot("linear")).joint_rates(sample.pose, sample.rate)
    told = wanted - run.components["d"] / Tuning.default("linear", "PD").joint_gains()[1]
    lag = 1.0 / (math.tau * 20.0)
    expected = np.array([np.interp(run.t - lag, run.t, column) for column in truth.T]).T
    settled = run.t > 0.03
    assert np.abs(told - truth)[settled].max() > 0.02
    assert np.abs(told - expected)[settled].max() < 0.4 * np.abs(told - truth)[settled].max()


def test_a_loop_that_runs_away_is_one_sentence_whatever_its_sensor():
    wild = helix_experiment("PID", "T2").changed(
        tuning=Tuning.equal("linear", "PID", 40.0), delay_samples=5, encoder_step=1e-5, velocity_filter_hz=200.0
    )
    with pytest.raises(TrackingError, match=r"torn out of its reach after \d"):
        simulate(wild)


def test_efforts_are_limited_unless_asked_otherwise():
    limited = simulate(swaying("linear", "CTC", effort_share=0.2))
    assert np.abs(limited.torque).max() == pytest.approx(12.0) and limited.saturation.max() > 0.1
    free = simulate(swaying("linear", "CTC", effort_share=0.2, limit_effort=False))
    assert np.abs(free.torque).max() > 15.0


def test_a_drive_at_its_largest_speed_pushes_no_further():
    fast = Experiment("linear", {}, Sway("linear", size_m=0.1), "CTC", friction=0.0)
    free, held = compare([fast, fast.changed(limit_speed=True)])
    assert 1.0 < held.overspeed.max() < free.overspeed.max()
    beyond = np.abs(free.qd) > free.speed_limit
    assert (free.torque[beyond] * free.qd[beyond]).max() > 1.0
    beyond = np.abs(held.qd) > held.speed_limit
    assert (held.torque[beyond] * held.qd[beyond]).max() <= 1e-9


def test_mpc_keeps_to_the_limits_by_itself_and_beats_a_clipped_law():
    from app.simulation.helix import Helix, helix_experiment

    hard = Helix("hard", 0.08, 3.0 * math.pi, -0.5, -0.02, 1.0)
    experiment = helix_experiment("CTC", hard, True, start="reference").changed(effort_share=0.22)
    clipped, planned = compare([experiment, experiment.changed(law="MPC")])
    assert clipped.saturation.max() > 0.3
    limit = planned.effort_limit
    assert np.all(np.abs(np.sum(list(planned.components.values()), axis=0)) <= limit * (1.0 + 1e-5))
    assert planned.rms_distance_m() < 0.85 * clipped.rms_distance_m()


def test_progress_is_told_and_can_end_a_run():
    told: list[float] = []
    compare([swaying("fivebar", "PD"), swaying("fivebar", "PID")], told.append)
    assert told == sorted(told) and 0.0 <= told[0] < told[-1] < 1.0

    class Enough(Exception):
        pass

    def stop(share: float) -> None:
        raise Enough

    with pytest.raises(Enough):
        simulate(swaying("linear", "PD"), stop)


def test_experiments_and_runs_travel_between_processes():
    experiment = pickle.loads(pickle.dumps(swaying("delta3", "CTC+DOB")))
    run = pickle.loads(pickle.dumps(simulate(experiment)))
    assert run.law == "CTC+DOB" and run.pose.shape == run.pose_ref.shape
    assert run.csv().count("\n") == len(run.t) + 1


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"law": "LQR"}, "no control law 'LQR'"),
        ({"plant": "adams"}, "exact or mujoco"),
        ({"friction": -1.0}, "cannot be negative"),
        ({"delay_samples": -1}, "cannot be negative"),
        ({"model_error": -1.0}, "above -100 %"),
        ({"effort_share": 0.0}, "above 0"),
        ({"period_s": 1e-9}, "periods"),
        ({"trajectory": Sway("linear", size_m=1.0)}, "out of reach"),
    ],
)
def test_a_senseless_experiment_is_refused_in_one_sentence(changes: dict[str, object], sentence: str):
    with pytest.raises(TrackingError, match=sentence):
        simulate(swaying("linear", "PD").changed(**changes))


def test_a_robot_that_is_torn_out_of_its_reach_is_reported():
    wild = replace(Tuning.equal("linear", "CTC", 150.0), damping=(0.2,) * 3)
    experiment = swaying("linear", "CTC", tuning=wild, delay_samples=8, limit_effort=False)
    with pytest.raises(TrackingError, match="torn out of its reach after"):
        simulate(experiment)
