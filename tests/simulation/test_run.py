"""What can be read off a recorded run."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import replace

import numpy as np
import pytest

from app.control import PID_AUTO
from app.control.drives import DRIVES
from app.control.sampled_pid import Sampling
from app.motion import Tour
from app.robots import ROBOTS, make_robot
from app.simulation import Run, Task, circle_tracking, follow_sampled
from app.simulation.hardware import Hardware

HEAD = {
    "par4": "t_s,x_ref_mm,y_ref_mm,z_ref_mm,theta_ref_deg,x_actual_mm,y_actual_mm,z_actual_mm,theta_actual_deg,"
    "q1_ref_deg,q2_ref_deg,q3_ref_deg,q4_ref_deg,q1_actual_deg,q2_actual_deg,q3_actual_deg,q4_actual_deg,"
    "u_q1_V,u_q2_V,u_q3_V,u_q4_V",
    "linear": "t_s,x_ref_mm,y_ref_mm,z_ref_mm,x_actual_mm,y_actual_mm,z_actual_mm,"
    "d1_ref_mm,d2_ref_mm,d3_ref_mm,d1_actual_mm,d2_actual_mm,d3_actual_mm,u_d1_V,u_d2_V,u_d3_V",
}


def made(name: str, count: int = 50) -> Run:
    """A run whose joints follow a small circle late by a tenth of a lap."""
    robot = make_robot(name)
    t = np.arange(count, dtype=float) * 0.01
    tour = Tour(size_m=0.03, lap_s=0.01 * count)
    rng = np.random.default_rng(5)
    poses, late = tour.poses(robot, t), tour.poses(robot, t - 0.001 * count)
    n = len(robot.joint_names)
    u = rng.uniform(-12.0, 12.0, (count, n))
    return Run("made", name, t, poses, robot.inverse(poses), robot.inverse(late), u, 12.0, "V", np.ones(n))


@pytest.mark.parametrize("name", ROBOTS)
def test_csv_round_trip(name: str):
    run, robot = made(name), make_robot(name)
    rows = list(csv.reader(io.StringIO(run.csv())))
    head, table = rows[0], np.array(rows[1:], dtype=float)
    column = dict(zip(head, table.T, strict=True))
    assert len(set(head)) == len(head) and table.shape == (50, 1 + 2 * robot.dof + 3 * len(robot.joint_names))
    assert np.allclose(column["t_s"], run.t, atol=1e-9)
    pose_units = ["mm"] * 3 + ["deg"] * (robot.dof - 3)
    for k, (axis, unit) in enumerate(zip(robot.pose_names, pose_units, strict=True)):
        si = 1e3 if unit == "mm" else 180.0 / math.pi
        for kind, values in (("ref", run.pose_ref), ("actual", run.pose)):
            assert np.allclose(column[f"{axis}_{kind}_{unit}"], si * values[:, k], rtol=1e-5, atol=1e-6)
    factor = 1e3 if run.joint_unit == "mm" else 180.0 / math.pi
    for k, joint in enumerate(robot.joint_names):
        for kind, values in (("ref", run.q_ref), ("actual", run.q)):
            assert np.allclose(column[f"{joint}_{kind}_{run.joint_unit}"], factor * values[:, k], rtol=1e-5, atol=1e-6)
        assert np.allclose(column[f"u_{joint}_V"], run.u[:, k], rtol=1e-5)
    assert run.csv().endswith("\n") and "nan" not in run.csv()


@pytest.mark.parametrize("name", HEAD)
def test_csv_heads_name_quantity_kind_and_unit(name: str):
    assert made(name).csv().splitlines()[0] == HEAD[name]
    assert replace(made(name), effort_unit="N").csv().splitlines()[0] == HEAD[name].replace("_V", "_N")


@pytest.mark.parametrize("name", ROBOTS)
def test_the_pose_belongs_to_the_joints(name: str):
    run, robot = made(name), make_robot(name)
    late = Tour(size_m=0.03, lap_s=0.5).poses(robot, run.t - 0.05)
    assert np.allclose(run.pose, late, atol=1e-8)
    assert np.allclose(run.tool_error_m, np.linalg.norm((run.pose_ref - late)[:, :3], axis=1), atol=1e-8)
    assert np.allclose(run.tool_error_m, 2 * 0.03 * math.sin(math.pi * 0.1), atol=1e-8), "a chord of the circle"


def test_height_counts_as_tool_error_and_rotation_does_not():
    run = made("par4")
    higher = replace(run, pose_ref=run.pose + [0.0, 0.0, 0.004, 0.0])
    assert np.allclose(higher.tool_error_m, 0.004)
    turned = replace(run, pose_ref=run.pose_ref + [0.0, 0.0, 0.0, 0.3])
    assert np.allclose(turned.tool_error_m, run.tool_error_m)


def test_where_joints_do_not_assemble_the_tool_is_held():
    """Four joints moved at will cannot all close; and before the first pose that can, the reference stands in."""
    run, robot = made("par4"), make_robot("par4")
    q = run.q.copy()
    q[[0, 1, 10, 11, 12, 49]] = np.radians([120.0, -120.0, 120.0, -120.0])
    assert np.isnan(robot.forward(q[0])).any()
    broken = replace(run, q=q)
    assert np.array_equal(broken.pose[:2], run.pose_ref[:2])
    assert np.array_equal(broken.pose[2:10], run.pose[2:10])
    assert np.array_equal(broken.pose[10:13], np.repeat(run.pose[9:10], 3, axis=0))
    assert np.array_equal(broken.pose[13:49], run.pose[13:49])
    assert np.array_equal(broken.pose[49], run.pose[48])


@pytest.mark.parametrize(("name", "unit", "factor"), [("par4", "deg", 180 / math.pi), ("linear", "mm", 1000.0)])
def test_joint_errors_are_in_the_unit_that_joints_are_read_in(name: str, unit: str, factor: float):
    run = made(name)
    assert run.joint_unit == unit
    assert np.allclose(run.joint_error, factor * (run.q_ref - run.q)) and np.abs(run.joint_error).max() > 1.0


def test_saturation_is_the_share_of_signals_at_the_limit():
    run = made("par4")
    u = np.zeros((50, 4))
    u[:10, 0], u[5:10, 2], u[20, 1] = 12.0, -12.0, 11.99
    assert replace(run, u=u).saturation_share == pytest.approx(15 / 200)
    assert replace(run, u=u, u_max=math.inf).saturation_share == 0.0
    assert circle_tracking("auto", "sampled", 12.0, duration_s=0.2).saturation_share > 0.5


def test_changed_dimensions_change_the_pose():
    task = Task(dimensions={"l": 0.42}, tour=Tour(size_m=0.05, lap_s=2.0), duration_s=0.5, start="reference")
    run = follow_sampled(task, DRIVES["par4"].motor, PID_AUTO, Sampling(), Hardware())
    assert run.dimensions == {"l": 0.42}
    assert np.allclose(run.pose, make_robot("par4", l=0.42).forward(run.q), atol=1e-9)
    assert not np.allclose(run.pose, make_robot("par4").forward(run.q), atol=1e-3)
    assert run.tool_error_m.max() < 0.02
