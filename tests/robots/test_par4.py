"""Par4 kinematics against values that were computed without the project's formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.robots import make_robot
from app.robots.par4 import ARM_AZIMUTHS, Par4, Par4Geometry
from app.robots.rotary_arm import outer_angle_scalar
from app.robots.workspace import grid
from tests.robots.golden import golden, poses_from_mm

PAR4 = make_robot("par4")
TOLERANCE = 1e-9


def test_inverse_reproduces_both_elbow_branches():
    rows = golden("par4_ik")["rows"]
    for row in rows:
        pose = poses_from_mm(row["pose"])
        assert np.allclose(PAR4.working_modes(pose), [row["q"], row["q_other_branch"]], atol=TOLERANCE, rtol=0)
    poses = poses_from_mm([row["pose"] for row in rows])
    assert np.allclose(PAR4.inverse(poses), [row["q"] for row in rows], atol=TOLERANCE, rtol=0)


def test_unreachable_poses_name_the_legs_that_cannot_close():
    for row in golden("par4_ik")["unreachable"]:
        pose = poses_from_mm(row["pose"])
        assert np.isnan(PAR4.inverse(pose)).tolist() == row["nan_arms"]
        reach = PAR4.reach(pose)
        assert not reach.ok and reach.joints is None
        assert reach.leg is not None and row["nan_arms"][reach.leg - 1]


def test_poses_beyond_a_joint_limit_have_joints_but_are_refused():
    for row in golden("par4_ik")["reachable_but_outside_q_limit"]:
        pose = poses_from_mm(row["pose"])
        assert np.allclose(PAR4.inverse(pose), row["q"], atol=TOLERANCE, rtol=0)
        reach = PAR4.reach(pose)
        assert not reach.ok and "upper arm at +45 degrees" in reach.reason
        excess = np.abs(row["q"])
        assert reach.leg is not None
        assert excess[reach.leg - 1] == pytest.approx(excess.max(), abs=1e-6)


def test_the_papers_circle():
    rows = golden("par4_circle")["rows"]
    poses = poses_from_mm([row["pose"] for row in rows])
    assert np.allclose(np.degrees(PAR4.inverse(poses)), [row["q_deg"] for row in rows], atol=1e-7, rtol=0)
    assert PAR4.reachable(poses).all()


def test_forward_and_every_assembly_mode():
    for row in golden("par4_fk")["rows"]:
        assert np.allclose(PAR4.forward(row["q"]), poses_from_mm(row["pose"]), atol=TOLERANCE, rtol=0)
        modes = PAR4.assemblies(row["q"])
        wanted = poses_from_mm(row["all_real_modes"])
        assert len(modes) == len(wanted)
        for pose in wanted:
            assert min(_pose_distance(pose, mode.pose) for mode in modes) < 1e-8
        assert [mode.valid for mode in modes] == [True] + [False] * (len(modes) - 1)


def _pose_distance(a: np.ndarray, b: np.ndarray) -> float:
    turn = np.angle(np.exp(1j * (a[3] - b[3])))
    return float(max(np.abs(a[:3] - b[:3]).max(), abs(turn)))


def test_joints_that_do_not_assemble_give_nan():
    assert np.isnan(PAR4.forward(golden("par4_fk")["no_assembly"])).all()


def test_jacobian_and_conditioning():
    for row in golden("par4_jacobian")["rows"]:
        pose = poses_from_mm(row["pose"])
        wanted = np.array(row["Jinv_dq_dpose"]) * np.array([1e3, 1e3, 1e3, 1.0])
        assert np.allclose(PAR4.jacobian(pose), wanted, atol=1e-9, rtol=1e-9)
        assert float(PAR4.conditioning(pose)) == pytest.approx(row["condJ"], rel=1e-9)


@pytest.mark.parametrize(
    "row", golden("par4_workspace")["rows"], ids=lambda r: f"{r['step_mm']}mm-{r['P_iz']}-{r['theta_deg']}"
)
def test_workspace_counts_of_the_papers_box(row):
    robot = make_robot("par4", P_z=row["P_iz"] / 1e3)
    low, high = np.array([-170.0, -210.0, -510.0]), np.array([170.0, 140.0, -220.0])
    poses = grid(low, high, row["step_mm"], np.radians(row["theta_deg"])) / np.array([1e3, 1e3, 1e3, 1.0])
    inside = robot.reachable(poses)
    assert len(poses) == row["n_grid"]
    assert int(inside.sum()) == row["n_ok"]
    found = poses[inside, :3] * 1e3
    assert np.allclose(np.column_stack([found.min(0), found.max(0)]), row["extent"], atol=1e-6)


def test_the_error_printed_in_equation_18():
    """With the printed sign of its d_3 term, drive 3 is off by about 3.1 degrees in the centre."""
    robot = Par4(Par4Geometry())
    g = robot.geometry
    E, F, G = robot.leg_equations(math, 0.0, -0.036, -0.3, 0.0)[2]
    printed = F - 4.0 * g.L * g.d_i * math.cos(ARM_AZIMUTHS[2])
    shift = math.degrees(outer_angle_scalar(E, printed, G) - outer_angle_scalar(E, F, G))
    assert shift == pytest.approx(3.1, abs=0.05)


@given(st.floats(-0.17, 0.17), st.floats(-0.21, 0.14), st.floats(-0.51, -0.22), st.floats(-np.pi / 4, np.pi / 4))
def test_round_trip_over_the_workspace(x, y, z, theta):
    pose = np.array([x, y, z, theta])
    if PAR4.reachable(pose):
        joints = PAR4.inverse(pose)
        assert np.allclose(PAR4.forward(joints), pose, atol=1e-9, rtol=0)
