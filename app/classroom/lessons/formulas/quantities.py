"""From the units of a lesson (mm, deg) to a robot's, and back."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping

from app.classroom.lessons.formulas.registry import Quantity
from app.robots import ROBOTS, Robot, build_robot
from app.robots.geometry import GeometryError

DISPLAY = {"m": (1e3, "mm"), "rad": (180.0 / math.pi, "deg")}
"""Unit of a robot -> factor and unit to read."""


def robot_of(name: str, preset: str = "", geometry: Mapping[str, float] | None = None) -> Robot:
    """A robot, some of its dimensions changed (mm, deg)."""
    return _built(name, preset, tuple(sorted((geometry or {}).items())))


@functools.lru_cache(maxsize=64)
def _built(name: str, preset: str, geometry: tuple[tuple[str, float], ...]) -> Robot:
    plain = build_robot(name, {})
    known = plain.geometry.dimensions()
    if preset and preset not in ROBOTS[name].presets:
        raise GeometryError(f"{name} has no preset {preset}; choose one of {', '.join(ROBOTS[name].presets)}.")
    changed = {key: value / DISPLAY[known[key].unit][0] if key in known else value for key, value in geometry}
    return build_robot(name, {**ROBOTS[name].presets.get(preset, {}), **changed})


def pose_units(robot: Robot) -> tuple[str, ...]:
    """`m` or `rad` of each pose coordinate."""
    return ("m", "m", "m", "rad")[: robot.dof]


def pose_of(robot: Robot, pose: Mapping[str, float], kind: str = "pose") -> list[float]:
    """(dof,) in metres and radians from a table in mm and deg (or rates of them); what is not named is 0."""
    for name in pose:
        if name not in robot.pose_names:
            raise ValueError(f"a {kind} of {robot.name} has {', '.join(robot.pose_names)}, not {name}.")
    units = pose_units(robot)
    return [pose.get(name, 0.0) / DISPLAY[unit][0] for name, unit in zip(robot.pose_names, units, strict=True)]


def joints_of(robot: Robot, joints: Mapping[str, float]) -> list[float]:
    """(n,) in metres and radians from a table in mm or deg; all of them have to be named."""
    if set(joints) != set(robot.joint_names):
        raise ValueError(f"the joints of {robot.name} are {', '.join(robot.joint_names)}: give them all.")
    return [joints[name] / DISPLAY[robot.joint_unit][0] for name in robot.joint_names]


def shown(value: float, unit: str, per: str = "") -> Quantity:
    """A value in metres or radians as people read it. `per`: "/s" for a speed."""
    factor, read = DISPLAY[unit]
    return Quantity(float(value) * factor, read + per)
