"""Five-bar kinematics against golden values and geometry worked out here."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import KDTree

from app.robots import GeometryError
from app.robots.fivebar import WORKING_BOX, FiveBar, FiveBarGeometry
from tests.robots.golden import golden

FIVEBAR = FiveBar(FiveBarGeometry())
TOLERANCE = 1e-9
MOTORS = np.array([(-0.09, 0.0), (0.09, 0.0)])
LINK, LEAD = 0.25, 0.02
LOW, HIGH = np.radians([65.0, 10.0]), np.radians([170.0, 115.0])
POINTS = golden("fivebar_ik")["points"]
MOTION = [point for run in golden("fivebar_dynamics")["trajectories"] for point in run["points"]]


@pytest.mark.parametrize("point", POINTS)
def test_golden_linkage(point):
    pose = np.array([point["x"], point["y"], 0.01, 0.5])
    q = FIVEBAR.inverse(pose)
    assert np.allclose(q[:2], point["q"], atol=TOLERANCE, rtol=0)
    assert np.allclose(q[2:], [0.5 - 2 * np.pi * 0.01 / LEAD, 0.5], atol=TOLERANCE, rtol=0)
    assert np.allclose(FIVEBAR.forward(q), pose, atol=TOLERANCE, rtol=0)
    sines = [*np.abs(point["sin_serial"]), point["sin_parallel"]]
    assert np.allclose(FIVEBAR.singularity_sines(pose), sines, atol=TOLERANCE, rtol=0)


@pytest.mark.parametrize("point", POINTS)
def test_golden_jacobian_inverts_linkage_and_screw(point):
    D = np.zeros((4, 4))
    D[:2, :2] = point["D5R"]
    D[2:, 2:] = np.array([[-LEAD, LEAD], [0.0, 2 * np.pi]]) / (2 * np.pi)
    pose = [point["x"], point["y"], -0.02, 1.0]
    assert np.allclose(FIVEBAR.jacobian(pose), np.linalg.inv(D), rtol=TOLERANCE, atol=TOLERANCE)
    assert float(FIVEBAR.conditioning(pose)) == pytest.approx(np.linalg.cond(D[:2, :2]), rel=1e-9)


def test_golden_motions():
    pose, rate = np.array([p["p"] for p in MOTION]), np.array([p["pd"] for p in MOTION])
    joints = np.array([p["q"] for p in MOTION])
    assert np.allclose(FIVEBAR.inverse(pose), joints, atol=TOLERANCE, rtol=0)
    assert np.allclose(FIVEBAR.forward(joints), pose, atol=TOLERANCE, rtol=0)
    joint_rate = (FIVEBAR.jacobian(pose) @ rate[..., None])[..., 0]
    assert np.allclose(joint_rate, [p["qd"] for p in MOTION], atol=1e-8, rtol=TOLERANCE)
    assert FIVEBAR.reachable(pose).all()


@given(st.floats(-0.26, 0.26), st.floats(0.19, 0.49), st.floats(-0.1, 0.05), st.floats(-math.pi, math.pi))
def test_pose_to_joints_and_back(x, y, z, phi):
    pose = [x, y, z, phi]
    if FIVEBAR.reach(pose).ok:
        assert np.allclose(FIVEBAR.forward(FIVEBAR.inverse(pose)), pose, atol=TOLERANCE, rtol=0)


arm_1, arm_2 = (st.floats(low, high) for low, high in zip(LOW, HIGH, strict=True))


@given(arm_1, arm_2, st.floats(-18.0, 34.0), st.floats(-math.pi, math.pi))
def test_joints_to_pose_and_back(q1, q2, q3, q4):
    """Arms that cross or reach too far apart have no pose with both elbows out."""
    joints = [q1, q2, q3, q4]
    pose = FIVEBAR.forward(joints)
    if np.isnan(pose).any():
        assert np.isnan(pose).all()
        assert not any(mode.valid for mode in FIVEBAR.assemblies(joints))
    elif FIVEBAR.singularity_sines(pose).min() > 1e-3:
        assert np.allclose(FIVEBAR.inverse(pose), joints, atol=1e-7, rtol=0)


def rods(pose: np.ndarray, joints: np.ndarray) -> np.ndarray:
    """(2, 2) from the elbows to P."""
    return pose[:2] - MOTORS - LINK * np.column_stack([np.cos(joints[:2]), np.sin(joints[:2])])


def test_both_assemblies_close_the_loop_on_either_side_of_the_elbows():
    joints = np.array([2.2, 0.9, 1.0, -0.5])
    left, right = FIVEBAR.assemblies(joints)
    assert (left.valid, right.valid) == (True, False)
    for mode, side in ((left, 1.0), (right, -1.0)):
        w = rods(mode.pose, joints)
        assert np.allclose(np.linalg.norm(w, axis=-1), LINK, atol=1e-12)
        assert side * (w[0, 0] * w[1, 1] - w[0, 1] * w[1, 0]) > 0.0
        assert mode.pose[2:] == pytest.approx([LEAD / (2 * np.pi) * -1.5, -0.5])


def test_joints_without_a_valid_assembly():
    out_of_reach, crossed = np.radians([180.0, 0.0, 0.0, 0.0]), np.radians([70.0, 110.0, 0.0, 0.0])
    assert FIVEBAR.assemblies(out_of_reach) == []
    assert [mode.valid for mode in FIVEBAR.assemblies(crossed)] == [False, False]
    assert np.isnan(FIVEBAR.forward([out_of_reach, crossed])).all()


def test_four_working_modes_close_the_loop():
    pose = np.array([0.05, 0.3, 0.01, 0.2])
    modes = FIVEBAR.working_modes(pose)
    assert len(np.unique(modes.round(9), axis=0)) == 4
    assert np.allclose(modes[0], FIVEBAR.inverse(pose))
    for joints in modes:
        assert np.allclose(np.linalg.norm(rods(pose, joints), axis=-1), LINK, atol=1e-12)
        assert np.allclose(joints[2:], modes[0, 2:])
    own = rods(pose, modes[0])
    assert own[0, 0] > 0.0 > own[1, 0], "elbows out"
    assert FIVEBAR.working_modes([0.6, 0.0, 0.0, 0.0]).shape == (0, 4)


def test_singularities_on_the_axis_of_symmetry():
    """Both rods in line 192 mm ahead, both legs stretched at 492 mm."""
    in_line, stretched = math.sqrt(0.25**2 - 0.16**2), math.sqrt(0.5**2 - 0.09**2)
    assert FIVEBAR.singularity_sines([0.0, in_line, 0.0, 0.0])[2] == pytest.approx(0.0, abs=1e-12)
    assert FIVEBAR.singularity_sines([0.0, stretched - 1e-9, 0.0, 0.0])[:2].max() < 1e-3
    assert FIVEBAR.conditioning([0.0, in_line + 1e-9, 0.0, 0.0]) > 1e6
    assert np.isinf(FIVEBAR.conditioning([0.0, stretched + 1e-6, 0.0, 0.0]))


def test_the_working_box_is_in_reach_and_far_from_singular():
    (x_low, x_high), (y_low, y_high) = WORKING_BOX
    x, y = np.meshgrid(np.linspace(x_low, x_high, 67), np.linspace(y_low, y_high, 31), indexing="ij")
    poses = np.stack([x, y, np.zeros_like(x), np.zeros_like(x)], axis=-1)
    assert FIVEBAR.reachable(poses).all()
    assert FIVEBAR.singularity_sines(poses).min() > 0.49
    assert FIVEBAR.conditioning(poses).max() < 3.83
    q_deg = np.degrees(FIVEBAR.inverse(poses)[..., :2])
    assert np.allclose(q_deg.min(axis=(0, 1)), (73.2, 17.1), atol=0.06)
    assert np.allclose(q_deg.max(axis=(0, 1)), (162.9, 106.8), atol=0.06)


def expected_reach(poses: np.ndarray) -> np.ndarray:
    """Limits of arms, screw and turn, and the links' angles, from the law of cosines."""
    expected = (np.abs(poses[:, 3]) <= np.pi) & (poses[:, 2] >= -0.10) & (poses[:, 2] <= 0.05)
    rod_angles = []
    for k, side in enumerate((1.0, -1.0)):
        across, ahead = (poses[:, :2] - MOTORS[k]).T
        r = np.hypot(across, ahead)
        with np.errstate(invalid="ignore"):
            q = np.arctan2(ahead, across) + side * np.arccos(r / (2 * LINK))
            at_elbow = 2 * np.arcsin(r / (2 * LINK))
        expected &= (q >= LOW[k]) & (q <= HIGH[k]) & (np.sin(at_elbow) >= 0.40)
        rod_angles.append(q + side * (at_elbow - np.pi))
    return expected & (np.sin(rod_angles[1] - rod_angles[0]) >= 0.40)


