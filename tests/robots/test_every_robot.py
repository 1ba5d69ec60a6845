"""What the contract of `Robot` promises, for each robot and for changed geometries."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.robots import ROBOTS, GeometryError, Robot, make_robot
from app.robots.workspace import boundary, bounding_box, cloud

EVERY = {name: make_robot(name) for name in ROBOTS}
every_robot = pytest.mark.parametrize("robot", EVERY.values(), ids=EVERY)


def sample(robot: Robot, count: int, seed: int, margin: float = 0.0) -> np.ndarray:
    """Random poses around the workspace, both inside and outside."""
    rng = np.random.default_rng(seed)
    low, high = bounding_box(robot)
    span = (high - low) * (0.5 + margin)
    positions = 0.5 * (low + high) + rng.uniform(-1, 1, (count, 3)) * span
    turns = rng.uniform(-1, 1, (count, robot.dof - 3)) * robot.rotation_limit * (1.0 + margin)
    return np.hstack([positions, turns])


def reachable_sample(robot: Robot, count: int, seed: int) -> np.ndarray:
    poses = sample(robot, 40 * count, seed)
    return poses[robot.reachable(poses)][:count]


@every_robot
def test_shapes_follow_leading_axes(robot):
    poses = np.tile(robot.home, (2, 3, 1))
    n = len(robot.joint_names)
    joints = robot.inverse(poses)
    assert joints.shape == (2, 3, n)
    assert robot.forward(joints).shape == poses.shape
    assert robot.jacobian(poses).shape == (2, 3, n, robot.dof)
    assert robot.conditioning(poses).shape == (2, 3)
    assert robot.reachable(poses).all()
    assert robot.inverse(robot.home).shape == (n,)
    assert robot.inverse(np.empty((0, robot.dof))).shape == (0, n)
    with pytest.raises(ValueError, match="expects arrays of shape"):
        robot.inverse(np.zeros(7))


@every_robot
def test_home_is_comfortable(robot):
    assert robot.reach(robot.home).ok
    assert robot.joint_limits.shape == (len(robot.joint_names), 2)
    assert (robot.joint_limits[:, 0] < robot.joint_limits[:, 1]).all()
    assert float(robot.conditioning(robot.home)) < 4.0


@every_robot
def test_forward_undoes_inverse(robot):
    poses = reachable_sample(robot, 2000, seed=1)
    assert len(poses) > 500
    assert np.allclose(robot.forward(robot.inverse(poses)), poses, atol=1e-9, rtol=0)


@every_robot
def test_plain_floats_equal_arrays(robot):
    poses = sample(robot, 2000, seed=2, margin=0.5)
    arrays = robot.inverse(poses)
    floats = np.array([robot.solve(*pose) for pose in poses.tolist()])
    assert np.array_equal(np.isnan(arrays), np.isnan(floats))
    assert np.nanmax(np.abs(arrays - floats)) < 1e-12


@every_robot
def test_verdict_of_one_pose_equals_the_vectorised_one(robot):
    poses = sample(robot, 3000, seed=3, margin=0.3)
    assert [robot.reach(pose).ok for pose in poses.tolist()] == robot.reachable(poses).tolist()


@every_robot
def test_every_refusal_gives_a_reason(robot):
    poses = sample(robot, 3000, seed=4, margin=1.0)
    for pose in poses[~robot.reachable(poses)].tolist():
        reach = robot.reach(pose)
        assert reach.reason.endswith(".") and len(reach.reason) < 90
        assert reach.leg is None or 1 <= reach.leg <= robot.legs
    assert "not a number" in robot.reach([math.nan] * robot.dof).reason


@every_robot
def test_jacobian_equals_central_differences(robot):
    poses = reachable_sample(robot, 200, seed=5)
    step = 1e-6
    numeric = np.stack(
        [
            (robot.inverse(poses + step * axis) - robot.inverse(poses - step * axis)) / (2 * step)
            for axis in np.eye(robot.dof)
        ],
        axis=-1,
    )
    jacobian = robot.jacobian(poses)
    assert np.allclose(jacobian, numeric, rtol=1e-5, atol=1e-5 * np.abs(jacobian).max())


@every_robot
def test_conditioning_is_infinite_where_the_loop_is_open(robot):
    far = robot.home.copy()
    far[0] += 5.0
    assert np.isinf(robot.conditioning(far))


@every_robot
def test_the_skeleton_closes_every_loop(robot):
    for pose in reachable_sample(robot, 50, seed=6).tolist():
        skeleton = robot.skeleton(pose, robot.solve(*pose))
        rods = np.linalg.norm(skeleton.platform - skeleton.elbow, axis=-1)
        assert np.ptp(rods) < 1e-12
        assert np.allclose(np.linalg.norm(skeleton.hinge, axis=-1), 1.0)


@every_robot
def test_working_modes_and_assemblies_hold_the_same_loops(robot):
    pose = reachable_sample(robot, 1, seed=7)[0]
    modes = robot.working_modes(pose)
    assert len(modes) >= 2 and np.allclose(modes[0], robot.inverse(pose))
    for mode in modes:
        skeleton = robot.skeleton(pose.tolist(), mode.tolist())
        lengths = np.linalg.norm(skeleton.platform - skeleton.elbow, axis=-1)
        own = robot.skeleton(pose.tolist(), modes[0].tolist())
        assert np.allclose(lengths, np.linalg.norm(own.platform - own.elbow, axis=-1), atol=1e-9)
    assemblies = robot.assemblies(modes[0])
    assert len(assemblies) >= 2 and sum(mode.valid for mode in assemblies) == 1
    assert np.allclose(assemblies[0].pose, pose, atol=1e-9)


@every_robot
def test_nearest_leaves_reachable_poses_alone(robot):
    poses = reachable_sample(robot, 100, seed=8)
    assert np.array_equal(robot.nearest(poses), poses)


@every_robot
def test_nearest_survives_anything(robot):
    wild = np.array([[math.nan] * robot.dof, [math.inf] * robot.dof, [1e9] * robot.dof, [-1e9] * robot.dof])
    assert robot.reachable(robot.nearest(wild)).all()
    assert robot.reachable(robot.nearest(np.zeros(robot.dof)))


@every_robot
def test_nearest_of_a_thousand_unreachable_targets(robot):
    targets = sample(robot, 2500, seed=9, margin=1.0)
    targets = targets[~robot.reachable(targets)][:1000]
    assert len(targets) == 1000
    answers = robot.nearest(targets)
    assert robot.reachable(answers).all()
    known = reachable_sample(robot, 4000, seed=10)
    turns = np.clip(targets[:, 3:], -robot.rotation_limit, robot.rotation_limit)
    assert np.allclose(answers[:, 3:], turns)
    farther = 0
    for target, answer in zip(targets[:200], answers[:200], strict=True):
        rivals = known.copy()
        rivals[:, 3:] = answer[3:]
        rivals = rivals[robot.reachable(rivals)]
        best = np.linalg.norm(rivals[:, :3] - target[:3], axis=1).min()
        farther += np.linalg.norm(answer[:3] - target[:3]) > best + 1e-3
    assert farther <= 4, "at most 2 % of far targets may end in a local minimum"


@every_robot
@pytest.mark.parametrize("radius", [1.15, 1.5])
def test_nearest_is_continuous_along_a_moving_target(robot, radius):
    """Around the workspace at the home height, the answer never jumps."""
    low, high = bounding_box(robot)
    turn = np.linspace(0.0, 2 * math.pi, 720)
    targets = np.tile(robot.home, (len(turn), 1))
    targets[:, 0] = 0.5 * (low[0] + high[0]) + radius * 0.5 * (high[0] - low[0]) * np.cos(turn)
    targets[:, 1] = 0.5 * (low[1] + high[1]) + radius * 0.5 * (high[1] - low[1]) * np.sin(turn)
    seed, answers = robot.home, []
    for target in targets:
        seed = robot.nearest(target, seed=seed)
        answers.append(seed)
    assert robot.reachable(np.array(answers)).all()
    moved = np.linalg.norm(np.diff(np.array(answers), axis=0), axis=1)
    asked = np.linalg.norm(np.diff(targets, axis=0), axis=1)
    assert (moved <= 6.0 * asked + 1e-4).all()


@every_robot
def test_workspace_surface_and_cloud_agree(robot):
    surface = boundary(robot)
    a, b, c = surface.vertices[surface.faces].transpose(1, 0, 2)
    volume = float((np.cross(a, b) * c).sum()) / 6.0
    points = cloud(robot, step=0.012)
    assert points.volume == pytest.approx(volume, rel=0.12)
    assert np.isfinite(points.conditioning).all() and (points.conditioning >= 1.0).all()


@every_robot
def test_any_dimension_can_be_changed_by_keyword(robot):
    for name, dimension in robot.geometry.dimensions().items():
        value = getattr(robot.geometry, name)
        changed = make_robot(robot.name, **{name: value + 0.02 * (dimension.high - value)})
        assert getattr(changed.geometry, name) != value or value == dimension.high
        assert changed.reach(changed.home).ok


@every_robot
def test_impossible_dimensions_are_refused_in_one_sentence(robot):
    name, dimension = next(iter(robot.geometry.dimensions().items()))
    wrong = {name: 1e3}, {name: -1.0}, {name: math.nan}, {name: "wide"}, {name: True}, {"wheels": 4.0}
    for values in wrong:
        with pytest.raises(GeometryError) as refusal:
            make_robot(robot.name, **values)  # type: ignore[arg-type]
        assert str(refusal.value).endswith((".", "?")) and "\n" not in str(refusal.value)
    assert dimension.label


def test_dimensions_with_which_nothing_is_in_reach_are_refused():
    """The paper's Table 1 with its labels as printed: no pose exists."""
    with pytest.raises(GeometryError, match="cannot reach any pose"):
        make_robot("par4", L=0.386, l=0.200)


def test_unknown_names_are_refused_with_the_known_ones():
    with pytest.raises(GeometryError, match="par4, delta3"):
        make_robot("hexapod")
    with pytest.raises(GeometryError, match="desk_A4"):
        make_robot("delta3", preset="desk_A3")


@given(st.sampled_from(sorted(EVERY)), st.lists(st.floats(-1.5, 1.5), min_size=4, max_size=4))
def test_nearest_is_always_reachable(name, values):
    robot = EVERY[name]
    assert robot.reach(robot.nearest(values[: robot.dof])).ok
