"""A map in 3-D: a coloured sheet at the height of its slice, the line of the limit, and the value at the tool."""

from __future__ import annotations

import numpy as np
import viser

from app.ui import theme
from app.ui.motion.map_desk import MapDesk
from app.ui.motion.map_picture import MapPicture
from app.ui.panels.motion.map_texts import with_unit

NODE = "/robot/map"
MARK_RADIUS_M = 0.005
LIFT_M = 0.0008
"""Of the line above the sheet, so that neither shines through."""


class MapView:
    """`/robot/map`. The sheet is an image: its colours are those of the colour scale, whatever the light."""

    def __init__(self, scene: viser.SceneApi, desk: MapDesk) -> None:
        self._scene = scene
        self._desk = desk
        self._frame = scene.add_frame(NODE, show_axes=False, visible=False)
        self._sheet: viser.ImageHandle | None = None
        self._line: viser.LineSegmentsHandle | None = None
        self._front = False
        self._mark = scene.add_icosphere(f"{NODE}/tool", MARK_RADIUS_M, theme.PAPER, cast_shadow=False, visible=False)
        self._label = scene.add_label(f"{NODE}/value", "", font_screen_scale=1.1, visible=False)
        desk.answered.connect(lambda _: self._draw())

    def visible(self, front: bool) -> None:
        """Whether the tab is in front."""
        self._front = front
        self._show()

    def follow_tool(self) -> None:
        """Move the mark to where the tool is."""
        value, picture = self._desk.value_at_tool, self._desk.picture
        known = picture is not None and np.isfinite(value)
        self._mark.visible = self._label.visible = bool(known)
        if picture is not None and known:
            self._mark.position = (*self._desk.tool, 0.0)
            self._label.position = (*self._desk.tool, 0.0)
            self._label.text = with_unit(value, picture.map.unit)

    def _draw(self) -> None:
        picture = self._desk.picture
        if self._line is not None:
            self._line.remove()
            self._line = None
        if picture is not None:
            self._frame.position = (0.0, 0.0, picture.map.settings.height_m)
            self._draw_sheet(picture)
            self._draw_line(picture)
        self._show()
        self.follow_tool()

    def _draw_sheet(self, picture: MapPicture) -> None:
        """The picture's rows go up along y; every pixel has its point in the middle."""
        x, y = picture.map.x, picture.map.y
        width, height = ((axis[1] - axis[0]) * len(axis) for axis in (x, y))
        if self._sheet is None:
            self._sheet = self._scene.add_image(f"{NODE}/sheet", picture.rgba, width, height, cast_shadow=False)
        else:
            self._sheet.image = picture.rgba
            self._sheet.render_width, self._sheet.render_height = width, height
        self._sheet.position = (0.5 * (x[0] + x[-1]), 0.5 * (y[0] + y[-1]), 0.0)

    def _draw_line(self, picture: MapPicture) -> None:
        if not len(picture.limit_line):
            return
        segments = np.pad(picture.limit_line, ((0, 0), (0, 0), (0, 1)), constant_values=LIFT_M)
        self._line = self._scene.add_line_segments(
            f"{NODE}/limit", segments, theme.MARK, thickness=4.0, thickness_units="screen"
        )

    def _show(self) -> None:
        shown = self._front and self._desk.picture is not None
        if self._frame.visible != shown:
            self._frame.visible = shown
