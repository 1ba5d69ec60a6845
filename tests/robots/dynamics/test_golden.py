"""Both papers' robots against MuJoCo's numbers, and the printed figures of the specifications."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from app.robots.dynamics import FiveBarInertia, LinearInertia, dynamics_of
from app.robots.robot import Array
from tests.robots.dynamics.states import EVERY
from tests.robots.golden import golden

FIVEBAR = {t["name"]: t["points"] for t in golden("fivebar_dynamics")["trajectories"]}
LINEAR = {t["name"]: t["points"] for t in golden("linear_delta_dynamics")["trajectories"]}


def columns(points: list[dict[str, Any]], *names: str) -> list[Array]:
    return [np.array([point[name] for point in points]) for name in names]


def assert_close(ours: Array, theirs: Array, relative: float) -> None:
    assert np.abs(ours - theirs).max() <= relative * np.abs(theirs).max()


@pytest.mark.parametrize("points", FIVEBAR.values(), ids=FIVEBAR)
def test_fivebar_equals_mujoco(points):
    pose, rate, acceleration, q, qd, qdd, torque = columns(points, "p", "pd", "pdd", "q", "qd", "qdd", "tau_mujoco")
    robot = EVERY["fivebar"]
    assert_close(robot.inverse(pose), q, 1e-9)
    assert_close(robot.dynamics.joint_rates(pose, rate), qd, 1e-9)
    assert_close(robot.dynamics.joint_accelerations(pose, rate, acceleration), qdd, 1e-9)
    ours = robot.inverse_dynamics(pose, rate, acceleration)
    for joint in range(4):
        assert_close(ours[:, joint], torque[:, joint], 1e-8)


def test_fivebar_mass_matrix_of_the_arms():
    points = golden("fivebar_ik")["points"]
    pose = np.array([[point["x"], point["y"], 0.0, 0.0] for point in points])
    ours = EVERY["fivebar"].dynamics.mass_matrix(pose, "joint")[:, :2, :2]
    theirs = np.array([point["M5R_plus_act"] for point in points])
    assert_close(ours, theirs, 1e-9)


def test_the_screw_is_the_papers_constant_matrix():
    """M_bss and U_bss of B2 with the drives left out."""
    dynamics = dynamics_of(EVERY["fivebar"], FiveBarInertia().changed(nut_drive=0.0))
    M = dynamics.mass_matrix(EVERY["fivebar"].home, "joint")[2:, 2:]
    assert np.allclose(M, [[4.848e-6, -3.648e-6], [-3.648e-6, 1.1248e-5]], atol=1e-9)
    assert np.allclose(dynamics.gravity(EVERY["fivebar"].home, "joint")[2:], [-0.01124, 0.01124], atol=1e-5)


def test_figures_of_the_work_cycle():
    """B4, B6: torques of W1 and W2, and what another reading of the links' inertia would change. The golden file
    has every 40 ms of the cycle, which miss a little of the peaks."""
    dynamics = EVERY["fivebar"].dynamics
    W1, W2 = (columns(FIVEBAR[name], "p", "pd", "pdd") for name in ("workcycle_W1_z5mm", "workcycle_W2_z25mm"))
    torque = dynamics.inverse(*W1)
    peak = np.abs(torque).max(axis=0) / [25.06, 24.01, 4.93, 2.90]
    assert (peak > 0.92).all() and (peak < 1.002).all()
    assert np.sqrt((torque**2).mean(axis=0)) == pytest.approx([7.35, 7.02, 2.63, 1.29], rel=0.04)
    assert np.abs(dynamics.inverse(*W2)[:, 2]).max() == pytest.approx(24.6, rel=0.02)
    about_the_joint = FiveBarInertia().changed(proximal_inertia=6.89e-3, distal_inertia=6.89e-3)
    peak = np.abs(dynamics_of(EVERY["fivebar"], about_the_joint).inverse(*W1)).max() / 20.7
    assert 0.92 < peak < 1.002


@pytest.mark.parametrize("points", LINEAR.values(), ids=LINEAR)
@pytest.mark.parametrize(
    ("lumped", "key"), [(None, "f_mujoco"), (1 / 2, "f_lumped_w_half"), (1 / 3, "f_lumped_w_third")]
)
def test_linear_equals_mujoco_and_the_lumped_models(points, lumped, key):
    pose, rate, acceleration, d, speed, dddot, force = columns(points, "P", "V", "A", "d", "ddot", "dddot", key)
    robot = EVERY["linear"]
    dynamics = dynamics_of(robot, LinearInertia(lumped=lumped))
    assert_close(robot.inverse(pose), d, 1e-9)
    assert_close(dynamics.joint_rates(pose, rate), speed, 1e-9)
    assert_close(dynamics.joint_accelerations(pose, rate, acceleration), dddot, 1e-9)
    assert_close(dynamics.inverse(pose, rate, acceleration), force, 1e-8)


def test_linear_at_one_instant():
    """A5: helix T2 at t = 0.7."""
    t, w = 0.7, 2 * np.pi
    pose = np.array([0.08 * np.sin(w * t), 0.08 * np.cos(w * t), -0.45 - 0.03 * t])
    rate = np.array([0.08 * w * np.cos(w * t), -0.08 * w * np.sin(w * t), -0.03])
    acceleration = -(w**2) * np.array([pose[0], pose[1], 0.0])
    robot = EVERY["linear"]
    assert np.allclose(pose, [-0.0760845, -0.0247214, -0.471], atol=1e-7)
    assert np.allclose(robot.dynamics.joint_rates(pose, rate), [0.0844617, 0.2793969, -0.2689507], atol=1e-7)
    accelerations = robot.dynamics.joint_accelerations(pose, rate, acceleration)
    assert np.allclose(accelerations, [1.6158432, -1.1817993, -0.3032372], atol=1e-7)
    exact = robot.inverse_dynamics(pose, rate, acceleration)
    assert np.allclose(exact, [-7.7145538, -8.7844484, -8.4445540], atol=1e-7)
    half = dynamics_of(robot, LinearInertia(lumped=0.5)).inverse(pose, rate, acceleration)
    assert np.allclose(half, [-7.32159, -9.04477, -8.57719], atol=1e-5)
    third = dynamics_of(robot, LinearInertia(lumped=1 / 3)).inverse(pose, rate, acceleration)
    assert np.allclose(third, [-7.28197, -9.07791, -8.57931], atol=1e-5)


@pytest.mark.parametrize(
    ("case", "errors"),
    [
        ("gravity", (0.692, 0.461, 0.231, 0.000, 0.231, 0.692)),
        ("vertical", (0.782, 0.521, 0.261, 0.000, 0.261, 0.782)),
        ("lateral", (0.660, 0.253, 0.259, 0.667, 1.094, 1.956)),
    ],
)
def test_no_two_points_stand_for_a_rod(case, errors):
    """A5: RMS error (N) of lumped rods with w = 0, 1/6, 1/3, 1/2, 2/3, 1: the best w depends on the motion.
    Poses within r < 0.12, accelerations normally distributed with 5 m/s^2 an axis."""
    rng, still = np.random.default_rng(5), np.zeros(3)
    radius, turn = 0.12 * np.sqrt(rng.random(4000)), rng.uniform(0, 2 * np.pi, 4000)
    pose = np.stack([radius * np.cos(turn), radius * np.sin(turn), rng.uniform(-0.7, -0.37, 4000)], axis=-1)
    axes = {"gravity": (0.0, 0.0, 0.0), "vertical": (0.0, 0.0, 5.0), "lateral": (5.0, 5.0, 0.0)}[case]
    acceleration = rng.normal(size=(4000, 3)) * axes

    def force(lumped: float | None) -> Array:
        dynamics = dynamics_of(EVERY["linear"], LinearInertia(lumped=lumped))
        weight = dynamics.gravity(pose, "joint") if case == "lateral" else 0.0
        return dynamics.inverse(pose, still, acceleration) - weight

    exact = force(None)
    for w, error in zip((0.0, 1 / 6, 1 / 3, 1 / 2, 2 / 3, 1.0), errors, strict=True):
        assert np.sqrt(((force(w) - exact) ** 2).mean()) == pytest.approx(error, rel=0.05, abs=1e-9)
