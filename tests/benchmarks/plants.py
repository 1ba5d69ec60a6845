"""Steps a second of the plants, as ratios in one run, and the time of whole runs under each law.

    python -m tests.benchmarks.plants [--json]

The obvious loop in NumPy takes the mass matrix and the bias from the papers' matrices, written down in NumPy
(1 + dof inverse dynamics a step), solves, and steps; all plants have the same step and the same held efforts.
Processor time of this thread, best of several runs.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Callable

import numpy as np

from app.robots import Robot, make_robot
from app.simulation import helix_tracking, work_cycle
from app.simulation.plant import FRICTION, ExactPlant, Plant
from app.simulation.prototype import MujocoPlant
from tests.benchmarks.dynamics import AS_PRINTED

STEP_S = 0.00025
STEPS = 400


class NumpyPlant:
    """Semi-implicit Euler with the papers' matrices."""

    def __init__(self, robot: Robot) -> None:
        self._robot, self._inverse = robot, AS_PRINTED[robot.name]
        self._pose, self._rate = robot.home.copy(), np.zeros(robot.dof)

    def advance(self, effort: np.ndarray, duration_s: float) -> None:
        still = np.zeros(len(self._pose))
        bias = self._inverse(self._pose, self._rate, still)
        columns = [self._inverse(self._pose, self._rate, unit) - bias for unit in np.eye(len(still))]
        self._rate = self._rate + duration_s * np.linalg.solve(np.array(columns).T, effort - bias)
        self._pose = self._pose + duration_s * self._rate


def seconds(act: Callable[[], object], runs: int = 5) -> float:
    best = math.inf
    for _ in range(runs):
        start = time.thread_time()
        act()
        best = min(best, time.thread_time() - start)
    return best


def steps_a_second(plant: Plant | NumpyPlant, weight: np.ndarray, steps: int = STEPS) -> float:
    """Held up against its weight, so that it stays where it is."""

    def run() -> None:
        for _ in range(steps):
            plant.advance(weight, STEP_S)  # pyright: ignore[reportArgumentType]

    return steps / seconds(run)


def plants(name: str) -> dict[str, float | str]:
    robot = make_robot(name)
    still = np.zeros(robot.dof)
    weight = robot.inverse_dynamics(robot.home, still, still)
    home, drag = robot.home.tolist(), FRICTION[name]
    rates = {
        "analytic": steps_a_second(ExactPlant(robot, pose=home), weight),
        "analytic, friction": steps_a_second(ExactPlant(robot, pose=home, friction=drag), weight),
        "MuJoCo": steps_a_second(MujocoPlant(robot, pose=home), weight),
        "MuJoCo, friction": steps_a_second(MujocoPlant(robot, pose=home, friction=drag), weight),
    }
    if name in AS_PRINTED:
        rates["NumPy"] = steps_a_second(NumpyPlant(robot), weight, steps=100)
    ratios = {f"{kind} / NumPy": rate / rates["NumPy"] for kind, rate in rates.items() if "NumPy" in rates}
    times = {f"{kind}, x real time": rate * STEP_S for kind, rate in rates.items()}
    return {"robot": name, **rates, **times, **ratios}


def runs() -> dict[str, float]:
    """Whole runs, s of processor time; the second of each, when everything is loaded."""
    found = {}
    for law in ("PD", "PID", "TSIDC", "TSIIDC", "MPC"):
        found[f"W2 {law}"] = seconds(lambda law=law: work_cycle(law, "W2"), 3)
    found["W2 PD, PID, TSIDC, TSIIDC"] = sum(found[f"W2 {law}"] for law in ("PD", "PID", "TSIDC", "TSIIDC"))
    for law in ("PD", "PID", "CTC", "CTC+DOB", "MPC", "SMC"):
        found[f"T2 {law}"] = seconds(lambda law=law: helix_tracking(law, "T2", True), 3)
    found["W2 TSIIDC, MuJoCo"] = seconds(lambda: work_cycle("TSIIDC", "W2", plant="mujoco"), 2)
    found["T2 CTC, MuJoCo"] = seconds(lambda: helix_tracking("CTC", "T2", plant="mujoco"), 2)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    report = {"plants": [plants(name) for name in ("par4", "delta3", "linear", "fivebar")], "runs_s": runs()}
    if options.json:
        print(json.dumps(report, indent=2))
        return
    for row in report["plants"]:
        print(row["robot"])
        for kind, value in list(row.items())[1:]:
            print(f"  {kind:40} {value:10.3g}")
    print("whole runs, s")
    for kind, value in report["runs_s"].items():
        print(f"  {kind:40} {value:10.3f}")


if __name__ == "__main__":
    main()
