"""All drives of every robot along every path, and what is refused."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from app.control import PID_AUTO, Pid
from app.control.drives import DRIVES
from app.control.sampled_pid import Sampling
from app.motion import PATHS, Tour
from app.robots import ROBOTS, make_robot
from app.simulation import Run, Task, TrackingError, follow_sampled, follow_simulink
from app.simulation.hardware import Hardware
from app.simulation.tracking import MAX_SAMPLES, SMOOTH_START_S, resting_joints, sample_times

CROSSOVER_RAD_S = 25.0
SIZE_M, LAP_S = 0.03, 8.0


def decent(name: str) -> Pid:
    """Fast and well damped for the robot's own motor."""
    motor = DRIVES[name].motor
    kp = CROSSOVER_RAD_S * abs(complex(motor.T1, CROSSOVER_RAD_S)) / motor.K / 1.2
    return Pid(kp, 0.05 * CROSSOVER_RAD_S * kp, kp / CROSSOVER_RAD_S, 20.0 * CROSSOVER_RAD_S)


def follow(task: Task, hardware: Hardware | None = None) -> Run:
    drive = DRIVES[task.robot]
    hardware = hardware or Hardware(supply_v=drive.supply_v)
    return follow_sampled(task, drive.motor, decent(task.robot), Sampling(drive.period_s), hardware, "Tour")


def small(name: str, path: str = "circle", start: str = "smooth", duration_s: float = 5.0 + LAP_S) -> Task:
    return Task(name, tour=Tour(path, SIZE_M, LAP_S), duration_s=duration_s, start=start)  # pyright: ignore


@cache
def smooth(name: str, path: str) -> Run:
    return follow(small(name, path))


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("path", PATHS)
def test_every_robot_follows_every_path(name: str, path: str):
    run = smooth(name, path)
    assert run.tool_error_m.max() < 0.002
    robot = make_robot(name)
    lap = run.pose[run.t >= SMOOTH_START_S, :2] - robot.home[:2]
    assert np.linalg.norm(lap, axis=1).max() == pytest.approx(SIZE_M, abs=0.002)
    assert run.title == "Tour" and run.effort_unit == "V" and run.u_max == DRIVES[name].supply_v
    assert run.saturation_share < 0.05


@pytest.mark.parametrize("name", ROBOTS)
def test_the_error_index_is_the_integral_of_the_squared_joint_error(name: str):
    run = smooth(name, "circle")
    assert np.allclose(run.ise, (run.joint_error**2).sum(0) * DRIVES[name].period_s, rtol=1e-9)


@pytest.mark.parametrize("name", ROBOTS)
def test_a_smooth_start_is_at_rest_and_ends_on_the_path(name: str):
    run, robot = smooth(name, "circle"), make_robot(name)
    assert np.array_equal(run.q_ref[0], resting_joints(robot)) and np.allclose(run.q[0], run.q_ref[0], atol=1e-12)
    assert np.allclose(run.u[0], 0.0, atol=1e-9)
    h = run.t[1]
    reach = np.abs(run.q_ref[0] - run.q_ref[run.t >= SMOOTH_START_S][0])
    assert (np.abs(run.q_ref[1] - run.q_ref[0]) <= reach * (h / SMOOTH_START_S) ** 3 * 10.1 + 1e-12).all()
    on_path = run.t >= SMOOTH_START_S
    expected = Tour("circle", SIZE_M, LAP_S).poses(robot, run.t[on_path] - SMOOTH_START_S)
    assert np.allclose(run.pose_ref[on_path], expected, atol=1e-9)
    jump = np.abs(np.diff(run.q_ref, axis=0)).max()
    assert jump < 4.0 * np.abs(np.diff(run.q_ref[on_path], axis=0)).max()


@pytest.mark.parametrize("name", ROBOTS)
def test_from_rest_the_first_instant_is_a_step_and_from_the_reference_it_is_not(name: str):
    robot = make_robot(name)
    from_rest = follow(small(name, start="rest", duration_s=0.1))
    on_path = follow(small(name, start="reference", duration_s=0.1))
    assert np.allclose(from_rest.q[0], resting_joints(robot), atol=1e-12)
    assert np.allclose(on_path.q[0], on_path.q_ref[0], atol=1e-12)
    assert np.array_equal(from_rest.q_ref, on_path.q_ref)
    assert from_rest.tool_error_m[0] > 0.02 and on_path.tool_error_m[0] < 1e-9
    assert np.abs(from_rest.u[0]).max() == DRIVES[name].supply_v and np.allclose(on_path.u[0], 0.0, atol=1e-9)


@pytest.mark.parametrize("name", ROBOTS)
def test_robots_rest_at_zero_where_they_can_stand_there_and_else_at_home(name: str):
    robot = make_robot(name)
    rest = resting_joints(robot)
    assert robot.reachable(robot.forward(rest))
    if name == "fivebar":
        assert np.allclose(robot.forward(rest), robot.home, atol=1e-9)
    else:
        assert np.array_equal(rest, np.zeros(len(robot.joint_names)))


