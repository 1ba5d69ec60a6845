"""Linear delta kinematics against the thesis' tables, golden values and geometry worked out here."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.robots import GeometryError, make_robot
from app.robots.linear import LinearGeometry
from tests.robots.golden import golden

LINEAR = make_robot("linear")
TOLERANCE = 1e-9
ZETA = np.array([(-0.1575, -0.091), (0.1575, -0.091), (0.0, 0.182)])
ROD, STROKE, FLOOR, M_MAX = 0.365, 0.510, -0.800, 0.305
THESIS_ROWS = golden("linear_delta_fk")["thesis_rows"]
POINTS = golden("linear_delta_fk")["extra_points_fk_ik_jac_hessian"]
MOTION = [point for run in golden("linear_delta_dynamics")["trajectories"] for point in run["points"]]

inside_xy = st.floats(-0.18, 0.18)
inside_z = st.floats(-0.80, -0.30)


def test_inverse_reproduces_table_4_of_the_thesis():
    """Its first row lies just above the upper stops: limits are no matter of `inverse`."""
    for row in golden("linear_delta_ik")["rows"]:
        d_cm = LINEAR.inverse(np.array(row["P_cm"]) / 100.0) * 100.0
        assert np.allclose(d_cm, row["ik_cm"], atol=TOLERANCE * 100, rtol=0)
        assert np.allclose(d_cm, row["thesis_table4_d_cm"], atol=0.015, rtol=0)


def test_forward_of_the_joints_of_table_3():
    for row in THESIS_ROWS:
        pose_cm = LINEAR.forward(np.array(row["d_cm"]) / 100.0) * 100.0
        assert np.allclose(pose_cm, row["fk_correct_cm"], atol=TOLERANCE * 100, rtol=0)


def forward_as_in_the_thesis(d: np.ndarray) -> np.ndarray:
    """Lower common point of the rod spheres, with the thesis' sign error.

    Differences of sphere equations give x = s_x z + t_x and y = s_y z + t_y; put into sphere 1 about q they
    give a z^2 + b z + c = 0. In its linear coefficient the thesis has -t_y in the place of t_y.
    """
    centres = np.column_stack([ZETA, -d])
    q = centres[0]
    planes = 2.0 * (centres[1:] - q)
    right = (centres[1:] ** 2).sum(-1) - q @ q
    s_x, s_y = np.linalg.solve(planes[:, :2], -planes[:, 2])
    t_x, t_y = np.linalg.solve(planes[:, :2], right)
    a = s_x**2 + s_y**2 + 1.0
    b = 2.0 * (s_x * (t_x - q[0]) + s_y * (-t_y - q[1]) - q[2])
    c = (t_x - q[0]) ** 2 + (t_y - q[1]) ** 2 + q[2] ** 2 - ROD**2
    z = (-b - math.sqrt(b * b - 4.0 * a * c)) / (2.0 * a)
    return np.array([s_x * z + t_x, s_y * z + t_y, z])


@pytest.mark.parametrize("number", range(1, 7))
def test_table_3_of_the_thesis_is_wrong_by_one_sign(number):
    """Only its first row, with all joints at 0, is right. With the sign error all six come out as printed (x
    of rows 2 and 5 with one and three digits), so the table is no truth to test `forward` against."""
    row = THESIS_ROWS[number - 1]
    d, printed = np.array(row["d_cm"]) / 100.0, np.array(row["thesis_table3_fk_cm"])
    reproduced = forward_as_in_the_thesis(d) * 100.0
    tolerance = np.array([0.05 if number in (2, 5) else 0.01, 0.01, 0.01])
    assert (np.abs(reproduced - printed) <= tolerance).all()
    assert np.allclose(reproduced, row["fk_thesis_bug_reproduced_cm"], atol=1e-7)
    off = np.linalg.norm(LINEAR.forward(d) * 100.0 - printed)
    assert off < 0.003 if number == 1 else off > 0.08


@pytest.mark.parametrize("point", POINTS)
def test_golden_positions_and_velocities(point):
    pose, d = np.array(point["P_m"]), np.array(point["d_m"])
    assert np.allclose(LINEAR.inverse(pose), d, atol=TOLERANCE, rtol=0)
    assert np.allclose(LINEAR.forward(d), pose, atol=TOLERANCE, rtol=0)
    J = LINEAR.jacobian(pose)
    assert np.allclose(J, point["J"], atol=TOLERANCE, rtol=0)
    assert np.allclose(J @ point["Pdot"], point["ddot"], atol=TOLERANCE, rtol=0)
    assert float(LINEAR.conditioning(pose)) == pytest.approx(np.linalg.cond(np.array(point["J"])), rel=1e-9)


@pytest.mark.parametrize("point", POINTS)
def test_jacobian_changes_by_the_golden_hessian(point):
    """H_i, the second derivative of d_i, and with it the golden joint accelerations."""
    pose, step = np.array(point["P_m"]), 1e-5 * np.eye(3)
    H = (LINEAR.jacobian(pose + step) - LINEAR.jacobian(pose - step)).transpose(1, 2, 0) / 2e-5
    assert np.allclose(H, point["H"], atol=1e-6 * np.abs(point["H"]).max())
    rate = np.array(point["Pdot"])
    joint_acceleration = LINEAR.jacobian(pose) @ point["Pddot"] + rate @ H @ rate
    assert np.allclose(joint_acceleration, point["dddot"], atol=1e-5)


def test_golden_motions():
    pose, rate = np.array([p["P"] for p in MOTION]), np.array([p["V"] for p in MOTION])
    assert np.allclose(LINEAR.inverse(pose), [p["d"] for p in MOTION], atol=TOLERANCE, rtol=0)
    joint_rate = (LINEAR.jacobian(pose) @ rate[..., None])[..., 0]
    assert np.allclose(joint_rate, [p["ddot"] for p in MOTION], atol=TOLERANCE, rtol=0)
    assert LINEAR.reachable(pose).all()


@given(inside_xy, inside_xy, inside_z)
def test_pose_to_joints_and_back(x, y, z):
    pose = [x, y, z]
    if LINEAR.reach(pose).ok:
        assert np.allclose(LINEAR.forward(LINEAR.inverse(pose)), pose, atol=TOLERANCE, rtol=0)


@given(st.lists(st.floats(0.0, STROKE), min_size=3, max_size=3))
def test_joints_to_pose_and_back(d):
    """Carriages far apart leave the platform above one of them, or the rods cannot meet."""
    pose = LINEAR.forward(d)
    if np.isnan(pose).any():
        assert np.isnan(pose).all()
        assert not any(mode.valid for mode in LINEAR.assemblies(d))
    else:
        assert np.allclose(LINEAR.inverse(pose), d, atol=1e-7, rtol=0)


def test_joints_without_a_valid_assembly():
    assert np.isnan(LINEAR.forward([0.51, 0.0, 0.0])).all()
    assert [mode.valid for mode in LINEAR.assemblies([0.51, 0.0, 0.0])] == [False, False]
    assert np.isnan(make_robot("linear", L_max=1.2).forward([1.1, 0.0, 0.0])).all()
    assert LINEAR.assemblies([1.1, 0.0, 0.0]) == []


def test_both_assemblies_satisfy_the_rods():
    d = np.array([0.1, 0.2, 0.15])
    lower, upper = LINEAR.assemblies(d)
    assert (lower.valid, upper.valid) == (True, False)
    assert lower.pose[2] < upper.pose[2]
    for mode in (lower, upper):
        rods = mode.pose - np.column_stack([ZETA, -d])
        assert np.allclose(np.linalg.norm(rods, axis=-1), ROD, atol=1e-12)


def test_all_eight_working_modes_satisfy_the_rods():
    pose = np.array([0.03, -0.02, -0.45])
    modes = LINEAR.working_modes(pose)
    assert len(np.unique(modes.round(9), axis=0)) == 8
    for d in modes:
        rods = pose - np.column_stack([ZETA, -d])
        assert np.allclose(np.linalg.norm(rods, axis=-1), ROD, atol=1e-12)
    assert LINEAR.working_modes([0.5, 0.0, -0.4]).shape == (0, 3)


def test_reach_is_what_its_four_limits_say():
    """Rods long and steep enough, carriages between their stops, platform above the floor."""
    poses = np.random.default_rng(1).uniform((-0.25, -0.25, -0.9), (0.25, 0.25, -0.2), (20000, 3))
    m = np.linalg.norm(poses[:, None, :2] - ZETA, axis=-1)
    with np.errstate(invalid="ignore"):
        d = -poses[:, 2:] - np.sqrt(ROD**2 - m**2)
        expected = ((d >= 0) & (d <= STROKE) & (m <= M_MAX)).all(axis=-1) & (poses[:, 2] >= FLOOR)
    assert 1000 < expected.sum() < 10000
    assert np.array_equal(LINEAR.reachable(poses), expected)


def test_the_safe_region_is_in_reach_and_well_conditioned():
    """A disc of 120 mm from z = -360 to -710 mm."""
    angle, radius, height = np.meshgrid(
        np.linspace(0, 2 * np.pi, 73), np.linspace(0, 0.12, 13), np.linspace(-0.71, -0.36, 36), indexing="ij"
    )
    poses = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=-1)
    assert LINEAR.reachable(poses).all()
    assert LINEAR.conditioning(poses).max() < 3.055
    assert np.linalg.norm(LINEAR.jacobian(poses)[..., :2], axis=-1).max() <= 1.48


@pytest.mark.parametrize(
    ("pose", "reason", "leg"),
    [
        ((0.3, 0.0, -0.4), "Out of reach: leg 1 is 101 mm too short.", 1),
        ((0.0, 0.0, -0.2), "Leg 1: carriage at its upper stop (0 mm).", 1),
        ((0.08, -0.05, -0.79), "Leg 3: carriage at its lower stop (510 mm).", 3),
        ((0.0, -0.13, -0.5), "Leg 3: rods too flat, 33 degrees is the least.", 3),
        ((0.0, 0.0, -0.81), "The platform would touch the floor.", None),
        ((0.0, 0.0, -1.2), "The platform would touch the floor.", None),
    ],
)
def test_reasons(pose, reason, leg):
    verdict = LINEAR.reach(pose)
    assert (verdict.ok, verdict.reason, verdict.leg) == (False, reason, leg)


def test_any_float_gets_a_verdict():
    for value in (1e200, -1e308, 5e-324):
        assert not LINEAR.reach([value] * 3).ok


def test_skeleton_joins_carriages_and_platform():
    pose = [0.05, -0.03, -0.5]
    skeleton = LINEAR.skeleton(pose, LINEAR.solve(*pose))
    assert np.allclose(np.linalg.norm(skeleton.platform - skeleton.elbow, axis=-1), ROD, atol=1e-12)
    assert np.allclose((skeleton.base - skeleton.elbow)[:, :2], 0.0)
    assert np.allclose((skeleton.base - skeleton.elbow)[:, 2], LINEAR.inverse(pose))
    assert np.allclose((skeleton.base * skeleton.hinge).sum(-1), 0.0, atol=1e-5)


def columns(step: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The workspace as vertical bars: (k, 2) positions, lowest and highest z, from its definition."""
    xy = np.array(list(itertools.product(np.arange(-0.2, 0.2, step), repeat=2)))
    m = np.linalg.norm(xy[:, None] - ZETA, axis=-1)
    xy, m = xy[(m <= M_MAX).all(-1)], m[(m <= M_MAX).all(-1)]
    h = np.sqrt(ROD**2 - m**2)
    low, high = np.maximum(FLOOR, (-STROKE - h).max(-1)), (-h).min(-1)
    return xy[low <= high], low[low <= high], high[low <= high]


