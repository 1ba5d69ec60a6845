"""The two belts of the five-bar's work cycle, with the items that ride on them and in the gripper."""

from __future__ import annotations

import numpy as np
import viser

from app.motion import CycleMotion
from app.robots.fivebar import FiveBar
from app.robots.parts import MATERIALS, conveyors
from app.robots.parts.part import Part
from app.ui.motion.belts_layout import MARKS, MOST_ITEMS, STRAIGHT, Array, Layout, item_places, layout_for, mark_places
from app.ui.motion.desk import MotionDesk
from app.ui.playback import instant_at

NODE = "/robot/belts"
HANDLE_SHARE, HIGHEST_HANDLE = 0.7, 0.010
"""Of the stroke, so that the gripper passes above it; and m."""

CARDBOARD = (201, 160, 112)
HANDLE = (70, 78, 90)
TURNED = (0.0, 0.0, 0.0, 1.0)


class BeltsView:
    """`/robot/belts` and everything under it: there while a work cycle is the motion, or a run of one is played."""

    def __init__(self, scene: viser.SceneApi, desk: MotionDesk) -> None:
        self._scene = scene
        self._desk = desk
        self._frame = scene.add_frame(NODE, show_axes=False, visible=False)
        self._front = False
        self._layout: Layout | None = None
        self._fixed: list[viser.BatchedMeshHandle] = []
        self._riding: dict[str, viser.BatchedMeshHandle] = {}
        self._items_of: Array | CycleMotion | None = None
        for signal in (desk.planned, desk.settings_changed, desk.playback.loaded):
            signal.connect(lambda _: self._arrange())
        desk.playback.moved.connect(lambda _: self._move())
        self._arrange()

    def visible(self, front: bool) -> None:
        """Whether the tab is in front."""
        self._front = front
        self._show()

    def close(self) -> None:
        self._front = False
        self._frame.remove()

    def _arrange(self) -> None:
        """What rides has changed, and perhaps where the belts are."""
        source = self._items_of = self._what_rides()
        if source is not None:
            robot = self._desk.robot
            assert isinstance(robot, FiveBar)
            items = source if isinstance(source, np.ndarray) else source.items_at(source.t, source.pose)
            layout = layout_for(items, robot)
            if layout != self._layout:
                self._build(layout)
        self._show()

    def _what_rides(self) -> Array | CycleMotion | None:
        """The items of a simulated run that has some, else those of the planned cycle."""
        desk = self._desk
        if not isinstance(desk.robot, FiveBar):
            return None
        run_items = getattr(desk.playback.run, "items", None)
        if run_items is not None:
            return run_items
        return desk.motion if desk.cycling and isinstance(desk.motion, CycleMotion) else None

    def _show(self) -> None:
        shown = self._front and self._items_of is not None
        if self._frame.visible != shown:
            self._frame.visible = shown
        self._move()

    def _build(self, layout: Layout) -> None:
        for node in (*self._fixed, *self._riding.values()):
            node.remove()
        self._layout = layout
        height, hood = layout.belt_top - layout.floor, layout.hood - layout.middle
        middles = [(x, layout.middle, layout.belt_top) for x in layout.x]
        hoods = [(x, layout.hood, layout.belt_top) for x in layout.x]
        tall = conveyors.ITEM[2] + HIGHEST_HANDLE + 0.006
        self._fixed = [
            self._add(Part("frame", "aluminium", conveyors.frame, (layout.length, height, hood)), middles),
            self._add(Part("drive", "motor", conveyors.drive, (layout.length, height)), middles),
            self._add(Part("belt", "rubber", conveyors.belt, (layout.length,)), middles),
            self._add(Part("hood", "housing", conveyors.hood, (tall,)), hoods),
        ]
        marks = Part("mark", "accent", conveyors.chevron, (), casts_shadow=False)
        self._riding = {
            "marks": self._add(marks, [(0.0, 0.0, 0.0)] * 2 * MARKS),
            "items": self._add(Part("item", "", conveyors.item, ()), [(0.0, 0.0, 0.0)] * MOST_ITEMS, CARDBOARD),
            "handles": self._add(Part("handle", "", conveyors.handle, ()), [(0.0, 0.0, 0.0)] * MOST_ITEMS, HANDLE),
        }
        self._riding["marks"].batched_wxyzs = np.array([STRAIGHT] * MARKS + [TURNED] * MARKS, dtype=np.float32)

    def _add(
        self, part: Part, places: list[tuple[float, float, float]], color: tuple[int, int, int] | None = None
    ) -> viser.BatchedMeshHandle:
        return self._scene.add_batched_meshes_simple(
            f"{NODE}/{part.name}",
            *part.arrays(),
            batched_positions=np.array(places, dtype=np.float32),
            batched_wxyzs=np.array([STRAIGHT] * len(places), dtype=np.float32),
            batched_scales=np.ones((len(places), 3), dtype=np.float32),
            batched_colors=color or MATERIALS[part.material].color,
            lod="off",
            cast_shadow=part.casts_shadow,
        )

    def _move(self) -> None:
        """Put marks and items where they are at the time shown."""
        layout, source = self._layout, self._items_of
        if layout is None or source is None or not self._front:
            return
        time_s = self._desk.playback.time_s
        cycle = source.settings if isinstance(source, CycleMotion) else self._desk.cycle
        positions, scales = mark_places(layout, cycle.belt_speed_m_s * time_s)
        self._riding["marks"].batched_positions, self._riding["marks"].batched_scales = positions, scales
        items = self._items_now(source, time_s)[:MOST_ITEMS]
        positions, wxyzs, seen = item_places(layout, items)
        handle = min(HANDLE_SHARE * -layout.item_top, HIGHEST_HANDLE)
        for name, scale in (("items", (1.0, 1.0, 1.0)), ("handles", (1.0, 1.0, handle))):
            node = self._riding[name]
            node.batched_positions, node.batched_wxyzs = positions, wxyzs
            node.batched_scales = (seen[:, None] * np.array(scale)).astype(np.float32)

    def _items_now(self, source: Array | CycleMotion, time_s: float) -> Array:
        """(m, 4) x, y, z and turn of the items."""
        run = self._desk.playback.run
        played = run if run is not None else self._desk.motion
        assert played is not None
        k = instant_at(played.t, time_s)
        return source[k] if isinstance(source, np.ndarray) else source.items_at(time_s, played.pose[k])
