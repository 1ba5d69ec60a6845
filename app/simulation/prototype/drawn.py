"""The robot's drawn parts on the bodies of its MuJoCo model: to be looked at, without mass and without contact."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import SubElement

from app.robots.fivebar import FiveBar
from app.robots.parts.machine import Machine
from app.robots.parts.machines import machine_of
from app.robots.parts.materials import MATERIALS
from app.robots.parts.part import LEG, Body, Part
from app.robots.robot import Robot
from app.simulation.prototype.draft import Draft, placed, text
from app.simulation.prototype.fivebar import add_wheels
from app.simulation.prototype.frames import Frame

LEG_COLORS = ((0, 114, 178), (230, 159, 0), (0, 158, 115), (204, 121, 167))
"""sRGB of legs 1 to 4, as on the page."""

PAIRS = tuple(f"rod{leg}{side}" for leg in (1, 2, 3, 4) for side in "ab")
ARMS = ("arm1", "arm2", "arm3", "arm4")
HOLDERS: dict[str, dict[str, tuple[str, ...]]] = {
    "par4": {
        "arms": ARMS,
        "rods": PAIRS,
        "bars": ("far_bar", "near_bar"),
        "links": ("link1", "link2"),
        "belts": ("near_bar",),
        "tool": ("tool",),
    },
    "delta3": {"arms": ARMS, "rods": PAIRS, "platform": ("platform",)},
    "linear": {"carriages": ("carriage1", "carriage2", "carriage3"), "rods": PAIRS, "platform": ("platform",)},
    "fivebar": {
        "proximal": ("proximal1", "proximal2"),
        "distal": ("distal1", "distal2"),
        "wheels": ("motor_wheel1", "elbow_wheel1", "elbow_wheel1", "nut4")
        + ("motor_wheel2", "elbow_wheel2", "elbow_wheel2", "nut3"),
        "tool": ("tool",),
    },
}
"""Robot -> drawn body -> the body of the model that each of its copies rides on. All others stand still."""


class Copy(NamedTuple):
    """One copy of a drawn body."""

    body: Body
    number: int
    """Counted from 0."""
    frame: Frame
    """In the world."""


def copies(machine: Machine, pose: Sequence[float], joints: Sequence[float]) -> Iterator[Copy]:
    """Every copy of every drawn body, where the machine puts it in a pose (dof,) with joints (n,)."""
    moving = machine.place(pose, joints)
    tool = Frame(*machine.tool_frame(pose))
    inside = {"base": Frame(), "platform": Frame(tool.position), "tool": tool}
    for body in machine.bodies:
        placement = moving[body.name] if body.fixed is None else body.fixed
        for k, (position, wxyz) in enumerate(zip(placement.positions.tolist(), placement.wxyzs.tolist(), strict=True)):
            yield Copy(body, k, Frame(tuple(position), tuple(wxyz)).inside(inside[body.frame]))


def add_parts(draft: Draft, robot: Robot, pose: Sequence[float], folder: str = "") -> list[Part]:
    """Hang the parts on a model that stands in a pose (dof,); returns those whose files it will look for in a
    folder beside it, `<robot>_meshes` unless named."""
    draft.compiler.set("meshdir", folder or f"{robot.name}_meshes")
    if isinstance(robot, FiveBar):
        add_wheels(draft, robot, pose)
    machine = machine_of(robot)
    parts = machine.parts
    for part in parts:
        SubElement(draft.assets, "mesh", name=part.name, file=file_of(part), inertia="shell")
    for name, color in palette():
        rgba = text(*(value / 255.0 for value in color), 1.0)
        SubElement(draft.assets, "material", name=name, rgba=rgba, specular="0.3", shininess="0.4")
    for copy in copies(machine, pose, robot.solve(*pose)):
        holder = HOLDERS[robot.name].get(copy.body.name, ("world",) * len(copy.body.legs))[copy.number]
        _add_copy(draft, holder, copy)
    _add_daylight(draft)
    return list(parts)


def _add_daylight(draft: Draft) -> None:
    """A bright sky and light from the eye and from above: MuJoCo's own scene is black."""
    visual = SubElement(draft.root, "visual")
    SubElement(visual, "headlight", ambient="0.45 0.45 0.45", diffuse="0.45 0.45 0.45", specular="0.1 0.1 0.1")
    SubElement(visual, "global", azimuth="60", elevation="-20", offwidth="1280", offheight="960")
    sky = {"type": "skybox", "builtin": "gradient", "rgb1": "0.97 0.98 1", "rgb2": "0.72 0.76 0.82"}
    SubElement(draft.assets, "texture", sky, name="sky", width="64", height="384")
    sun = {"type": "directional", "dir": "0.3 0.4 -1", "diffuse": "0.4 0.4 0.4", "castshadow": "false"}
    SubElement(draft.bodies["world"], "light", sun, pos="0 0 3")


def _add_copy(draft: Draft, holder: str, copy: Copy) -> None:
    place = placed(copy.frame.seen_from(draft.frames[holder]))
    leg = copy.body.legs[copy.number]
    for part in copy.body.parts:
        material = f"leg{(leg or 0) + 1}" if part.material == LEG else part.material
        look = {"mesh": part.name, "material": material, "contype": "0", "conaffinity": "0", "mass": "0", "group": "2"}
        SubElement(draft.bodies[holder], "geom", {"name": geom_of(part, copy.number), "type": "mesh", **look, **place})


def geom_of(part: Part, number: int) -> str:
    """Name of the geom that shows a copy of a part."""
    return f"{part.name}_{number + 1}"


def palette() -> list[tuple[str, tuple[int, int, int]]]:
    """Name and sRGB colour of every material, the legs' included."""
    legs = [(f"leg{k + 1}", color) for k, color in enumerate(LEG_COLORS)]
    return [(name, material.color) for name, material in MATERIALS.items()] + legs


def file_of(part: Part) -> str:
    """Name of a part's file."""
    return f"{part.name}.stl"


def write_parts(parts: Sequence[Part], folder: Path) -> None:
    """Write the parts as STL files into a folder, metres.

    Raises:
        OSError: where that cannot be done.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for part in parts:
        stl = part.mesh().export(file_type="stl")
        assert isinstance(stl, bytes)
        (folder / file_of(part)).write_bytes(stl)
