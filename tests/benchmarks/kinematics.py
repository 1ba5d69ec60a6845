"""Speed of the inverse kinematics, as ratios in one run.

    python tests/benchmarks/kinematics.py [--poses 1000000] [--json]

For each robot: the vectorised `inverse` of many poses against a plain Python loop over `solve`, and against a
straightforward NumPy transcription of the paper's formulas; then one pose on the drag path (`reach`, which
includes the inverse) in plain floats against `inverse` on a one-pose array.
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

LOOP_POSES = 20_000
REPEATS = 3


def par4_as_printed(poses: np.ndarray) -> np.ndarray:
    """(1)-(23) of Laski & Smykowski, with F_3 corrected and the root that is never 0/0."""
    R, L, l, d, h, d_i, h_i, P_z = 0.185, 0.2, 0.386, 0.102, 0.072, 0.009, 0.024, 0.0645
    x, y, z, theta = poses.T
    azimuth = np.radians([45.0, 135.0, 225.0, 315.0])
    B = np.array([R * np.cos(azimuth), R * np.sin(azimuth), np.zeros(4)])
    s, c = np.sin(theta), np.cos(theta)
    P = np.array(
        [
            [x - h * s + d / 2 + d_i, y + h * c + h_i, z + P_z],
            [x - h * s - d / 2 - d_i, y + h * c + h_i, z + P_z],
            [x - d / 2 - d_i, y - h_i, z + P_z],
            [x + d / 2 + d_i, y - h_i, z + P_z],
        ]
    )
    u = P - B.T[:, :, None]
    E = 2 * L * u[:, 2]
    F = -2 * L * (u[:, 0] * np.cos(azimuth)[:, None] + u[:, 1] * np.sin(azimuth)[:, None])
    G = (u**2).sum(1) + L**2 - l**2
    return (2 * np.arctan((G + F) / (np.sqrt(E**2 + F**2 - G**2) - E))).T


def delta3_as_printed(poses: np.ndarray) -> np.ndarray:
    """(1)-(10) of Rivas et al. with their signs corrected: the coordinates are turned for arms 2 and 3."""
    L1, L2, rf, re = 0.36 / (2 * math.sqrt(3)), 0.12 / (2 * math.sqrt(3)), 0.16, 0.38
    joints = []
    for turn in np.radians([0.0, 120.0, 240.0]):
        x0 = poses[:, 0] * np.cos(turn) + poses[:, 1] * np.sin(turn)
        y1 = -poses[:, 0] * np.sin(turn) + poses[:, 1] * np.cos(turn) - L2
        z0 = poses[:, 2]
        A = (x0**2 + y1**2 + z0**2 + rf**2 - re**2 - L1**2) / (2 * z0)
        B = -(L1 + y1) / z0
        a, b, c = 1 + B**2, 2 * A * B + 2 * L1, A**2 + L1**2 - rf**2
        y_J = (-b - np.sqrt(b**2 - 4 * a * c)) / (2 * a)
        joints.append(np.arctan2(-(A + B * y_J), -L1 - y_J))
    return np.array(joints).T


def linear_as_printed(poses: np.ndarray) -> np.ndarray:
    """(9) of Ashraf, z up."""
    zeta = np.array([[-0.1575, -0.091], [0.1575, -0.091], [0.0, 0.182]])
    away = poses[:, None, :2] - zeta
    return -poses[:, 2:] - np.sqrt(0.365**2 - (away**2).sum(-1))


def fivebar_as_printed(poses: np.ndarray) -> np.ndarray:
    """(1), (7)-(11) of Righettini et al.: two triangles and the ball-screw-spline."""
    x, y, z, phi = poses.T
    joints = []
    for motor, elbow in ((-0.09, 1.0), (0.09, -1.0)):
        r = np.sqrt((x - motor) ** 2 + y**2)
        joints.append(np.arctan2(y, x - motor) + elbow * np.arccos(r / (2 * 0.25)))
    return np.array([*joints, phi - 2 * np.pi * z / 0.02, phi]).T


AS_PRINTED = {
    "par4": par4_as_printed,
    "delta3": delta3_as_printed,
    "linear": linear_as_printed,
    "fivebar": fivebar_as_printed,
}


def seconds(act: Callable[[], object]) -> float:
    """Least time of a few runs."""
    best = math.inf
    for _ in range(REPEATS):
        start = time.perf_counter()
        act()
        best = min(best, time.perf_counter() - start)
    return best


def reachable_poses(robot: Robot, count: int) -> np.ndarray:
    rng = np.random.default_rng(0)
    low, high = bounding_box(robot)
    poses = np.empty((0, robot.dof))
    while len(poses) < count:
        positions = rng.uniform(low, high, (count, 3))
        turns = rng.uniform(-robot.rotation_limit, robot.rotation_limit, (count, robot.dof - 3))
        batch = np.hstack([positions, turns])
        poses = np.vstack([poses, batch[robot.reachable(batch)]])
    return poses[:count]


def measure(name: str, count: int) -> dict[str, float | str]:
    robot, transcription = make_robot(name), AS_PRINTED[name]
    poses = reachable_poses(robot, count)
    few = poses[:LOOP_POSES].tolist()
    assert np.allclose(transcription(poses[:1000]), robot.inverse(poses[:1000]), atol=1e-9)
    vectorised = seconds(lambda: robot.inverse(poses)) / count
    loop = seconds(lambda: [robot.solve(*pose) for pose in few]) / len(few)
    printed = seconds(lambda: transcription(poses)) / count
    drag = seconds(lambda: [robot.reach(pose) for pose in few]) / len(few)
    array = seconds(lambda: [robot.inverse(pose) for pose in few[:2000]]) / 2000
    return {
        "robot": name,
        "ns_per_pose": 1e9 * vectorised,
        "loop_over_vectorised": loop / vectorised,
        "transcription_over_vectorised": printed / vectorised,
        "drag_us": 1e6 * drag,
        "array_over_drag": array / drag,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--poses", type=int, default=1_000_000)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    rows = [measure(name, options.poses) for name in ROBOTS]
    if options.json:
        print(json.dumps(rows, indent=2))
        return
    print("| robot | ns / pose | plain loop / ours | NumPy as printed / ours | drag path us | one-pose array / that |")
    print("|---|---|---|---|---|---|")
    for row in rows:
        print(
            f"| {row['robot']} | {row['ns_per_pose']:.0f} | {row['loop_over_vectorised']:.1f} | "
            f"{row['transcription_over_vectorised']:.2f} | {row['drag_us']:.1f} | {row['array_over_drag']:.1f} |"
        )


if __name__ == "__main__":
    main()
