"""The space that a robot reaches: counted on a grid as in the Par4's paper, and along one vertical line."""

from __future__ import annotations

import functools
import math

import numpy as np

from app.classroom.lessons.formulas.quantities import pose_of, robot_of, shown
from app.classroom.lessons.formulas.registry import Quantity, formula
from app.robots.slices import heights
from app.robots.workspace import grid

PAPER_BOX = np.array([-0.17, -0.21, -0.51]), np.array([0.17, 0.14, -0.22])
"""Lowest and highest corner (3,) of the box that the Par4's paper searches, m."""

CUBIC_MM_PER_LITRE = 1e6


@formula("par4_grid")
def par4_grid(step: float, theta: float = 0.0, P_z: float = 64.5) -> dict[str, Quantity]:
    """Points of the paper's box, `step` mm apart: how many are `tested` and `inside` reach, and the `volume` that these
    stand for (l); theta in deg, P_z (joints above the tool point) in mm."""
    if not 2.0 <= step <= 50.0:
        raise ValueError("a step of the grid lies between 2 and 50 mm.")
    tested, inside = _counted(step, theta, P_z)
    litres = inside * step**3 / CUBIC_MM_PER_LITRE
    return {"tested": Quantity(tested), "inside": Quantity(inside), "volume": Quantity(litres, "l")}


@functools.lru_cache(maxsize=32)
def _counted(step: float, theta: float, P_z: float) -> tuple[int, int]:
    poses = grid(*PAPER_BOX, step / 1e3, math.radians(theta))
    inside = robot_of("par4", geometry={"P_z": P_z}).reachable(poses)
    return len(poses), int(inside.sum())


@formula("column")
def column(robot: str, preset: str = "", rotation: float = 0.0) -> dict[str, Quantity]:
    """`lowest` and `highest` z (mm) on the vertical line through the robot's home, to about 1 mm; rotation in deg."""
    low, high = heights(robot_of(robot, preset), math.radians(rotation))
    return {"lowest": shown(low, "m"), "highest": shown(high, "m")}


@formula("reachable")
def reachable(robot: str, pose: dict[str, float], preset: str = "") -> bool:
    """Whether a pose lies inside reach and every limit."""
    machine = robot_of(robot, preset)
    return bool(machine.reachable(pose_of(machine, pose)))
