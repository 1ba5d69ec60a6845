"""The virtual prototype of a robot: a MuJoCo model made from its dimensions and masses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from app.robots.dynamics.inertia import INERTIA, Inertia
from app.robots.limits import drive_limits
from app.robots.robot import Array, Robot
from app.simulation.prototype.deltas import add_delta3, add_linear, add_par4
from app.simulation.prototype.draft import Draft
from app.simulation.prototype.drawn import add_parts
from app.simulation.prototype.fivebar import add_fivebar
from app.simulation.prototype.items import Item, add_items

BUILDERS: dict[str, Callable[[Draft, Any, Any, Sequence[float]], None]] = {
    "par4": add_par4,
    "delta3": add_delta3,
    "linear": add_linear,
    "fivebar": add_fivebar,
}
PAYLOAD = "payload"
"""Name of the body that weighs as much as what the tool carries."""


def draft(
    robot: Robot,
    inertia: Inertia | None = None,
    pose: Sequence[float] | Array | None = None,
    items: Sequence[Item] = (),
) -> Draft:
    """The model before it is written, standing in a pose (dof,) (home).

    Raises:
        ValueError: for a pose in which some loop cannot close.
    """
    inertia = INERTIA[robot.name] if inertia is None else inertia
    pose = [float(value) for value in (robot.home if pose is None else pose)]
    if any(q != q for q in robot.solve(*pose)):
        raise ValueError(f"The {robot.title} cannot be built in this pose: {robot.reach(pose).reason}")
    model = Draft(robot.name)
    BUILDERS[robot.name](model, robot, inertia, pose)
    model.body(PAYLOAD, "tool", model.frames["tool"], mass=inertia.payload)
    model.site("tool", "tool")
    for joint, effort in zip(robot.joint_names, drive_limits(robot).effort.tolist(), strict=True):
        model.motor(joint, effort)
    add_items(model, items)
    return model


def mjcf(
    robot: Robot,
    inertia: Inertia | None = None,
    *,
    pose: Sequence[float] | Array | None = None,
    meshes: bool = False,
    items: Sequence[Item] = (),
) -> str:
    """A robot as MJCF, standing in a pose (dof,) (home), its masses those of `INERTIA` unless given.

    With `meshes` it shows the drawn parts, whose files `export` writes.
    """
    model = draft(robot, inertia, pose, items)
    if meshes:
        add_parts(model, robot, [float(value) for value in (robot.home if pose is None else pose)])
    return model.xml()