def test_reach_is_what_its_limits_say():
    poses = np.random.default_rng(1).uniform((-0.4, -0.3, -0.12, -3.5), (0.4, 0.6, 0.07, 3.5), (30000, 4))
    expected = expected_reach(poses)
    assert 2000 < expected.sum() < 15000
    assert np.array_equal(FIVEBAR.reachable(poses), expected)
    assert [FIVEBAR.reach(pose).ok for pose in poses[:3000].tolist()] == expected[:3000].tolist()


@pytest.mark.parametrize(
    ("pose", "reason", "leg"),
    [
        ((0.5, 0.5, 0.0, 0.0), "Out of reach: leg 1 is 273 mm too short.", 1),
        ((0.0, 0.485, 0.0, 0.0), "Near a singularity: leg 1 is almost stretched.", 1),
        ((0.0, 0.23, 0.0, 0.0), "Near a singularity: the two rods are almost in line.", None),
        ((0.0, 0.10, 0.0, 0.0), "Beyond a singularity: on the way the two rods come into line.", None),
        ((0.18, 0.42, 0.0, 0.0), "Leg 1: motor arm at +65 degrees.", 1),
        ((0.19, 0.20, 0.0, 0.0), "Leg 2: motor arm at +10 degrees.", 2),
        ((-0.19, 0.20, 0.0, 0.0), "Leg 1: motor arm at +170 degrees.", 1),
        ((-0.18, 0.42, 0.0, 0.0), "Leg 2: motor arm at +115 degrees.", 2),
        ((0.0, 0.3, -0.11, 0.0), "The screw is at its lower end (-100 mm).", None),
        ((0.0, 0.3, -0.90, 0.0), "The screw is at its lower end (-100 mm).", None),
        ((0.0, 0.3, 0.0501, -3.0), "The screw is at its upper end (50 mm).", None),
        ((0.0, 0.3, 0.0, 3.3), "The tool turns at most 180 degrees to either side.", None),
        ((0.0, 0.3, -0.1, 3.3), "The tool turns at most 180 degrees to either side.", None),
    ],
)
def test_reasons(pose, reason, leg):
    verdict = FIVEBAR.reach(pose)
    assert (verdict.ok, verdict.reason, verdict.leg) == (False, reason, leg)


