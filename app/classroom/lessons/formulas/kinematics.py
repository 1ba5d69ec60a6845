"""Poses, joints, Jacobian and conditioning of a robot. Poses are tables such as { x = 0, y = 20, z = -320 }."""

from __future__ import annotations

from typing import Any

import numpy as np

from app.classroom.lessons.formulas.quantities import DISPLAY, joints_of, pose_of, pose_units, robot_of, shown
from app.classroom.lessons.formulas.registry import Quantity, formula

Table = dict[str, float]
NOTHING: Any = {}


@formula("inverse")
def inverse(robot: str, pose: Table, preset: str = "", geometry: Table = NOTHING) -> dict[str, Quantity]:
    """Each joint (q1, ... in deg; d1, ... in mm) of a pose."""
    machine = robot_of(robot, preset, geometry)
    joints = machine.inverse(pose_of(machine, pose))
    return {name: shown(q, machine.joint_unit) for name, q in zip(machine.joint_names, joints, strict=True)}


@formula("inverse_other")
def inverse_other(
    robot: str, pose: Table, mode: int = 1, preset: str = "", geometry: Table = NOTHING
) -> dict[str, Quantity]:
    """Each joint with elbows on the other side: `mode` counts the other solutions from 1."""
    machine = robot_of(robot, preset, geometry)
    modes = machine.working_modes(pose_of(machine, pose))
    if not 1 <= mode < len(modes):
        raise ValueError(f"this pose has {max(0, len(modes) - 1)} other solutions.")
    return {name: shown(q, machine.joint_unit) for name, q in zip(machine.joint_names, modes[mode], strict=True)}


@formula("forward")
def forward(robot: str, joints: Table, preset: str = "", geometry: Table = NOTHING) -> dict[str, Quantity]:
    """Each pose coordinate (mm, deg) of all joints, given as a table."""
    machine = robot_of(robot, preset, geometry)
    pose = machine.forward(joints_of(machine, joints))
    units = pose_units(machine)
    return {name: shown(p, unit) for name, p, unit in zip(machine.pose_names, pose, units, strict=True)}


@formula("assemblies")
def assemblies(robot: str, joints: Table, preset: str = "", geometry: Table = NOTHING) -> int:
    """Number of ways in which the platform can be assembled for these joints."""
    machine = robot_of(robot, preset, geometry)
    return len(machine.assemblies(joints_of(machine, joints)))


@formula("assembly")
def assembly(robot: str, joints: Table, mode: int, preset: str = "", geometry: Table = NOTHING) -> dict[str, Quantity]:
    """Each pose coordinate (mm, deg) of one assembly; `mode` counts from 1, and 1 is that of the real machine."""
    machine = robot_of(robot, preset, geometry)
    found = machine.assemblies(joints_of(machine, joints))
    if not 1 <= mode <= len(found):
        raise ValueError(f"these joints have {len(found)} assemblies.")
    places = zip(machine.pose_names, found[mode - 1].pose, pose_units(machine), strict=True)
    return {name: shown(p, unit) for name, p, unit in places}


@formula("conditioning")
def conditioning(robot: str, pose: Table, preset: str = "", geometry: Table = NOTHING) -> float:
    """Condition number of the scaled Jacobian, 1 at best."""
    machine = robot_of(robot, preset, geometry)
    return float(machine.conditioning(pose_of(machine, pose)))


@formula("jacobian")
def jacobian(
    robot: str, pose: Table, joint: str, coordinate: str, preset: str = "", geometry: Table = NOTHING
) -> Quantity:
    """One entry: rate of a joint per rate of a pose coordinate, say deg/s of q1 per mm/s of x."""
    machine = robot_of(robot, preset, geometry)
    row, column = machine.joint_names.index(joint), machine.pose_names.index(coordinate)
    (up, above), (down, below) = DISPLAY[machine.joint_unit], DISPLAY[pose_units(machine)[column]]
    entry = machine.jacobian(pose_of(machine, pose))[row, column] * up / down
    return Quantity(float(entry), "" if above == below else f"{above}/{below}")


@formula("joint_speed")
def joint_speed(
    robot: str, pose: Table, velocity: Table, preset: str = "", geometry: Table = NOTHING
) -> dict[str, Quantity]:
    """Speed of each joint (deg/s or mm/s) at a velocity of the tool (mm/s, deg/s)."""
    machine = robot_of(robot, preset, geometry)
    rates = machine.jacobian(pose_of(machine, pose)) @ np.array(pose_of(machine, velocity, "velocity"))
    return {name: shown(q, machine.joint_unit, "/s") for name, q in zip(machine.joint_names, rates, strict=True)}


@formula("dimension")
def dimension(robot: str, name: str, preset: str = "") -> Quantity:
    """A dimension of a robot by its symbol, mm or deg."""
    machine = robot_of(robot, preset)
    known = machine.geometry.dimensions()
    if name not in known:
        raise ValueError(f"{robot} has the dimensions {', '.join(known)}, not {name}.")
    return shown(getattr(machine.geometry, name), known[name].unit)


@formula("home")
def home(robot: str, preset: str = "") -> dict[str, Quantity]:
    """Each coordinate of the robot's home pose, mm or deg."""
    machine = robot_of(robot, preset)
    units = pose_units(machine)
    return {name: shown(p, unit) for name, p, unit in zip(machine.pose_names, machine.home, units, strict=True)}


@formula("joint_limit")
def joint_limit(robot: str, joint: str, preset: str = "") -> dict[str, Quantity]:
    """`low` and `high` of a joint, deg or mm."""
    machine = robot_of(robot, preset)
    low, high = machine.joint_limits[machine.joint_names.index(joint)]
    return {"low": shown(low, machine.joint_unit), "high": shown(high, machine.joint_unit)}
