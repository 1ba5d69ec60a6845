"""The sheet of paper under the robot, the planned drawing on it, and the handle that moves it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import viser
from numpy.typing import NDArray

from app.drawing.toolpath import Placement
from app.robots.parts import machine_of
from app.signal import Signal
from app.ui import theme
from app.ui.drawing.ink import along
from app.ui.session import Session
from app.ui.viser_adapter import NodeStream, silence_gizmo_echo

THICKNESS_M = 0.0015
EDGE_M = 0.0008
"""Width of the border around the paper."""

LAYER_M = 0.0002
"""Between paper and plan, so that neither shines through; the ink lies higher."""

PLAN_WIDTH_M = 0.0005
SHADOW = 0.15

HANDLE_M = 0.12
FARTHEST_M = 1.0
"""A sheet dragged farther away is laid down here."""


class SheetView:
    """`/robot/sheet` with paper and plan, and `/robot/sheet_handle` while it is being placed. Hidden at first.

    The drawn tip of some tools hangs below the pose's point, so the paper is drawn as much below its height.
    """

    def __init__(self, client: viser.ClientHandle, session: Session) -> None:
        self.moved: Signal[Placement] = Signal()
        """While the handle is dragged."""
        self.released: Signal[Placement] = Signal()
        """When it is let go."""
        self._client = client
        self._session = session
        self._stream = NodeStream(client)
        self._placement = Placement(0.0)
        self._shown = self._placing = self._dragged = False
        scene = client.scene
        self._frame = scene.add_frame("/robot/sheet", show_axes=False, visible=False)
        # a grid without lines: unlike a lit surface it is white in any light, and still receives shadows
        self._paper = scene.add_grid(
            "/robot/sheet/paper",
            cell_thickness=0.0,
            section_thickness=0.0,
            fade_distance=1e6,
            shadow_opacity=SHADOW,
            plane_color=theme.PAPER,
            plane_opacity=1.0,
        )
        self._edge = scene.add_box(
            "/robot/sheet/edge",
            theme.PAPER_EDGE,
            cast_shadow=False,  # it would fall on the paper
            receive_shadow=False,
            position=(0.0, 0.0, -0.5 * THICKNESS_M - LAYER_M),
        )
        self._plan: viser.LineSegmentsHandle | None = None
        self._handle = scene.add_transform_controls(
            "/robot/sheet_handle", HANDLE_M, active_axes=(True, True, False), depth_test=False, visible=False
        )
        self._handle.on_update(self._on_handle)
        silence_gizmo_echo(self._handle)

    def visible(self, on: bool) -> None:
        """Show or hide the sheet with all that lies on it."""
        self._shown = self._frame.visible = on
        self._show_handle()

    @property
    def middle(self) -> tuple[float, float, float]:
        """Of the sheet as it is drawn, m."""
        x, y = self._placement.centre_m
        return x, y, self._placement.height_m + machine_of(self._session.robot).tool_tip

    def placing(self, on: bool) -> None:
        """Show the handle; the caller hides the robot's own (`Gizmo.visible`) meanwhile."""
        self._placing = on
        self._show_handle()

    def place(self, placement: Placement, sheet_mm: tuple[float, float]) -> None:
        """Lay down a sheet of this width and height."""
        width, height = (1e-3 * side for side in sheet_mm)
        self._paper.width, self._paper.height = width, height
        self._edge.dimensions = (width + 2 * EDGE_M, height + 2 * EDGE_M, THICKNESS_M)
        self._lay(placement)

    def show_plan(self, strokes_mm: Sequence[NDArray[np.float64]], outside: Sequence[NDArray[np.bool_]]) -> None:
        """Draw the planned strokes, (n, 2) sheet mm each; `outside` (n,) of each marks vertices out of reach."""
        if self._plan is not None:
            self._plan.remove()
            self._plan = None
        if strokes_mm:
            segments, colors = plan_lines(strokes_mm, outside)
            self._plan = self._client.scene.add_line_segments(
                "/robot/sheet/plan", segments, colors, thickness=PLAN_WIDTH_M
            )

    def _show_handle(self) -> None:
        self._handle.visible = self._shown and self._placing

    def _lay(self, placement: Placement) -> None:
        """Move the sheet, and the handle unless it is in hand."""
        self._placement = placement
        position = self.middle
        wxyz = math.cos(placement.rotation_rad / 2), 0.0, 0.0, math.sin(placement.rotation_rad / 2)
        self._stream.move(self._frame, position, wxyz)
        if not self._dragged:
            self._stream.move(self._handle, position, wxyz)

    async def _on_handle(self, event: viser.TransformControlsEvent) -> None:
        self._dragged = event.phase != "end"
        if event.phase == "update":
            self._lay(self._wished(event.target))
            self.moved.emit(self._placement)
        elif event.phase == "end":
            self._lay(self._placement)
            self.released.emit(self._placement)
        self._stream.flush()

    def _wished(self, handle: viser.TransformControlsHandle) -> Placement:
        x, y = (min(max(float(v), -FARTHEST_M), FARTHEST_M) for v in handle.position[:2])
        w, _, _, z = handle.wxyz.tolist()
        return Placement(self._placement.height_m, (x, y), math.remainder(2.0 * math.atan2(z, w), math.tau))


def plan_lines(
    strokes_mm: Sequence[NDArray[np.float64]], outside: Sequence[NDArray[np.bool_]]
) -> tuple[NDArray[np.float32], NDArray[np.uint8]]:
    """Segments (s, 2, 3), m, and their colours: (s, 2, 3), or (3,) where all is within reach."""
    segments, begin = along([1e-3 * stroke for stroke in strokes_mm], LAYER_M, gaps=False)
    beyond = np.concatenate(outside)
    if not beyond.any():
        return segments, np.array(theme.PLAN, dtype=np.uint8)
    wrong = beyond[begin] | beyond[begin + 1]
    return segments, theme.line_colors(wrong, theme.WARNING, theme.PLAN)
