"""Rotary delta kinematics against values that were computed without the project's formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.robots import make_robot
from tests.robots.golden import golden, poses_from_mm

TOLERANCE = 1e-9
ROBOTS = {"classic": make_robot("delta3", preset="classic"), "desk_A4": make_robot("delta3")}


def test_inverse_reproduces_both_elbow_branches():
    for row in golden("delta3_ik")["rows"]:
        robot, pose = ROBOTS[row["set"]], poses_from_mm(row["pose"])
        assert np.allclose(robot.inverse(pose), row["q"], atol=TOLERANCE, rtol=0)
        assert np.allclose(robot.working_modes(pose)[1], row["q_other_branch"], atol=TOLERANCE, rtol=0)


def test_unreachable_poses():
    for row in golden("delta3_ik")["unreachable"]:
        robot, pose = ROBOTS[row["set"]], poses_from_mm(row["pose"])
        assert np.isnan(robot.inverse(pose)).any()
        assert not robot.reach(pose).ok


def test_forward_jacobian_conditioning_and_the_other_assembly():
    for row in golden("delta3_fk")["rows"]:
        robot, pose = ROBOTS[row["set"]], poses_from_mm(row["pose"])
        assert np.allclose(robot.forward(row["q"]), pose, atol=TOLERANCE, rtol=0)
        assert np.allclose(robot.jacobian(pose), np.array(row["Jinv_dq_dpose"]) * 1e3, atol=1e-9, rtol=1e-9)
        lower, upper = robot.assemblies(row["q"])
        assert lower.valid and not upper.valid
        assert np.allclose(upper.pose, poses_from_mm(row["upper_mode"]), atol=TOLERANCE, rtol=0)
        scaled = float(robot.conditioning(pose))
        assert scaled == pytest.approx(row["condJ_scaled"], rel=1e-9)


def test_joints_without_assembly_give_nan():
    for row in golden("delta3_fk")["fk_no_solution"]:
        if "set" in row:
            robot = ROBOTS[row["set"]]
        else:
            robot = make_robot("delta3", **{name: value / 1e3 for name, value in row["params"].items()})
        assert np.isnan(robot.forward(row["q"])).all()
        assert robot.assemblies(row["q"]) == []


SLICES = [row for row in golden("delta3_workspace")["rows"] if "n_ok" in row]


@pytest.mark.parametrize("row", SLICES, ids=lambda row: f"{row['set']}{row['z']}")
def test_workspace_slices(row):
    """The golden slices span 250 mm to either side; limits of -45 degrees are beyond the classic set's own."""
    robot = make_robot("delta3", preset=row["set"], q_min=-math.pi / 4)
    x, y = np.meshgrid(*[np.arange(-250.0, 251.0, row["step"])] * 2, indexing="ij")
    poses = np.stack([x, y, np.full_like(x, row["z"])], axis=-1) / 1e3
    assert int(robot.reachable(poses).sum()) == row["n_ok"]


SHEETS = [row for row in golden("delta3_workspace")["rows"] if "sheet" in row]


@pytest.mark.parametrize("row", SHEETS, ids=lambda row: f"{row['set']}{row['sheet']}{row['z']}")
def test_joint_range_and_conditioning_on_a_sheet(row):
    robot = ROBOTS[row["set"]]
    x, y = np.meshgrid(*[np.linspace(-side / 2, side / 2, 61) for side in row["sheet"]], indexing="ij")
    poses = np.stack([x, y, np.full_like(x, row["z"])], axis=-1) / 1e3
    joints = np.degrees(robot.inverse(poses))
    assert robot.reachable(poses).all()
    assert [joints.min(), joints.max()] == pytest.approx(row["q_deg"], abs=0.02)
    assert float(robot.conditioning(poses).max()) == pytest.approx(row["condJ_max"], rel=1e-3)


@given(st.lists(st.floats(-math.pi / 4, math.pi / 2), min_size=3, max_size=3))
def test_every_set_of_joints_within_limits_assembles(joints):
    robot = ROBOTS["desk_A4"]
    pose = robot.forward(joints)
    assert np.isfinite(pose).all()
    assert np.allclose(robot.inverse(pose), joints, atol=1e-8, rtol=0)
