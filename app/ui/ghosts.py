"""The robot's other selves, translucent: the pose held with other elbows, the joints assembled another way."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import viser

from app.robots import Robot
from app.robots.parts import Body, Machine, Part, Placement, machine_of
from app.ui.pacing import Paced
from app.ui.robot_view import part_color
from app.ui.session import Session
from app.ui.shape_cache import ShapeCache

REFRESH_S = 0.1
OPACITY = 0.28

Configuration = tuple[Sequence[float], Sequence[float]]
"""Pose and joints."""


class Ghosts:
    """One batched node a moving part, with the copies of all ghosts."""

    def __init__(self, client: viser.ClientHandle, session: Session, shapes: ShapeCache) -> None:
        self._scene = client.scene
        self._session = session
        self._shapes = shapes
        self._machine: Machine | None = None
        self._nodes: dict[str, viser.BatchedMeshHandle] = {}
        self._pace = Paced(self._refresh, REFRESH_S)
        session.robot_changed.connect(self._change_machine)
        session.view_changed.connect(lambda _: self._request())
        session.stance_changed.connect(lambda _: self._request())
        self._change_machine(session.robot)

    def close(self) -> None:
        self._pace.cancel()

    def _change_machine(self, robot: Robot) -> None:
        self._clear()
        self._machine = machine_of(robot)
        self._request()

    def _request(self) -> None:
        if self._session.view.elbows or self._session.view.assemblies or self._nodes:
            self._pace.request()

    def _refresh(self) -> None:
        ghosts = configurations(self._session)
        if not ghosts or self._machine is None:
            self._clear()
            return
        placements = [self._machine.place(*ghost) for ghost in ghosts]
        for body in self._machine.bodies:
            if body.fixed is None or body.frame == "tool":
                copies = [
                    in_base_frame(self._machine, body, pose, placement.get(body.name))
                    for (pose, _), placement in zip(ghosts, placements, strict=True)
                ]
                for part in body.parts:
                    self._show(body, part, _together(copies), len(ghosts))

    def _show(self, body: Body, part: Part, place: Placement, ghosts: int) -> None:
        node = self._nodes.get(part.name)
        if node is not None and len(node.batched_positions) == len(place.positions):
            node.batched_positions, node.batched_wxyzs = place
            return
        arrays = self._shapes.get(part)
        if arrays is None:
            return
        colors = [part_color(part, leg) for leg in body.legs] * ghosts
        self._nodes[part.name] = self._scene.add_batched_meshes_simple(
            f"/robot/ghosts/{part.name}",
            *arrays,
            batched_positions=place.positions,
            batched_wxyzs=place.wxyzs,
            batched_colors=np.array(colors, dtype=np.uint8),
            opacity=OPACITY,
            lod="off",
            cast_shadow=False,
            receive_shadow=False,
        )

    def _clear(self) -> None:
        for node in self._nodes.values():
            node.remove()
        self._nodes = {}


def configurations(session: Session) -> list[Configuration]:
    """Pose and joints of every ghost that the view options ask for."""
    robot, stance, view = session.robot, session.stance, session.view
    ghosts: list[Configuration] = []
    if view.elbows:
        ghosts += [(stance.pose, mode) for mode in robot.working_modes(stance.pose)[1:].tolist()]
    if view.assemblies:
        modes = robot.assemblies(stance.joints)
        ghosts += [(mode.pose.tolist(), stance.joints) for mode in modes if not mode.valid]
    return ghosts


def in_base_frame(machine: Machine, body: Body, pose: Sequence[float], place: Placement | None) -> Placement:
    """Where a body of a robot in some pose is. Bodies in the tool's frame stand in its origin."""
    if place is None:
        position, rotation = machine.tool_frame(pose)
        return Placement(np.array([position], dtype=np.float32), np.array([rotation], dtype=np.float32))
    if body.frame == "platform":
        return Placement(place.positions + np.array(pose[:3], dtype=np.float32), place.wxyzs)
    return place


def _together(placements: list[Placement]) -> Placement:
    return Placement(
        np.concatenate([place.positions for place in placements]),
        np.concatenate([place.wxyzs for place in placements]),
    )
