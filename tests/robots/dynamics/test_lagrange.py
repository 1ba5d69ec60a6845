"""The equations of motion against Lagrange's, made from the bodies alone by differences."""

from __future__ import annotations

import numpy as np
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st

from app.robots import GeometryError, build_robot
from app.robots.dynamics import INERTIA, Dynamics, dynamics_of
from tests.robots.dynamics import bodies
from tests.robots.dynamics.states import EVERY, every_dynamics, states


def assert_lagrange(dynamics: Dynamics, pose: np.ndarray, rate: np.ndarray) -> None:
    mass = bodies.mass_matrix(dynamics, pose)
    size = np.sqrt(np.outer(mass.diagonal(), mass.diagonal()))
    assert np.abs((dynamics.mass_matrix(pose) - mass) / size).max() < 1e-6
    force = bodies.bias(dynamics, pose, rate)
    assert np.abs(dynamics.bias(pose, rate) - force).max() < 2e-5 * np.abs(force).max()


@every_dynamics
def test_bodies_and_lagrange_give_the_same_mass_and_bias(dynamics):
    poses, rates, _ = states(dynamics.robot, 4, seed=1)
    for pose, rate in zip(poses, rates, strict=True):
        assert_lagrange(dynamics, pose, rate)


@every_dynamics
def test_gravity_is_the_slope_of_the_potential_energy(dynamics):
    poses, _, _ = states(dynamics.robot, 5, seed=2)
    for pose in poses:
        assert np.allclose(dynamics.gravity(pose), bodies.gravity(dynamics, pose), rtol=1e-7, atol=1e-6)
    own = dynamics.potential_energy(poses) - dynamics.potential_energy(poses[0])
    theirs = [bodies.potential_energy(dynamics, pose) - bodies.potential_energy(dynamics, poses[0]) for pose in poses]
    assert np.allclose(own, theirs, atol=1e-12)


@every_dynamics
def test_kinetic_energy_is_that_of_the_bodies(dynamics):
    poses, rates, _ = states(dynamics.robot, 5, seed=3)
    for pose, rate in zip(poses, rates, strict=True):
        energy = 0.5 * rate @ bodies.mass_matrix(dynamics, pose) @ rate
        assert abs(dynamics.kinetic_energy(pose, rate) - energy) < 1e-6 * energy


@settings(max_examples=12, phases=[Phase.generate], suppress_health_check=[HealthCheck.filter_too_much])
@given(
    st.sampled_from(sorted(EVERY)),
    st.lists(st.floats(-1.0, 1.0), min_size=16, max_size=16),
    st.floats(0.3, 3.0),
    st.floats(0.0, 2.0),
)
def test_any_geometry_and_any_masses(name, changes, factor, payload):
    geometry = EVERY[name].geometry
    dimensions = {
        key: min(max(getattr(geometry, key) * (1.0 + 0.12 * change), d.low), d.high)
        for (key, d), change in zip(geometry.dimensions().items(), changes, strict=False)
        if d.unit == "m"
    }
    try:
        robot = build_robot(name, dimensions)
    except GeometryError:
        assume(False)
    dynamics = dynamics_of(robot, INERTIA[name].scaled(factor).changed(payload=payload))
    pose, rate = robot.home, np.array([0.4, -0.7, 0.5, 2.0])[: robot.dof]
    assert_lagrange(dynamics, pose, rate)
    acceleration = np.array([3.0, -2.0, 5.0, 20.0])[: robot.dof]
    effort = dynamics.inverse(pose, rate, acceleration)
    assert np.allclose(dynamics.forward(pose, rate, effort), acceleration, rtol=1e-9, atol=1e-9)
    joints, speeds = robot.inverse(pose), dynamics.joint_rates(pose, rate)
    found = dynamics.locate(joints.tolist(), speeds.tolist(), (pose + 1e-3).tolist())
    assert np.allclose(found, [pose, rate], atol=1e-9)
