"""Translucent copies of a machine, each in a pose of its own: one batched node a moving part."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import viser

from app.robots.parts import Body, Machine, Part, Placement
from app.ui import theme
from app.ui.shape_cache import ShapeCache

Configuration = tuple[Sequence[float], Sequence[float]]
"""Pose and joints."""

Paint = Callable[[Part, int | None], theme.Rgb]
"""The colour of a part's copy that belongs to a leg, counted from 0, or to none."""


class GhostNodes:
    """The copies below one scene node. A part whose shape is not known yet is left out."""

    def __init__(self, scene: viser.SceneApi, shapes: ShapeCache, root: str, paint: Paint, opacity: float) -> None:
        self._scene = scene
        self._shapes = shapes
        self._root = root
        self._paint = paint
        self._opacity = opacity
        self._nodes: dict[str, viser.BatchedMeshHandle] = {}
        self._tints: tuple[theme.Rgb, ...] = ()

    @property
    def shown(self) -> bool:
        return bool(self._nodes)

    def show(self, machine: Machine, ghosts: Sequence[Configuration], tints: Sequence[theme.Rgb] | None = None) -> None:
        """One copy of the machine for every configuration; with tints, each wholly in a colour of its own."""
        if tuple(tints or ()) != self._tints:
            self.clear()
            self._tints = tuple(tints or ())
        placements = [machine.place(*ghost) for ghost in ghosts]
        for body in machine.bodies:
            if body.fixed is None or body.frame == "tool":
                copies = [
                    in_base_frame(machine, body, pose, placement.get(body.name))
                    for (pose, _), placement in zip(ghosts, placements, strict=True)
                ]
                for part in body.parts:
                    self._show(body, part, _together(copies), len(ghosts))

    def clear(self) -> None:
        for node in self._nodes.values():
            node.remove()
        self._nodes = {}

    def _show(self, body: Body, part: Part, place: Placement, ghosts: int) -> None:
        node = self._nodes.get(part.name)
        if node is not None and len(node.batched_positions) == len(place.positions):
            node.batched_positions, node.batched_wxyzs = place
            return
        arrays = self._shapes.get(part)
        if arrays is None:
            return
        colors = [self._paint(part, leg) for leg in body.legs] * ghosts
        if self._tints:
            colors = [tint for tint in self._tints for _ in body.legs]
        self._nodes[part.name] = self._scene.add_batched_meshes_simple(
            f"{self._root}/{part.name}",
            *arrays,
            batched_positions=place.positions,
            batched_wxyzs=place.wxyzs,
            batched_colors=np.array(colors, dtype=np.uint8),
            opacity=self._opacity,
            lod="off",
            cast_shadow=False,
            receive_shadow=False,
        )


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
