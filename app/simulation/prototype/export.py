"""A robot as a file that MuJoCo's own viewer opens, with its shapes beside it."""

from __future__ import annotations

from pathlib import Path
from xml.etree.ElementTree import SubElement

from app.robots.dynamics import dynamics_of
from app.robots.dynamics.inertia import Inertia
from app.robots.robot import Robot
from app.simulation.plant import FRICTION
from app.simulation.prototype.draft import Draft, text
from app.simulation.prototype.drawn import add_parts, write_parts
from app.simulation.prototype.model import draft


def export(robot: Robot, path: Path, inertia: Inertia | None = None) -> list[Path]:
    """Write `path` (MJCF) and a folder of meshes beside it; returns both.

    The plant's model, with the stops and the friction of the drives added, and a keyframe `home` in which the
    motors carry the robot's weight.

    Raises:
        OSError: where that cannot be done.
    """
    folder = path.with_name(f"{path.stem}_meshes")
    pose = robot.home.tolist()
    model = draft(robot, inertia, pose)
    parts = add_parts(model, robot, pose, folder.name)
    _add_stops_and_friction(model, robot)
    weight = dynamics_of(robot, inertia).gravity(robot.home, space="joint")
    SubElement(SubElement(model.root, "keyframe"), "key", name="home", ctrl=text(*weight.tolist()))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(model.xml(), encoding="utf-8")
    write_parts(parts, folder)
    return [path, folder]


def _add_stops_and_friction(model: Draft, robot: Robot) -> None:
    friction = FRICTION[robot.name]
    joints = {joint.get("name"): joint for joint in model.root.iter("joint")}
    values = zip(robot.joint_names, robot.joint_limits.tolist(), friction.coulomb, friction.viscous, strict=True)
    for name, (low, high), coulomb, viscous in values:
        joints[name].attrib.update(range=text(low, high), damping=text(viscous), frictionloss=text(coulomb))