def test_nearest_of_a_thousand_targets_is_the_nearest():
    """The workspace is hollow above, where a descent may end in the lesser of two corners: 1 in 200 may."""
    targets = np.random.default_rng(2).uniform((-0.6, -0.6, -1.3), (0.6, 0.6, 0.3), (1100, 3))
    targets = targets[~LINEAR.reachable(targets)]
    assert len(targets) > 1000
    answers = LINEAR.nearest(targets)
    assert LINEAR.reachable(answers).all()
    xy, low, high = columns(step=0.005)
    best = np.empty(len(targets))
    for row, (x, y, z) in enumerate(targets):
        squares = (xy[:, 0] - x) ** 2 + (xy[:, 1] - y) ** 2 + (np.clip(z, low, high) - z) ** 2
        best[row] = np.sqrt(squares.min())
    excess = np.linalg.norm(answers - targets, axis=-1) - best
    assert (excess > 1e-3).mean() <= 0.005
    assert excess.max() < 0.02


def closed_curves() -> dict[str, np.ndarray]:
    t = np.linspace(0.0, 2.0 * np.pi, 601)
    c, s, one = np.cos(t), np.sin(t), np.ones_like(t)
    return {
        "around": np.column_stack([0.3 * c, 0.3 * s, -0.5 * one]),
        "below": np.column_stack([0.2 * c, 0.2 * s, -0.9 * one]),
        "above": np.column_stack([0.1 * c, 0.1 * s, -0.2 * one]),
        "wave": np.column_stack([0.35 * c, 0.35 * s, -0.55 + 0.2 * np.sin(3 * t)]),
        "upright": np.column_stack([0.25 * c, 0.0 * s, -0.55 + 0.4 * s]),
    }


