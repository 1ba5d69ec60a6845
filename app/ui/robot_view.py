"""The robot in 3-D: one batched node a part, all copies of a part moved by one message."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import viser
from numpy.typing import NDArray

from app.robots import Robot
from app.robots.parts import LEG, MATERIALS, Body, Machine, Part, Placement, machine_of
from app.robots.parts.shading import Arrays
from app.signal import Signal
from app.ui import theme
from app.ui.compute import Worker
from app.ui.jobs import part_arrays
from app.ui.shape_cache import ShapeCache
from app.ui.state import Stance, ViewOptions
from app.ui.viser_adapter import NodeStream

SEE_THROUGH = 0.35

PARENTS = {"base": "", "platform": "/platform", "tool": "/tool"}
"""Scene node, below the robot's own, that carries the bodies of each frame."""


class Shown(Protocol):
    """What there is to show: a session, or somebody else's robot."""

    robot_changed: Signal[Robot]
    stance_changed: Signal[Stance]
    view_changed: Signal[ViewOptions]
    robot: Robot
    stance: Stance
    view: ViewOptions


class RobotView:
    """`/robot`, or another node, and everything under it that belongs to the machine itself."""

    def __init__(
        self,
        client: viser.ClientHandle,
        session: Shown,
        stream: NodeStream,
        shapes: ShapeCache,
        worker: Worker,
        root: str = "/robot",
    ) -> None:
        self._scene = client.scene
        self._path = root
        self._session = session
        self._stream = stream
        self._shapes = shapes
        self._worker = worker
        self._nodes: dict[str, PartNode] = {}
        self._moving: list[PartNode] = []
        self._blocked: int | None = None
        self._robot: Robot | None = None
        self._machine: Machine | None = None
        self._tool_rotation: tuple[float, ...] | None = None
        self.root = client.scene.add_frame(root, show_axes=False)
        """Whatever hangs on it is hidden and removed with it."""
        self._platform = client.scene.add_frame(root + PARENTS["platform"], show_axes=False)
        self._tool = client.scene.add_frame(root + PARENTS["tool"], show_axes=False)
        session.robot_changed.connect(self._rebuild)
        session.stance_changed.connect(self.show)
        session.view_changed.connect(lambda _: self._see_through())
        self._rebuild(session.robot)

    def _rebuild(self, robot: Robot) -> None:
        """Show another robot, or the same one in other dimensions. Shapes that are not at hand come from a
        worker; until then the last machine stays."""
        machine = machine_of(robot)
        missing = tuple(part for part in machine.parts if self._shapes.get(part) is None)
        if missing:
            self._worker.request(lambda arrays: self._arrived(robot, machine, missing, arrays), part_arrays, missing)
        else:
            self._worker.cancel()
            self._draw(robot, machine)

    def _arrived(self, robot: Robot, machine: Machine, parts: tuple[Part, ...], shapes: list[Arrays]) -> None:
        for part, arrays in zip(parts, shapes, strict=True):
            self._shapes.put(part, arrays)
        self._draw(robot, machine)
        self._stream.flush()

    def _draw(self, robot: Robot, machine: Machine) -> None:
        self._robot, self._machine = robot, machine
        placements = machine.place(self._session.stance.pose, self._session.stance.joints)
        old, self._nodes = self._nodes, {}
        for body in machine.bodies:
            place = body.fixed if body.fixed is not None else placements[body.name]
            for part in body.parts:
                path = f"{self._path}{PARENTS[body.frame]}/{part.name}"
                node = old.pop(path, None)
                if node is None or (node.part, node.body.legs) != (part, body.legs):
                    arrays = self._shapes.get(part)
                    assert arrays is not None, f"the shape of {part.name} is missing"
                    node = PartNode(self._scene, path, body, part, arrays, place)
                node.body = body
                node.place(self._stream, place)
                self._nodes[path] = node
        for node in old.values():
            node.handle.remove()
        self._moving = [node for node in self._nodes.values() if node.body.fixed is None]
        self._see_through()
        self._paint(self._session.stance.blocked_leg)
        self.show(self._session.stance)

    def _paint(self, blocked: int | None) -> None:
        self._blocked = blocked
        for node in self._nodes.values():
            node.warn(self._stream, blocked)

    def _see_through(self) -> None:
        """Vectors run inside the parts, so these turn translucent while vectors are shown."""
        opacity = None if self._session.view.vectors_leg is None else SEE_THROUGH
        for node in self._nodes.values():
            if node.handle.opacity != opacity:
                node.handle.opacity = opacity

    def show(self, stance: Stance) -> None:
        """Move every part to where the kinematics says; one message a part, sent together."""
        if self._machine is None or self._robot is not self._session.robot:
            return
        placements = self._machine.place(stance.pose, stance.joints)
        for node in self._moving:
            node.place(self._stream, placements[node.body.name])
        if stance.blocked_leg != self._blocked:
            self._paint(stance.blocked_leg)
        position, rotation = self._machine.tool_frame(stance.pose)
        self._stream.move(self._platform, position)
        self._stream.move(self._tool, position, None if rotation == self._tool_rotation else rotation)
        self._tool_rotation = rotation


class PartNode:
    """The copies of one part on the screen of one client."""

    def __init__(
        self, scene: viser.SceneApi, path: str, body: Body, part: Part, arrays: Arrays, place: Placement
    ) -> None:
        self.body = body
        self.part = part
        self._wxyzs = place.wxyzs
        self._positions = place.positions
        self.handle = scene.add_batched_meshes_simple(
            path,
            *arrays,
            batched_positions=place.positions,
            batched_wxyzs=place.wxyzs,
            batched_colors=self._colors(None),
            lod="off",
            cast_shadow=part.casts_shadow,
        )

    def place(self, stream: NodeStream, place: Placement) -> None:
        """Move the copies; arrays that are the very same as before are not sent again."""
        if place.positions is self._positions and place.wxyzs is self._wxyzs:
            return
        stream.place(self.handle, place.positions, None if place.wxyzs is self._wxyzs else place.wxyzs)
        self._positions, self._wxyzs = place.positions, place.wxyzs

    def warn(self, stream: NodeStream, leg: int | None) -> None:
        """Paint the copies that belong to the leg which stops the robot."""
        if any(other is not None for other in self.body.legs):
            stream.place(self.handle, self._positions, colors=self._colors(leg))

    def _colors(self, blocked: int | None) -> NDArray[np.uint8]:
        return np.array([self._color(leg, blocked) for leg in self.body.legs], dtype=np.uint8)

    def _color(self, leg: int | None, blocked: int | None) -> theme.Rgb:
        if leg is not None and leg == blocked:
            return theme.WARNING
        return part_color(self.part, leg)


def part_color(part: Part, leg: int | None) -> theme.Rgb:
    """A part's own colour: that of its leg, or of its material."""
    if part.material == LEG and leg is not None:
        return theme.leg_color(leg)
    return MATERIALS[part.material].color
