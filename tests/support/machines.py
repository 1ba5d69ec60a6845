"""Machines in some poses and dimensions, and where their points are."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.robots import ROBOTS, Robot
from app.robots.parts import Machine, Part, Placement

GAP = 1e-6
"""Loops close to this (metres)."""

VARIANTS: list[tuple[str, dict[str, Any]]] = [
    *((name, {}) for name in ROBOTS),
    ("par4", {"R": 0.12, "L": 0.26, "l": 0.45, "h": 0.05, "d": 0.08, "d_i": 0.02, "B_z": 0.03, "P_z": 0.055}),
    ("delta3", {"f": 0.4573, "e": 0.115, "rf": 0.112, "re": 0.232, "q_min": math.radians(-35.0)}),
    ("linear", {"S_A": 0.60, "U_A": 0.35, "W_A": 0.17, "l": 0.45, "s_p": 0.12}),
    ("fivebar", {"l_f": 0.12, "l_p": 0.20, "l_d": 0.28, "z_min": -0.05, "z_max": 0.08}),
]


def dimensions_of(robot: Robot) -> Any:
    """The robot's own geometry, whose fields depend on the robot."""
    return robot.geometry


def reachable_poses(robot: Robot, count: int, seed: int = 1) -> NDArray[np.float64]:
    """Poses all over the workspace."""
    rng = np.random.default_rng(seed)
    spread = np.array([0.25, 0.25, 0.35, 3.0])[: robot.dof]
    poses = robot.home + rng.uniform(-1.0, 1.0, (200 * count, robot.dof)) * spread
    poses = poses[robot.reachable(poses)]
    assert len(poses) >= count
    return poses[:count]


def path(robot: Robot) -> Iterator[NDArray[np.float64]]:
    """Small steps on a closed curve through much of the workspace, turning where the robot can turn."""
    targets = reachable_poses(robot, 6, seed=5)
    for start, end in zip(targets, np.roll(targets, -1, axis=0), strict=True):
        for t in np.linspace(0.0, 1.0, 300, endpoint=False):
            yield robot.nearest(start + t * (end - start))


def rotated(wxyz: ArrayLike, point: ArrayLike) -> NDArray[np.float64]:
    """A point turned by a quaternion, as three.js does it: without normalising."""
    w, x, y, z = np.asarray(wxyz, dtype=float)
    columns = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.array(columns) @ np.asarray(point, dtype=float)


def where(placement: Placement, copy: int, point: ArrayLike) -> NDArray[np.float64]:
    """A point of one copy of a body, in the base frame."""
    return placement.positions[copy] + rotated(placement.wxyzs[copy], point)


def on_tool(machine: Machine, pose: NDArray[np.float64], point: ArrayLike) -> NDArray[np.float64]:
    """A point of the tool frame, in the base frame."""
    position, wxyz = machine.tool_frame(pose.tolist())
    return np.array(position, dtype=np.float32) + rotated(np.array(wxyz, dtype=np.float32), point)


def placed(robot: Robot, machine: Machine, pose: NDArray[np.float64]) -> dict[str, Placement]:
    """Every moving body in the base frame, added up in float32 as the page's scene graph has it."""
    values = pose.tolist()
    placements = machine.place(values, robot.solve(*values))
    origin = np.array(values[:3], dtype=np.float32)
    riding = {body.name for body in machine.bodies if body.frame == "platform"}
    return {
        name: Placement(place.positions + origin, place.wxyzs) if name in riding else place
        for name, place in placements.items()
    }


def close(one: ArrayLike, other: ArrayLike) -> bool:
    return float(np.linalg.norm(np.asarray(one) - np.asarray(other))) < GAP


def tangent(azimuth_deg: float) -> NDArray[np.float64]:
    a = math.radians(azimuth_deg)
    return np.array([-math.sin(a), math.cos(a), 0.0])


def part_named(machine: Machine, name: str) -> Part:
    return next(part for part in machine.parts if part.name == name)