def test_a_folded_leg_and_links_of_unequal_length():
    wide = {"q2_min": math.radians(-40.0), "q1_max": math.radians(220.0)}
    robot = FiveBar(FiveBarGeometry(l_d=0.35, l_f=0.3, **wide))
    assert robot.reach([0.15, 0.02, 0.0, 0.0]).reason == "Too close: leg 2 is 80 mm too long."
    assert robot.reach([-0.17, 0.15, 0.0, 0.0]).reason == "Near a singularity: leg 1 is almost folded."


def test_any_float_gets_a_verdict():
    for value in (1e200, -1e308, 5e-324):
        assert not FIVEBAR.reach([value] * 4).ok


def test_joint_ranges_of_the_screw_follow_from_height_and_turn():
    corners = np.array([[0.0, 0.336, z, phi] for z in (-0.10, 0.05) for phi in (-np.pi, np.pi)])
    q = FIVEBAR.inverse(corners)
    assert FIVEBAR.reachable(corners).all()
    assert np.allclose(FIVEBAR.joint_limits[2:], np.stack([q.min(0), q.max(0)], axis=-1)[2:], atol=1e-5)


def test_skeleton_lies_in_the_plane_of_the_links():
    pose = [0.1, 0.35, -0.05, 1.0]
    skeleton = FIVEBAR.skeleton(pose, FIVEBAR.solve(*pose))
    for part in (skeleton.base, skeleton.elbow, skeleton.platform):
        assert part.shape == (2, 3)
        assert (part[:, 2] == 0.0).all()
    assert np.allclose(np.linalg.norm(skeleton.elbow - skeleton.base, axis=-1), LINK)
    assert np.allclose(np.linalg.norm(skeleton.platform - skeleton.elbow, axis=-1), LINK)
    assert np.array_equal(skeleton.hinge, [[0, 0, 1], [0, 0, 1]])