@pytest.mark.parametrize("seeded", [True, False], ids=["seeded", "alone"])
@pytest.mark.parametrize("curve", closed_curves().values(), ids=closed_curves())
def test_nearest_follows_a_moving_target(curve, seeded):
    assert not LINEAR.reachable(curve).any()
    answer, answers = None, []
    for target in curve:
        answer = LINEAR.nearest(target, seed=answer if seeded else None)
        answers.append(answer)
    moved = np.linalg.norm(np.diff(np.array(answers), axis=0), axis=-1)
    asked = np.linalg.norm(np.diff(curve, axis=0), axis=-1)
    assert (moved <= 2.5 * asked + 1e-5).all()
    assert moved.sum() > 0.1


@given(x=st.floats(-0.6, 0.6), y=st.floats(-0.6, 0.6), z=st.floats(-1.3, 0.3))
def test_boundaries_are_positive_exactly_within_reach(x, y, z):
    values = [limit.value for limit in LINEAR._boundaries([x, y, z])]
    if abs(min(values)) > 1e-6:
        assert (min(values) > 0.0) == LINEAR.reach([x, y, z]).ok


def test_curvature_of_the_boundaries_that_hold_an_answer():
    """Along the tangent the value falls by half the curvature times the square of the step."""
    step, seen = 1e-3, set()
    for target in np.random.default_rng(4).uniform((-0.5, -0.5, -1.1), (0.5, 0.5, 0.1), (150, 3)):
        here = LINEAR.nearest(target)
        for k, limit in enumerate(LINEAR._boundaries(here.tolist())):
            if limit.value < 1e-6:
                seen.add(k)
                along = np.cross(limit.gradient, (0.0, 0.0, 1.0))
                along /= max(np.linalg.norm(along), 1e-12)
                sides = [LINEAR._boundaries((here + way * step * along).tolist())[k] for way in (1, -1)]
                bend = (2 * limit.value - sides[0].value - sides[1].value) / step**2
                assert bend == pytest.approx(limit.curvature, abs=0.1)
    assert len(seen) == 10


def test_stops_rod_and_elevation_follow_the_geometry():
    assert LinearGeometry().m_max == pytest.approx(M_MAX, abs=1e-15)
    assert LinearGeometry(l=0.40).m_max == pytest.approx(0.40 * M_MAX / ROD)
    assert np.allclose(make_robot("linear", L_max=0.480).joint_limits, (0.0, 0.41))


@pytest.mark.parametrize(
    ("dimensions", "sentence"),
    [
        ({"l": 0.2}, "cannot reach any pose"),
        ({"u_b": 0.14, "w_p": 0.15, "U_A": 0.2, "W_A": 0.06}, "platform must be smaller"),
        ({"L_min": 0.3, "L_max": 0.3}, "lower stop"),
        ({"l": 5.0}, "between 0.15 and 0.8 m"),
    ],
)
def test_dimensions_that_cannot_work_are_refused(dimensions, sentence):
    with pytest.raises(GeometryError, match=sentence):
        make_robot("linear", **dimensions)
