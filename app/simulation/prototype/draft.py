"""A MuJoCo model while it is written: bodies placed in world coordinates, joints, loops and motors, then MJCF."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from app.simulation.prototype.frames import ORIGIN, Frame

STEP_S = 0.00025
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
STIFFNESS_S = 0.0005
STIFF = {"solref": f"{STIFFNESS_S} 1", "solimp": "0.9999 0.9999 0.001"}
"""How hard loops are held together: like critically damped springs of this time constant. MuJoCo's defaults leave
gaps of half a millimetre and accelerations that are wrong by a quarter."""
POINT = 1e-14
"""kg m^2, an inertia that stands for none: MuJoCo refuses moving bodies without one."""


class Draft:
    """Bodies stand where the robot holds them in one pose, so that every loop is closed in MuJoCo's `qpos0`.

    A joint named after a coordinate of the robot reads that coordinate: its `ref` is the value in that pose.
    """

    def __init__(self, name: str) -> None:
        self.root = Element("mujoco", model=name)
        self.compiler = SubElement(self.root, "compiler", angle="radian", inertiafromgeom="false")
        option = SubElement(self.root, "option", timestep=text(STEP_S), gravity="0 0 -9.81", jacobian="dense")
        SubElement(option, "flag", contact="disable")
        SubElement(SubElement(self.root, "default"), "equality", STIFF)
        self.assets = SubElement(self.root, "asset")
        world = SubElement(self.root, "worldbody")
        self.equality = SubElement(self.root, "equality")
        self.tendons = SubElement(self.root, "tendon")
        self.actuators = SubElement(self.root, "actuator")
        self.bodies = {"world": world}
        self.frames = {"world": Frame()}

    def body(
        self,
        name: str,
        parent: str,
        frame: Frame,
        *,
        mass: float = 0.0,
        inertia: Sequence[float] = (0.0, 0.0, 0.0),
        centre: Sequence[float] = ORIGIN,
    ) -> None:
        """Add a body at a frame in the world.

        Args:
            mass: kg; 0 for a body that only carries others.
            inertia: (3,) kg m^2 about its centre of mass, along its axes.
            centre: (3,) centre of mass in its frame, m.
        """
        local = frame.seen_from(self.frames[parent])
        body = SubElement(self.bodies[parent], "body", {"name": name, **placed(local)})
        if mass > 0.0:
            about = text(*(max(value, POINT) for value in inertia))
            SubElement(body, "inertial", mass=text(mass), pos=text(*centre), diaginertia=about)
        self.bodies[name], self.frames[name] = body, frame

    def joint(
        self,
        body: str,
        name: str,
        axis: Sequence[float],
        value: float = 0.0,
        *,
        kind: str = "hinge",
        armature: float = 0.0,
        at: Sequence[float] = ORIGIN,
    ) -> None:
        """Let a body turn about (or slide along) an axis of its frame; `value` is what it reads as placed."""
        more = {"pos": text(*at), "ref": text(value), "armature": text(armature)}
        more = {key: value for key, value in more.items() if value not in ("0", "0 0 0")}
        SubElement(self.bodies[body], "joint", {"name": name, "type": kind, "axis": text(*axis), **more})

    def free(self, body: str, names: Sequence[str], position: Sequence[float]) -> None:
        """Let a body move freely; its x, y and z have joints of their own, so that they can be read by name."""
        for axis, name, value in zip(AXES, names, position, strict=True):
            self.joint(body, name, axis, value, kind="slide")
        SubElement(self.bodies[body], "joint", name=f"{body}_turn", type="ball")

    def connect(self, first: str, second: str, anchor: Sequence[float]) -> None:
        """Close a loop: a point of the first body's frame stays where it is on the second."""
        names = {"name": f"{first}_{second}", "body1": first, "body2": second}
        SubElement(self.equality, "connect", names, anchor=text(*anchor))

    def hold_sum(self, name: str, terms: Iterable[tuple[str, float]]) -> None:
        """Keep a weighted sum of joints as it is: a fixed tendon of constant length."""
        tendon = SubElement(self.tendons, "fixed", name=name)
        for joint, weight in terms:
            SubElement(tendon, "joint", joint=joint, coef=text(weight))
        SubElement(self.equality, "tendon", name=name, tendon1=name)

    def motor(self, joint: str, effort: float) -> None:
        """Drive a joint, N m or N to either side."""
        SubElement(self.actuators, "motor", name=joint, joint=joint, ctrlrange=text(-effort, effort))

    def site(self, body: str, name: str, at: Sequence[float] = ORIGIN) -> None:
        """Mark a point of a body."""
        SubElement(self.bodies[body], "site", name=name, pos=text(*at), size="0.003", group="4")

    def xml(self) -> str:
        """The model as MJCF."""
        for section in list(self.root):
            if not len(section) and not section.attrib:
                self.root.remove(section)
        ElementTree.indent(self.root)
        return ElementTree.tostring(self.root, encoding="unicode") + "\n"


def text(*values: float) -> str:
    """Numbers as MJCF writes them, every digit kept."""
    return " ".join(f"{value:.0f}" if value == round(value) else repr(float(value)) for value in values)


def placed(frame: Frame) -> dict[str, str]:
    """Attributes that put a body or geom at a frame."""
    return {"pos": text(*frame.position), "quat": text(*frame.wxyz)}
