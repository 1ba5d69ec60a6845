"""Inverse and forward dynamics: plain floats, columns, and the papers' matrices written down in NumPy.

    python -m tests.benchmarks.dynamics [--json]

Processor time of this thread, best of many short runs: other work on the machine hardly disturbs it.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Callable

import numpy as np

from app.robots import ROBOTS, Robot, make_robot
from app.robots.workspace import bounding_box

SIZES = (64, 1024, 100_000)


def fivebar_as_printed(p: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
    """(1)-(11) of Righettini et al. with their transposes restored, one state: sums of m D^T D."""
    m_p = m_d = 2.9
    l, J, m_ee, t = 0.25, 5.22e-2, 0.36, 2 * math.pi / 0.02
    motors = np.array([[-0.09, 0.0], [0.09, 0.0]])
    r = np.linalg.norm(p[:2] - motors, axis=1)
    q = np.arctan2(p[1], p[0] - motors[:, 0]) + np.array([1.0, -1.0]) * np.arccos(r / (2 * l))
    e, e_ = np.array([np.cos(q), np.sin(q)]).T, np.array([-np.sin(q), np.cos(q)]).T
    w = p[:2] - motors - l * e
    D_inverse = w / (l * (w * e_).sum(1))[:, None]
    D, qd = np.linalg.inv(D_inverse), D_inverse @ v[:2]
    perp = np.array([-w[:, 1], w[:, 0]]).T
    D_elbow = [l * np.outer(e_[k], np.eye(2)[k]) for k in (0, 1)]
    D_psi = [perp[k] @ (D - D_elbow[k]) / l**2 for k in (0, 1)]
    psid = np.array([row @ qd for row in D_psi])
    rhs = -l * e[0] * qd[0] ** 2 + l * e[1] * qd[1] ** 2 - w[0] * psid[0] ** 2 + w[1] * psid[1] ** 2
    x = np.linalg.solve(np.array([perp[0], -perp[1]]).T, -rhs)
    bias = [-l * e[k] * qd[k] ** 2 - w[k] * psid[k] ** 2 + perp[k] * x[k] for k in (0, 1)]
    qdd = D_inverse @ (a[:2] - bias[0])
    tau = (J + m_p * (l / 2) ** 2 + 0.1714176) * qdd + m_ee * D.T @ (D @ qdd + bias[0])
    for k in (0, 1):
        D_com = 0.5 * (D_elbow[k] + D)
        com_bias = 0.5 * (-l * e[k] * qd[k] ** 2 + bias[k])
        tau = tau + m_d * D_com.T @ (D_com @ qdd + com_bias) + J * D_psi[k] * (D_psi[k] @ qdd + x[k])
    m, nut = m_ee / t**2, 1.2e-6 + 0.03664
    M_bss = np.array([[nut + m, -m], [-m, nut + 6.4e-6 + m]])
    screw = M_bss @ np.array([a[3] - t * a[2], a[3]]) + m_ee * 9.81 / t * np.array([-1.0, 1.0])
    return np.concatenate([tau, screw])


def linear_as_printed(p: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
    """(11)-(38) of Ashraf with rods as rigid bodies (spec A5), one state."""
    m_p, m_s, m_l, l = 0.60, 0.45, 0.10, 0.365
    zeta = np.array([[-0.1575, -0.091], [0.1575, -0.091], [0.0, 0.182]])
    m = p[:2] - zeta
    h = np.sqrt(l**2 - (m**2).sum(1))
    J = np.column_stack([m / h[:, None], -np.ones(3)])
    u = np.array([0.0, 0.0, -1.0])
    rods = np.column_stack([m, -h]) / l
    V = np.eye(3) - u[None, :, None] * J[:, None, :]
    H = np.swapaxes(V, 1, 2) @ V / (l * rods @ u)[:, None, None]
    dddot = J @ a + np.einsum("i,kij,j->k", v, H, v)
    force = (m_p + 2 * m_l) * a + m_l / 3 * u * dddot.sum() + np.array([0, 0, (m_p + 3 * m_l) * 9.81])
    carriages = (m_s + 2 * m_l / 3) * dddot + m_l / 3 * u @ a - (m_s + m_l) * 9.81
    return carriages + np.linalg.solve(J.T, force)


AS_PRINTED = {"fivebar": fivebar_as_printed, "linear": linear_as_printed}


def microseconds(act: Callable[[], object], calls: int, runs: int = 15) -> float:
    """Of one call."""
    best = math.inf
    for _ in range(runs):
        start = time.thread_time()
        for _ in range(calls):
            act()
        best = min(best, time.thread_time() - start)
    return 1e6 * best / calls


def some_states(robot: Robot, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(0)
    low, high = bounding_box(robot)
    positions = rng.uniform(low, high, (200 * count, 3))
    turns = rng.uniform(-robot.rotation_limit, robot.rotation_limit, (len(positions), robot.dof - 3))
    poses = np.hstack([positions, turns])
    poses = poses[robot.reachable(poses)][:count]
    return poses, rng.uniform(-1, 1, poses.shape), rng.uniform(-5, 5, poses.shape)


def measure(name: str) -> dict[str, float | str]:
    robot = make_robot(name)
    dynamics, (poses, rates, accelerations) = robot.dynamics, some_states(robot, 100)
    p, v, a = (tuple(values[0].tolist()) for values in (poses, rates, accelerations))
    terms = dynamics.at(p, v)
    floats = microseconds(lambda: dynamics.at(p, v).effort(a), 1000)
    row: dict[str, float | str] = {
        "robot": name,
        "at_us": microseconds(lambda: dynamics.at(p, v), 1000),
        "inverse_us": floats,
        "forward_us": microseconds(lambda: dynamics.at(p, v).acceleration(a), 1000),
        "locate_us": microseconds(lambda: dynamics.locate(terms.joints, terms.joint_rates, p), 500),
        "one_state_as_array_ratio": microseconds(lambda: dynamics.inverse(p, v, a), 50) / floats,
    }
    if printed := AS_PRINTED.get(name):
        for state in zip(poses, rates, accelerations, strict=True):
            assert np.allclose(printed(*state), dynamics.inverse(*state), rtol=1e-8, atol=1e-9)
        row["transcription_ratio"] = microseconds(lambda: printed(poses[0], rates[0], accelerations[0]), 50) / floats
    for size in SIZES:
        many = [np.resize(values, (size, robot.dof)) for values in (poses, rates, accelerations)]
        row[f"columns_{size}_us"] = microseconds(lambda m=many: dynamics.inverse(*m), 1, 5) / size
    return row


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    rows = [measure(name) for name in ROBOTS]
    if options.json:
        print(json.dumps(rows, indent=2))
        return
    columns = list(measure("linear"))
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns))
    for row in rows:
        cells = [row.get(column, "") for column in columns]
        print("| " + " | ".join(cell if isinstance(cell, str) else f"{cell:.3g}" for cell in cells) + " |")


if __name__ == "__main__":
    main()
