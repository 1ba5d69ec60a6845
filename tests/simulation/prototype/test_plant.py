"""The MuJoCo plant as a plant: it moves as the equations say, its loops stay closed, loads and friction are felt."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from app.robots import ROBOTS, Robot, make_robot
from app.robots.dynamics import INERTIA, dynamics_of
from app.simulation.plant import FRICTION, Friction, Plant
from app.simulation.prototype import Item, MujocoPlant

EVERY = {name: make_robot(name) for name in ROBOTS}
RATE = (0.2, -0.1, 0.1, 0.5)
SWAY = {
    "par4": (0.5, -0.3, -0.4, 0.3),
    "delta3": (0.2, -0.3, 0.1),
    "linear": (4.0, -6.0, 2.0),
    "fivebar": (20.0, -14.0, 5.0, 3.0),
}
"""Efforts beside the robot's weight, N m or N, in a test."""
STEP_S = 0.00025
every_robot = pytest.mark.parametrize("name", ROBOTS)

Efforts = Callable[[float], np.ndarray]


def swaying(robot: Robot) -> Efforts:
    """Efforts that carry the robot's weight at home and push it about."""
    weight, sway = dynamics_of(robot).gravity(robot.home, space="joint"), np.array(SWAY[robot.name])
    return lambda t: weight + sway * np.sin(15.0 * t + np.arange(len(sway)))


def drive(plant: MujocoPlant, efforts: Efforts, duration_s: float) -> float:
    """Let time pass; returns the largest gap of a loop, m."""
    gap = 0.0
    for k in range(round(duration_s / STEP_S)):
        plant.advance(efforts((k + 0.5) * STEP_S).tolist(), STEP_S)
        gap = max(gap, plant.gap_m)
    return gap


def integrated(robot: Robot, efforts: Efforts, friction: Friction | None, duration_s: float) -> np.ndarray:
    """(2 dof,) pose and rate that the closed form leads to."""
    dynamics, dof = dynamics_of(robot), robot.dof

    def change(t: float, state: np.ndarray) -> np.ndarray:
        terms = dynamics.at(state[:dof].tolist(), state[dof:].tolist())
        effort = efforts(t)
        if friction is not None:
            speed = np.array(terms.joint_rates)
            effort = effort - np.array(friction.coulomb) * np.tanh(speed / friction.width) - friction.viscous * speed
        return np.concatenate([state[dof:], terms.acceleration(effort.tolist())])

    start = np.concatenate([robot.home, RATE[:dof]])
    return solve_ivp(change, (0.0, duration_s), start, method="LSODA", rtol=1e-8, atol=1e-10).y[:, -1]


@every_robot
@pytest.mark.parametrize("rubbing", [False, True])
def test_it_moves_as_the_equations_say(name: str, rubbing: bool):
    robot = EVERY[name]
    friction = FRICTION[name] if rubbing else None
    plant: Plant = MujocoPlant(robot, pose=robot.home, rate=RATE[: robot.dof], friction=friction)
    assert isinstance(plant, MujocoPlant)
    gap = drive(plant, swaying(robot), 0.15)
    expected = integrated(robot, swaying(robot), friction, 0.15)
    moved = np.abs(expected[: robot.dof] - robot.home)
    assert moved[:3].max() > 0.004, "the test moves the robot"
    assert np.allclose(plant.pose, expected[: robot.dof], rtol=1e-3, atol=2e-5)
    assert np.allclose(plant.rate, expected[robot.dof :], rtol=2e-3, atol=4e-4)
    assert gap < 1e-7
    assert np.allclose(plant.joints, robot.inverse(plant.pose), rtol=0, atol=1e-6)
    assert np.allclose(plant.joint_rates, dynamics_of(robot).joint_rates(plant.pose, plant.rate), rtol=0, atol=1e-4)


@every_robot
def test_it_starts_as_told(name: str):
    robot = EVERY[name]
    rate = np.array(RATE[: robot.dof])
    plant = MujocoPlant(robot, pose=robot.home, rate=rate)
    assert np.allclose(plant.pose, robot.home, rtol=0, atol=1e-12)
    assert np.allclose(plant.rate, rate, rtol=0, atol=1e-9)
    assert np.allclose(plant.joint_rates, robot.jacobian(robot.home) @ rate, rtol=0, atol=1e-9)
    loops = plant.data.efc_J.reshape(-1, plant.model.nv)[: plant.data.ne]
    assert np.abs(loops @ plant.data.qvel).max() < 1e-9, "no loop is being torn open"


@every_robot
def test_energy_is_kept(name: str):
    """Undriven and without friction, falling from home for a tenth of a second."""
    robot, dynamics = EVERY[name], dynamics_of(EVERY[name])
    plant = MujocoPlant(robot, pose=robot.home, rate=RATE[: robot.dof])

    def energy() -> float:
        return float(dynamics.kinetic_energy(plant.pose, plant.rate) + dynamics.potential_energy(plant.pose))

    before, at_start = energy(), float(dynamics.kinetic_energy(plant.pose, plant.rate))
    drive(plant, lambda t: np.zeros(len(robot.joint_names)), 0.1)
    exchanged = at_start + abs(float(dynamics.kinetic_energy(plant.pose, plant.rate)) - at_start)
    assert energy() == pytest.approx(before, abs=0.01 * exchanged)