def test_nearest_of_a_thousand_targets_is_the_nearest():
    """Behind the machine two corners, tip and side of the region, are each nearest in their surroundings: a
    descent may end in the lesser of them for 1 target in 25."""
    targets = np.random.default_rng(2).uniform((-0.6, -0.5, -0.25, -4.0), (0.6, 0.8, 0.2, 4.0), (1100, 4))
    targets = targets[~FIVEBAR.reachable(targets)]
    assert len(targets) > 1000
    answers = FIVEBAR.nearest(targets)
    assert FIVEBAR.reachable(answers).all()
    assert np.allclose(answers[:, 3], np.clip(targets[:, 3], -np.pi, np.pi))
    grid = np.array(list(itertools.product(np.arange(-0.27, 0.27, 0.003), np.arange(0.18, 0.49, 0.003))))
    grid = grid[expected_reach(np.column_stack([grid, np.zeros((len(grid), 2))]))]
    lift = np.clip(targets[:, 2], -0.10, 0.05) - targets[:, 2]
    beside, _ = KDTree(grid).query(targets[:, :2])
    excess = np.linalg.norm((answers - targets)[:, :3], axis=-1) - np.hypot(beside, lift)
    assert (excess > 1e-3).mean() <= 0.04
    assert excess.max() < 0.02


def closed_curves() -> dict[str, np.ndarray]:
    """Outside of the region, but not across the axis behind it, where the answer has to change sides."""
    t = np.linspace(0.0, 2.0 * np.pi, 601)
    c, s, zero = np.cos(t), np.sin(t), np.zeros_like(t)
    return {
        "around": np.column_stack([0.3 * c, 0.336 + 0.2 * s, zero, zero]),
        "ahead": np.column_stack([0.35 * c, 0.5 + 0.25 * s, 0.1 * s, 2 * c]),
        "up and down": np.column_stack([0.1 * c, 0.336 + zero, -0.02 + 0.15 * s, 4 * c]),
        "under the arch": np.column_stack([0.1 * c, 0.2 + 0.04 * s, -0.02 + 0.15 * s, 4 * c]),
    }


@pytest.mark.parametrize("seeded", [True, False], ids=["seeded", "alone"])
@pytest.mark.parametrize("curve", closed_curves().values(), ids=closed_curves())
def test_nearest_follows_a_moving_target(curve, seeded):
    assert not FIVEBAR.reachable(curve).all()
    answer, answers = None, []
    for target in curve:
        answer = FIVEBAR.nearest(target, seed=answer if seeded else None)
        answers.append(answer)
    assert FIVEBAR.reachable(np.array(answers)).all()
    moved = np.linalg.norm(np.diff(np.array(answers)[:, :3], axis=0), axis=-1)
    asked = np.linalg.norm(np.diff(curve[:, :3], axis=0), axis=-1)
    assert (moved <= 3.0 * asked + 1e-5).all()
    assert moved.sum() > 0.1


