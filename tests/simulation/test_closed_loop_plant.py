"""The analytic plant against a fine Runge-Kutta solution of the same equations, and against physics."""

from __future__ import annotations

import importlib
import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from app.robots import ROBOTS, make_robot
from app.robots.dynamics import INERTIA, dynamics_of
from app.simulation import work_cycle
from app.simulation.fivebar_plant import FiveBarPlant
from app.simulation.helix import HELICES, helix_tracking
from app.simulation.plant import FRICTION, ExactPlant, Friction

simulating = importlib.import_module("app.simulation.closed_loop.simulate")


class FinePlant(ExactPlant):
    """Classical Runge-Kutta with friction as it is; halving its steps changes nothing that matters here."""

    steps = 1

    def __init__(self, *args: object, friction: Friction | None = None, **kwargs: object) -> None:
        super().__init__(*args, friction=friction, **kwargs)  # pyright: ignore[reportArgumentType]
        self.friction = friction

    def _step(self, effort: Sequence[float], step: float) -> None:
        for _ in range(self.steps):
            self._fine(effort, step / self.steps)

    def _fine(self, effort: Sequence[float], h: float) -> None:
        p, v = self.terms.pose, self.terms.rate
        v1, a1 = v, self._acceleration(p, v, effort)
        v2 = _moved(v, a1, h / 2)
        a2 = self._acceleration(_moved(p, v1, h / 2), v2, effort)
        v3 = _moved(v, a2, h / 2)
        a3 = self._acceleration(_moved(p, v2, h / 2), v3, effort)
        v4 = _moved(v, a3, h)
        a4 = self._acceleration(_moved(p, v3, h), v4, effort)
        self.terms = self._dynamics.at(_moved(p, _mean(v1, v2, v3, v4), h), _moved(v, _mean(a1, a2, a3, a4), h))

    def _acceleration(self, p: Sequence[float], v: Sequence[float], effort: Sequence[float]) -> Sequence[float]:
        terms, friction = self._dynamics.at(p, v), self.friction
        if friction is None:
            return terms.acceleration(effort)
        drag = [
            c * math.tanh(qd / friction.width) + b * qd
            for c, b, qd in zip(friction.coulomb, friction.viscous, terms.joint_rates, strict=True)
        ]
        return terms.acceleration([f - d for f, d in zip(effort, drag, strict=True)])


def _moved(x: Sequence[float], dx: Sequence[float], h: float) -> list[float]:
    return [a + h * b for a, b in zip(x, dx, strict=True)]


def _mean(*k: Sequence[float]) -> list[float]:
    return [(a + 2.0 * b + 2.0 * c + d) / 6.0 for a, b, c, d in zip(*k, strict=True)]


def test_the_work_cycle_is_a_fine_solution_to_a_tenth_of_a_micrometre(monkeypatch: pytest.MonkeyPatch):
    run = work_cycle("TSIIDC", "W2")
    monkeypatch.setattr(simulating, "FiveBarPlant", FinePlant)
    fine = work_cycle("TSIIDC", "W2")
    off = np.abs(run.pose - fine.pose).max(axis=0)
    assert off[:3].max() < 1e-7 and off[3] < 1e-6


def test_the_helix_is_a_fine_solution_to_a_micrometre(monkeypatch: pytest.MonkeyPatch):
    brief = replace(HELICES["T2"], duration_s=0.6)
    run = helix_tracking("PID", brief, friction=True, start="reference")
    monkeypatch.setattr(simulating, "ExactPlant", FinePlant)
    monkeypatch.setattr(FinePlant, "steps", 4)
    fine = helix_tracking("PID", brief, friction=True, start="reference")
    assert np.abs(run.pose - fine.pose).max() < 1e-6


def swinging(name: str, friction: Friction | None, payload: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Energy and pose at each millisecond of a tenth of a second, the drives holding against gravity at the start."""
    robot, inertia = make_robot(name), INERTIA[name].changed(payload=payload)
    dynamics = dynamics_of(robot, inertia)
    rate = np.array([0.15, -0.1, 0.05, 0.5])[: robot.dof]
    plant = ExactPlant(robot, inertia, pose=robot.home.tolist(), rate=rate.tolist(), friction=friction)
    effort = plant.terms.gravity()
    rows = []
    for _ in range(100):
        rows.append((*plant.pose, *plant.rate, *plant.joints))
        plant.advance(effort, 0.001)
    table = np.array(rows)
    pose, rates, joints = table[:, : robot.dof], table[:, robot.dof : 2 * robot.dof], table[:, 2 * robot.dof :]
    energy = dynamics.kinetic_energy(pose, rates) + dynamics.potential_energy(pose) - joints @ np.array(effort)
    return energy, pose


@pytest.mark.parametrize("name", ROBOTS)
def test_energy_is_kept_without_friction_and_only_lost_with_it(name: str):
    energy, pose = swinging(name, None)
    assert np.ptp(pose[:, 0]) > 0.005
    moving = dynamics_of(make_robot(name)).kinetic_energy(pose[0], np.array([0.15, -0.1, 0.05, 0.5])[: pose.shape[1]])
    assert np.ptp(energy) < 1e-4 * moving
    lost, _ = swinging(name, FRICTION[name])
    assert (np.diff(lost) <= 1e-9 * moving).all()
    assert lost[0] - lost[-1] > 0.1 * moving


@pytest.mark.parametrize("name", ROBOTS)
def test_a_payload_is_felt_from_the_moment_it_is_taken(name: str):
    robot = make_robot(name)
    plant = ExactPlant(robot, pose=robot.home.tolist())
    hold = plant.terms.gravity()
    plant.advance(hold, 0.01)
    assert np.allclose(plant.pose, robot.home, atol=1e-12)
    plant.set_payload(0.3)
    plant.advance(hold, 0.001)
    assert plant.rate[2] < 0.0
    loaded = dynamics_of(robot, INERTIA[name].changed(payload=0.3)).forward(robot.home, 0.0 * robot.home, hold)
    assert plant.rate[2] == pytest.approx(0.001 * loaded[2], rel=1e-3)


def test_a_robot_sticks_where_friction_holds_it():
    robot = make_robot("linear")
    plant = ExactPlant(robot, pose=robot.home.tolist(), friction=FRICTION["linear"])
    push = [g + 1.0 for g in plant.terms.gravity()]
    plant.advance(push, 1.0)
    assert np.abs(np.array(plant.pose) - robot.home).max() < 1.5e-3
    freed = ExactPlant(robot, pose=robot.home.tolist())
    freed.advance(push, 0.2)
    assert np.abs(np.array(freed.pose) - robot.home).max() > 0.01


@pytest.mark.parametrize("friction", [None, FRICTION["fivebar"]])
def test_the_five_bar_written_out_takes_the_same_steps(friction: Friction | None) -> None:
    robot, rng = make_robot("fivebar"), np.random.default_rng(5)
    pose, rate = robot.home.tolist(), [0.3, -0.2, 0.02, 2.0]
    plants = [kind(robot, pose=pose, rate=rate, friction=friction) for kind in (ExactPlant, FiveBarPlant)]
    for effort in rng.uniform(-4.0, 4.0, (300, 4)).tolist():
        for plant in plants:
            plant.advance(effort, 0.00025)
    usual, written_out = plants
    assert np.abs(np.subtract(usual.pose, pose)).max() > 1e-3, "it moves"
    np.testing.assert_allclose(written_out.pose, usual.pose, rtol=0, atol=1e-12)
    np.testing.assert_allclose(written_out.rate, usual.rate, rtol=0, atol=1e-10)