@pytest.mark.parametrize("name", ROBOTS)
def test_a_path_out_of_reach_is_refused_with_the_limit_in_the_way(name: str):
    task = replace(small(name), tour=Tour("circle", 1.5, LAP_S))
    robot = make_robot(name)
    with pytest.raises(TrackingError, match="make it smaller") as refusal:
        follow(task)
    sentence = str(refusal.value)
    reason = robot.reach(task.tour.poses(robot, 0.0)).reason.rstrip(".")
    assert reason and reason[1:] in sentence
    assert sentence.startswith("Part of the path is out of reach (") and sentence.count(".") == 1


def test_only_the_part_that_is_run_has_to_be_in_reach():
    """The square's corner is out of the Par4's reach, the middle of its side is not."""
    robot = make_robot("par4")
    tour = Tour("square", 0.2, LAP_S)
    poses = tour.poses(robot, np.linspace(0.0, LAP_S, 801))
    inside = robot.reachable(poses)
    assert inside[0] and not inside.all()
    leaves = LAP_S * float(np.argmin(inside)) / 800
    follow(Task(tour=tour, duration_s=leaves - 0.05, start="reference"))
    with pytest.raises(TrackingError):
        follow(Task(tour=tour, duration_s=leaves + 0.05, start="reference"))


def test_noise_repeats_run_after_run_and_differs_between_joints():
    noisy = Hardware(supply_v=12.0, noise=0.3)
    first, again = (follow(small("par4", start="reference", duration_s=1.0), noisy) for _ in range(2))
    assert np.array_equal(first.q, again.q) and np.array_equal(first.u, again.u)
    calm = follow(small("par4", start="reference", duration_s=1.0))
    noise = first.u - calm.u
    assert np.abs(noise).max() > 0.5
    correlation = np.corrcoef(noise.T) - np.eye(4)
    assert np.abs(correlation).max() < 0.5


def test_finely_computed_hardware_is_still_recorded_once_a_period():
    run = follow(small("par4", start="reference", duration_s=1.0), Hardware(12.0, backlash=0.2, delay_s=0.002))
    assert run.t.shape == (100,) and run.q.shape == run.u.shape == (100, 4)
    assert np.allclose(run.ise, (run.joint_error**2).sum(0) * 0.01, rtol=1e-9)


def test_the_motor_is_the_one_that_is_given():
    weak = replace(DRIVES["par4"].motor, K=2.0)
    task = small("par4", duration_s=8.0)
    run = follow_sampled(task, weak, decent("par4"), Sampling(), Hardware(supply_v=12.0))
    assert (run.ise > 2.0 * follow(task).ise).all()


@pytest.mark.parametrize("name", ROBOTS)
def test_the_papers_simulation_runs_every_robot_from_rest_in_percent(name: str):
    run = follow_simulink(small(name, start="rest", duration_s=3.0), decent(name), 100.0, 0.002)
    assert run.effort_unit == "%" and run.t.shape == (1500,)
    assert np.allclose(run.q[0], resting_joints(make_robot(name)), atol=1e-12)
    assert run.tool_error_m[0] > 0.02 and run.tool_error_m[-1] < 0.002
    for start in ("reference", "smooth"):
        with pytest.raises(TrackingError, match="starts from rest"):
            follow_simulink(small(name, start=start), decent(name), 100.0)


def test_sample_times_end_just_before_the_duration():
    assert np.allclose(sample_times(0.05, 0.01), [0.0, 0.01, 0.02, 0.03, 0.04])
    assert len(sample_times(0.7, 0.1)) == 7 and len(sample_times(1.0, 1.0)) == 1
    assert len(sample_times(MAX_SAMPLES * 0.01, 0.01)) == MAX_SAMPLES


@pytest.mark.parametrize("duration", [0.0, -1.0, 0.009, 2001.0, math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("step", [0.01, 0.0, -0.01, math.nan])
def test_times_that_make_no_sense_are_refused(duration: float, step: float):
    with pytest.raises(TrackingError, match="cannot be computed"):
        sample_times(duration, step)


@pytest.mark.parametrize("lap", [0.0, -1.0, math.nan])
def test_a_lap_takes_some_time(lap: float):
    with pytest.raises(TrackingError, match="lap"):
        follow(Task(tour=Tour(lap_s=lap), duration_s=1.0))


@pytest.mark.parametrize("u_max", [0.0, -12.0, math.nan])
def test_a_limit_lies_above_zero(u_max: float):
    with pytest.raises(TrackingError, match="limit"):
        follow(small("par4"), Hardware(supply_v=u_max))
    with pytest.raises(TrackingError, match="limit"):
        follow_simulink(small("par4", start="rest"), PID_AUTO, u_max)


def test_an_unknown_start_is_refused_by_name():
    with pytest.raises(TrackingError, match="'halfway'"):
        follow(small("par4", start="halfway"))
