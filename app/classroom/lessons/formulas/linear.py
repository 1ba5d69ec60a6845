"""The linear delta's forward kinematics step by step, with the slip that its published table has, and rod lengths."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from app.classroom.lessons.formulas.quantities import joints_of, pose_of, robot_of
from app.classroom.lessons.formulas.registry import Quantity, formula
from app.robots.linear import LinearGeometry

Table = dict[str, float]
NOTHING: Any = {}


@formula("thesis_forward")
def thesis_forward(d1: float, d2: float, d3: float, slip: bool = False) -> dict[str, Quantity]:
    """x, y, z (mm) of carriages (mm) by three spheres, and on the way the line s_y, t_y (mm) and a, b (mm), c (mm^2).

    With `slip` as Table 3 of the thesis was computed: -t_y for t_y in b.
    """
    from app.simulation.reproduce.linear.equations import platform, reduced

    carriages = _metres(d1, d2, d3)
    x, y, z = platform(carriages, LinearGeometry(), slip)
    line = reduced(carriages, LinearGeometry(), slip)
    return {
        "x": Quantity(1e3 * x, "mm"),
        "y": Quantity(1e3 * y, "mm"),
        "z": Quantity(1e3 * z, "mm"),
        "s_x": Quantity(line.s_x),
        "s_y": Quantity(line.s_y),
        "t_x": Quantity(1e3 * line.t_x, "mm"),
        "t_y": Quantity(1e3 * line.t_y, "mm"),
        "a": Quantity(line.a),
        "b": Quantity(1e3 * line.b, "mm"),
        "c": Quantity(1e6 * line.c, "mm^2"),
    }


@formula("thesis_miss", "mm")
def thesis_miss(d1: float, d2: float, d3: float) -> float:
    """How far the slip of Table 3 puts the platform from where it is."""
    from app.simulation.reproduce.linear.equations import platform

    carriages = _metres(d1, d2, d3)
    return 1e3 * math.dist(platform(carriages, LinearGeometry()), platform(carriages, LinearGeometry(), slip=True))


@formula("rod_length", "mm")
def rod_length(robot: str, joints: Table, pose: Table, leg: int, preset: str = "", geometry: Table = NOTHING) -> float:
    """How long the rod of a leg (from 1) would have to be from these joints to this pose, whether they fit or not."""
    machine = robot_of(robot, preset, geometry)
    skeleton = machine.skeleton(pose_of(machine, pose), joints_of(machine, joints))
    return 1e3 * float(np.linalg.norm((skeleton.elbow - skeleton.platform)[leg - 1]))


def _metres(*millimetres: float) -> tuple[float, float, float]:
    d1, d2, d3 = (0.001 * d for d in millimetres)
    return d1, d2, d3
