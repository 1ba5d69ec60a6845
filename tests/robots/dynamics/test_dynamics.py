"""What `Dynamics` promises, for every robot."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.robots.dynamics import dynamics_of
from app.robots.robot import Array
from tests.robots.dynamics.states import EVERY, every_dynamics, motion, random_efforts, states

STEP = 1e-4


def difference(values: Array) -> Array:
    """Derivative in the middle of five samples STEP apart, along the first axis."""
    return (8 * (values[3] - values[1]) - (values[4] - values[0])) / (12 * STEP)


INSTANTS = STEP * np.array([-2.0, -1.0, 0.0, 1.0, 2.0])


@every_dynamics
def test_shapes_follow_leading_axes(dynamics):
    robot, n = dynamics.robot, len(dynamics.robot.joint_names)
    pose, rate = np.tile(robot.home, (2, 3, 1)), np.zeros(robot.dof)
    for space in ("pose", "joint"):
        assert dynamics.mass_matrix(pose, space).shape == (2, 3, n, n)
        assert dynamics.coriolis(pose, rate, space).shape == (2, 3, n, n)
        assert dynamics.bias(pose, rate, space).shape == (2, 3, n)
        assert dynamics.gravity(pose, space).shape == (2, 3, n)
    assert dynamics.inverse(pose, rate, rate).shape == (2, 3, n)
    assert dynamics.forward(robot.home, rate, np.zeros((5, n))).shape == (5, robot.dof)
    assert dynamics.kinetic_energy(pose, rate).shape == dynamics.potential_energy(pose).shape == (2, 3)
    assert dynamics.inverse(np.empty((0, robot.dof)), rate, rate).shape == (0, n)
    with pytest.raises(ValueError, match="expect arrays of shape"):
        dynamics.inverse(np.zeros(7), np.zeros(7), np.zeros(7))


@every_dynamics
def test_plain_floats_equal_arrays(dynamics):
    poses, rates, accelerations = states(dynamics.robot, 50, seed=1)
    efforts = random_efforts(dynamics.robot, 50, seed=1)
    wanted = {
        "joints": dynamics.robot.inverse(poses),
        "rates": dynamics.joint_rates(poses, rates),
        "forward": dynamics.forward(poses, rates, efforts),
        "inverse": dynamics.inverse(poses, rates, accelerations),
        "joint_acceleration": dynamics.joint_accelerations(poses, rates, accelerations),
        "gravity": dynamics.gravity(poses, "joint"),
    }
    found = {name: [] for name in wanted}
    for pose, rate, a, f in zip(*(v.tolist() for v in (poses, rates, accelerations, efforts)), strict=True):
        terms = dynamics.at(pose, rate)
        assert terms.pose == tuple(pose) and terms.rate == tuple(rate)
        found["joints"].append(terms.joints)
        found["rates"].append(terms.joint_rates)
        found["forward"].append(terms.acceleration(f))
        found["inverse"].append(terms.effort(a))
        found["joint_acceleration"].append(terms.joint_acceleration(a))
        found["gravity"].append(terms.gravity())
    for name, values in wanted.items():
        assert np.allclose(found[name], values, rtol=1e-12, atol=1e-12 * np.abs(values).max()), name


@every_dynamics
def test_the_parts_of_the_terms_fit_together(dynamics):
    robot = dynamics.robot
    for pose, rate, a in zip(*(v.tolist() for v in states(robot, 10, seed=2)), strict=True):
        terms = dynamics.at(pose, rate)
        assert np.allclose(terms.effort(a), np.add(terms.inertial(a), terms.bias()), atol=1e-12)
        assert np.allclose(terms.pose_acceleration(terms.joint_acceleration(a)), a, atol=1e-9)
        J = robot.jacobian(pose)
        assert np.allclose(terms.to_joints(a), J @ a, rtol=1e-9, atol=1e-9)
        assert np.allclose(J.T @ terms.to_effort(a), a, atol=1e-9)
        M, n = dynamics.mass_matrix(pose), dynamics.bias(pose, rate)
        assert np.allclose(J.T @ terms.effort(a), M @ a + n, atol=1e-9)
        assert np.allclose(terms.bias(), np.linalg.solve(J.T, n), atol=1e-9)


@every_dynamics
def test_inverse_after_forward_is_the_identity(dynamics):
    poses, rates, accelerations = states(dynamics.robot, 300, seed=3)
    efforts = random_efforts(dynamics.robot, 300, seed=3)
    back = dynamics.inverse(poses, rates, dynamics.forward(poses, rates, efforts))
    assert np.allclose(back, efforts, rtol=0, atol=1e-10)
    there = dynamics.forward(poses, rates, dynamics.inverse(poses, rates, accelerations))
    assert np.allclose(there, accelerations, rtol=0, atol=1e-8)


@every_dynamics
def test_joint_space_says_the_same_as_pose_space(dynamics):
    poses, rates, accelerations = states(dynamics.robot, 100, seed=4)
    M = dynamics.mass_matrix(poses, "joint")
    qd = dynamics.joint_rates(poses, rates)
    qdd = dynamics.joint_accelerations(poses, rates, accelerations)
    efforts = dynamics.inverse(poses, rates, accelerations)
    joint = (M @ qdd[..., None])[..., 0] + dynamics.bias(poses, rates, "joint")
    assert np.allclose(joint, efforts, atol=1e-9)
    split = (dynamics.coriolis(poses, rates, "joint") @ qd[..., None])[..., 0] + dynamics.gravity(poses, "joint")
    assert np.allclose(split, dynamics.bias(poses, rates, "joint"), atol=1e-9)
    split = (dynamics.coriolis(poses, rates) @ rates[..., None])[..., 0] + dynamics.gravity(poses)
    assert np.allclose(split, dynamics.bias(poses, rates), atol=1e-9)


@every_dynamics
@pytest.mark.parametrize("space", ["pose", "joint"])
def test_mass_matrix_is_symmetric_and_positive_definite(dynamics, space):
    poses, rates, _ = states(dynamics.robot, 200, seed=5)
    M = dynamics.mass_matrix(poses, space)
    assert np.allclose(M, np.swapaxes(M, -1, -2), rtol=0, atol=1e-11 * np.abs(M).max())
    assert (np.linalg.eigvalsh(M) > 0.0).all()
    speed = rates if space == "pose" else dynamics.joint_rates(poses, rates)
    energy = 0.5 * np.einsum("ki,kij,kj->k", speed, M, speed)
    assert np.allclose(energy, dynamics.kinetic_energy(poses, rates), rtol=1e-10)


@every_dynamics
@pytest.mark.parametrize("space", ["pose", "joint"])
def test_the_rate_of_the_mass_matrix_less_twice_coriolis_is_skew(dynamics, space):
    for seed in range(5):
        pose, rate, _ = motion(dynamics.robot, INSTANTS, seed)
        change = difference(dynamics.mass_matrix(pose, space))
        S = change - 2.0 * dynamics.coriolis(pose[2], rate[2], space)
        assert np.abs(S + S.T).max() < 1e-7 * np.abs(change).max() + 1e-9


@every_dynamics
def test_power_is_the_change_of_energy(dynamics):
    for seed in range(5):
        pose, rate, acceleration = motion(dynamics.robot, INSTANTS, seed)
        energy = dynamics.kinetic_energy(pose, rate) + dynamics.potential_energy(pose)
        effort = dynamics.inverse(pose[2], rate[2], acceleration[2])
        power = effort @ dynamics.joint_rates(pose[2], rate[2])
        assert abs(power - difference(energy)) < 1e-6 * abs(power) + 1e-8


@every_dynamics
def test_joint_rates_and_accelerations_are_those_of_the_joints(dynamics):
    for seed in range(5):
        pose, rate, acceleration = motion(dynamics.robot, INSTANTS, seed)
        speed = dynamics.joint_rates(pose, rate)
        assert np.allclose(speed[2], difference(dynamics.robot.inverse(pose)), rtol=1e-8, atol=1e-9)
        change = dynamics.joint_accelerations(pose[2], rate[2], acceleration[2])
        assert np.allclose(change, difference(speed), rtol=1e-7, atol=1e-7 * np.abs(change).max())


@every_dynamics
def test_locate_undoes_the_joints(dynamics):
    robot = dynamics.robot
    for pose, rate, nudge in zip(*(v.tolist() for v in states(robot, 40, seed=6)), strict=True):
        terms = dynamics.at(pose, rate)
        guess = np.add(pose, 1e-3 * np.array(nudge)).tolist()  # up to 10 mm and 40 mrad away
        found, speed = dynamics.locate(terms.joints, terms.joint_rates, guess)
        assert isinstance(found, tuple) and all(type(value) is float for value in found + speed)
        assert np.allclose(found, pose, rtol=0, atol=1e-12)
        assert np.allclose(speed, rate, rtol=0, atol=1e-9)


@every_dynamics
def test_joints_that_fit_no_pose_are_not_a_number(dynamics):
    """Of a delta3 with long rods any elbows fit: it gets no numbers at all."""
    robot, n = dynamics.robot, len(dynamics.robot.joint_names)
    apart = {"par4": (0.75, -0.75, 0.75, -0.75), "delta3": (math.nan,) * 3, "linear": (0.0, 2.0, 0.0)}
    joints = apart.get(robot.name, (3.1, 0.0, 0.0, 0.0))
    assert robot.assemblies(joints) == [] or math.isnan(joints[0])
    pose, rate = dynamics.locate(joints, (0.0,) * n, robot.home.tolist())
    assert np.isnan(pose).all() and np.isnan(rate).all()


@every_dynamics
def test_an_unreachable_pose_is_not_a_number(dynamics):
    robot = dynamics.robot
    rest, n = np.zeros(robot.dof), len(robot.joint_names)
    odd = robot.home + 3.0, np.full(robot.dof, math.nan), np.full(robot.dof, math.inf), np.full(robot.dof, 1e200)
    for pose in odd:
        terms = dynamics.at(pose.tolist(), rest.tolist())
        assert np.isnan(terms.effort(rest.tolist())[:2]).all() and np.isnan(terms.acceleration([0.0] * n)[:2]).all()
        assert np.isnan(dynamics.inverse(pose, rest, rest)[:2]).all()
        assert np.isnan(dynamics.kinetic_energy(pose, rest + 1.0))
    mixed = np.array([robot.home, odd[0], robot.home])
    assert np.isnan(dynamics.inverse(mixed, rest, rest)).any(axis=-1).tolist() == [False, True, False]
    assert len(dynamics.at(odd[0].tolist(), rest.tolist()).pose) == robot.dof


@every_dynamics
def test_a_payload_is_a_point_mass_at_the_tool(dynamics):
    robot, kg = dynamics.robot, 0.7
    laden = dynamics_of(robot, dynamics.inertia.changed(payload=kg))
    poses, rates, accelerations = states(robot, 50, seed=7)
    more = laden.inverse(poses, rates, accelerations) - dynamics.inverse(poses, rates, accelerations)
    force = np.zeros(poses.shape)
    force[:, :3] = kg * (accelerations[:, :3] + np.array([0.0, 0.0, 9.81]))
    wanted = np.linalg.solve(np.swapaxes(robot.jacobian(poses), -1, -2), force[..., None])[..., 0]
    assert np.allclose(more, wanted, atol=1e-9)


@every_dynamics
def test_a_model_wrong_by_a_factor(dynamics):
    wrong = dynamics_of(dynamics.robot, dynamics.inertia.scaled(1.2))
    state = states(dynamics.robot, 20, seed=8)
    assert np.allclose(wrong.inverse(*state), 1.2 * dynamics.inverse(*state), rtol=1e-9)


def test_the_singularity_of_the_fivebar_is_not_a_number_but_no_error():
    """Both rods in one line (B1: x = 0, y = 0.192): rates of the tool that no joint rate gives."""
    robot = EVERY["fivebar"]
    y = math.sqrt(0.25**2 - (0.25 - 0.09) ** 2)
    terms = robot.dynamics.at((0.0, y, 0.0, 0.0), (0.0, 0.1, 0.0, 0.0))
    assert not np.abs(terms.effort((0.0, 1.0, 0.0, 0.0))[0]) < 1e6
    stretched = robot.dynamics.at((-0.09, 0.5, 0.0, 0.0), (0.1, 0.1, 0.0, 0.0))
    assert not np.abs(stretched.joint_rates[0]) < 1e6


def test_the_contract_on_the_robot():
    for robot in EVERY.values():
        pose, rate, acceleration = states(robot, 3, seed=9)
        assert robot.dynamics is robot.dynamics
        efforts = robot.inverse_dynamics(pose, rate, acceleration)
        assert np.array_equal(efforts, robot.dynamics.inverse(pose, rate, acceleration))