def test_a_target_that_crosses_behind_the_machine_changes_sides_once():
    x = np.linspace(-0.15, 0.15, 301)
    answer, sides = None, []
    for target in np.column_stack([x, np.full_like(x, 0.02), np.zeros((301, 2))]):
        answer = FIVEBAR.nearest(target, seed=answer)
        sides.append(answer[0] > 0.0)
    assert np.count_nonzero(np.diff(sides)) == 1


@given(st.floats(-0.6, 0.6), st.floats(-0.3, 0.8), st.floats(-0.3, 0.2))
def test_boundaries_are_positive_exactly_within_reach(x, y, z):
    values = [limit.value for limit in FIVEBAR._boundaries([x, y, z, 0.0])]
    if abs(min(values)) > 1e-6:
        assert (min(values) > 0.0) == FIVEBAR.reach([x, y, z, 0.0]).ok


@given(st.floats(-0.3, 0.3), st.floats(0.15, 0.5))
def test_gradients_of_the_boundaries(x, y):
    """Exact on a limit; away from it the value grows with its distance to first order."""
    step = 1e-6
    here = FIVEBAR._boundaries([x, y, 0.0, 0.0])
    ahead = [FIVEBAR._boundaries([x + step * a, y + step * b, 0.0, 0.0]) for a, b in ((1, 0), (0, 1))]
    for limit, *moved in zip(here, *ahead, strict=True):
        if abs(limit.value) < 2e-3:
            slope = [(other.value - limit.value) / step for other in moved]
            assert np.allclose(slope, limit.gradient[:2], atol=0.05)


def test_curvature_of_the_boundaries_that_hold_an_answer():
    """Along the tangent the value falls by half the curvature times the square of the step. For the rods in line
    the curvature is an estimate."""
    step, seen = 1e-3, set()
    for x, y in np.random.default_rng(4).uniform((-0.5, 0.0), (0.5, 0.8), (150, 2)):
        here = FIVEBAR.nearest([x, y, 0.0, 0.0])
        for k, limit in enumerate(FIVEBAR._boundaries(here.tolist())):
            if limit.value < 1e-6:
                seen.add(k)
                along = step * np.array([limit.gradient[1], -limit.gradient[0], 0.0, 0.0])
                sides = [FIVEBAR._boundaries((here + way * along).tolist())[k] for way in (1, -1)]
                bend = (2 * limit.value - sides[0].value - sides[1].value) / step**2
                assert bend == pytest.approx(limit.curvature, rel=0.45)
    assert len(seen) >= 6


@pytest.mark.parametrize("lengths", [{"l_d": 0.30}, {"l_p": 0.20}, {"l_f": 0.30}, {"l_p": 0.15, "l_d": 0.15}])
def test_changed_links_find_a_home_ahead(lengths):
    robot = FiveBar(FiveBarGeometry(**lengths))
    assert robot.reach(robot.home).ok
    assert robot.home[0] == robot.home[2] == robot.home[3] == 0.0
    far = robot.nearest([0.3, 0.9, 0.0, 0.0])
    assert robot.reach(far).ok


@pytest.mark.parametrize(
    ("dimensions", "sentence"),
    [
        ({"l_f": 0.6, "l_p": 0.12, "l_d": 0.12}, "cannot reach any pose"),
        ({"l_p": 0.1, "l_d": 0.6}, "differ too much"),
        ({"l_d": 5.0}, "between 0.1 and 0.6 m"),
        ({"p": 0.0}, "Screw lead"),
    ],
)
def test_dimensions_that_cannot_work_are_refused(dimensions, sentence):
    with pytest.raises(GeometryError, match=sentence):
        FiveBar(FiveBarGeometry(**dimensions))