@every_robot
def test_a_payload_hung_on_later_weighs_as_much_as_one_built_in(name: str):
    robot = EVERY[name]
    heavy = INERTIA[name].changed(payload=0.5)
    built, hung, light = (MujocoPlant(robot, masses, pose=robot.home) for masses in (heavy, None, None))
    hung.set_payload(0.5)
    for plant in (built, hung, light):
        drive(plant, swaying(robot), 0.05)
    assert np.allclose(hung.pose, built.pose, rtol=0, atol=1e-7)
    assert np.abs(np.subtract(light.pose, built.pose)).max() > 1e-4
    hung.set_payload(0.0)
    assert hung.model.body_mass.sum() == pytest.approx(light.model.body_mass.sum())


def test_stiff_friction_brings_a_light_nut_to_rest():
    """Explicit steps would make it tremble: its friction's slope times the step is twice its inertia."""
    plant = MujocoPlant(EVERY["fivebar"], pose=EVERY["fivebar"].home, rate=(0, 0, 0, 6.0), friction=FRICTION["fivebar"])
    speeds = []
    for _ in range(1200):
        plant.advance((0.0, 0.0, 0.0, 0.0), STEP_S)
        speeds.append(plant.joint_rates[3])
    assert min(speeds) > -1e-3
    assert abs(speeds[-1]) < 1e-3


def test_long_steps_are_cut_and_short_ones_taken_as_they_are():
    robot = EVERY["linear"]
    plants = [MujocoPlant(robot, pose=robot.home) for _ in range(2)]
    plants[0].advance((1.0, 2.0, 3.0), 0.01)
    for _ in range(40):
        plants[1].advance((1.0, 2.0, 3.0), STEP_S)
    assert np.allclose(plants[0].pose, plants[1].pose, rtol=0, atol=1e-12)
    plants[0].advance((0.0, 0.0, 0.0), 1e-5)
    assert plants[0].data.time == pytest.approx(0.01001, abs=1e-9)


def test_a_robot_that_is_torn_apart_is_nowhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """MuJoCo would put it back to where it began, and write a file about it into the present folder."""
    monkeypatch.chdir(tmp_path)
    robot = EVERY["delta3"]
    plant = MujocoPlant(robot, pose=robot.home, friction=FRICTION["delta3"])
    for _ in range(20):
        plant.advance((1e15, -1e15, 1e15), STEP_S)
    assert np.isnan(plant.pose).all()
    assert not list(tmp_path.iterdir())


class TestItems:
    """A box on a moving belt is taken by the 5R robot, carried, and left on the other belt."""

    robot = EVERY["fivebar"]
    start = (0.0, 0.30, -0.02, 0.0)
    box = Item((0.0, 0.30, -0.02, 0.0), belt=(0.0, 0.15), mass=0.4)
    waiting = Item((0.1, 0.20, -0.02, 1.0), belt=(0.0, 0.15))

    def plant(self) -> MujocoPlant:
        return MujocoPlant(self.robot, pose=self.start, rate=(0.0, 0.15, 0.0, 0.0), items=(self.box, self.waiting))

    def test_items_ride_on_their_belt(self):
        plant = self.plant()
        drive(plant, lambda t: np.zeros(4), 0.2)
        for item, ridden in zip((self.box, self.waiting), plant.items, strict=True):
            x, y, z, turn = item.pose
            assert np.allclose(ridden, (x, y + 0.15 * 0.2, z, turn), rtol=0, atol=1e-6)

    def test_a_grasped_item_is_felt_and_moves_with_the_tool(self):
        carrying = self.plant()
        carrying.grasp(0)
        loaded = MujocoPlant(self.robot, INERTIA["fivebar"].changed(payload=0.4), pose=self.start, rate=(0, 0.15, 0, 0))
        empty = MujocoPlant(self.robot, pose=self.start, rate=(0, 0.15, 0, 0))
        for plant in (carrying, loaded, empty):
            drive(plant, lambda t: np.array([15.0, -10.0, -8.0, 5.0]), 0.15)
        assert np.allclose(carrying.pose[:3], loaded.pose[:3], rtol=0, atol=5e-5)
        assert np.linalg.norm(np.subtract(empty.pose, loaded.pose)[:2]) > 1e-3
        x, y, z, turn = carrying.items[0]
        assert np.allclose((x, y, z), carrying.pose[:3], rtol=0, atol=2e-5)
        assert turn == pytest.approx(carrying.pose[3], abs=1e-4)

    def test_a_released_item_stays_behind_on_the_belt(self):
        plant = self.plant()
        plant.grasp(0)
        drive(plant, lambda t: np.array([0.0, -10.0, 0.0, 5.0]), 0.1)
        x, y, z, turn = plant.items[0]
        plant.release(0, (0.0, -0.15))
        drive(plant, lambda t: np.array([10.0, 10.0, -10.0, 0.0]), 0.2)
        assert np.allclose(plant.items[0][:3], (x, y - 0.15 * 0.2, z), rtol=0, atol=2e-4)
        assert plant.items[0][3] == pytest.approx(turn, abs=5e-3), "the weld has to stop its turn"
        assert np.linalg.norm(np.subtract(plant.pose[:2], plant.items[0][:2])) > 0.01
