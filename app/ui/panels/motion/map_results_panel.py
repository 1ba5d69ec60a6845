"""What a map says in numbers: its colour scale, its extremes, and a cut through the tool."""

from __future__ import annotations

import numpy as np
import viser

from app.robots.maps import MAPS
from app.ui import theme
from app.ui.motion.map_desk import MapDesk
from app.ui.motion.map_picture import MapPicture
from app.ui.pacing import Paced
from app.ui.panels.motion.map_texts import color_bar, extremes
from app.ui.panels.text import problem, small
from app.ui.plots import DASHED, Axes, Curve, Plot

REFRESH_S = 0.2
ALONG_X, ALONG_Y = "Along x", "Along y"
HOW = "Open the folder <b>Maps</b> on the right and tick <b>Show a map</b>: a slice of the workspace is coloured."
COMPUTING = "The map is being computed …"


class MapResultsPanel:
    """The tab `Map`."""

    def __init__(self, gui: viser.GuiApi, desk: MapDesk) -> None:
        self._desk = desk
        self._said = gui.add_html(small(HOW))
        self._table = gui.add_html("", visible=False)
        self._folder = gui.add_folder("Cut through the tool", visible=False)
        with self._folder:
            self._cut = gui.add_dropdown("Direction", (ALONG_X, ALONG_Y))
            self._plot = Plot(
                gui,
                Axes("x (mm)", "Value"),
                (
                    Curve("map", theme.TRACE),
                    Curve("limit", theme.REFERENCE, 1.5, DASHED, optional=True),
                    Curve("at the tool", theme.MARK, marks_only=True),
                ),
                "Cut through the map",
            )
        self._pace = Paced(self._show_tool, REFRESH_S)
        desk.answered.connect(lambda _: self._show())
        desk.changed.connect(lambda _: self._show())

        @self._cut.on_update
        async def _(_: object) -> None:
            self._show_tool()

    def follow_tool(self) -> None:
        """The robot has moved."""
        if self._desk.picture is not None:
            self._pace.request()

    def close(self) -> None:
        self._pace.cancel()

    def _show(self) -> None:
        desk, picture = self._desk, self._desk.picture
        for element in (self._table, self._folder):
            if element.visible != (picture is not None):
                element.visible = picture is not None
        if picture is not None:
            content = color_bar(picture)
        elif desk.refusal:
            content = problem(desk.refusal)
        else:
            content = small(COMPUTING if desk.on else HOW)
        if content != self._said.content:
            self._said.content = content
        self._show_tool()

    def _show_tool(self) -> None:
        picture, tool = self._desk.picture, self._desk.tool
        if picture is None:
            return
        self._table.content = extremes(picture, tool)
        along_x = self._cut.value == ALONG_X
        axis, values, k = cut(picture, tool, along_x)
        found = picture.map
        limit = np.full(len(axis), np.nan)
        if found.level is not None and np.nanmax(np.abs(found.values)) > 0.7 * found.level:
            limit[:] = found.level
        here = np.full(len(axis), np.nan)
        here[k] = values[k]
        title = MAPS[found.settings.quantity].title
        self._plot.rename(Axes("x (mm)" if along_x else "y (mm)", f"{title} ({found.unit})" if found.unit else title))
        self._plot.show(1e3 * axis, values, limit, here)


def cut(picture: MapPicture, tool: tuple[float, float], along_x: bool) -> tuple[np.ndarray, np.ndarray, int]:
    """Positions (k,) in m, values (k,) and the index nearest to the tool, along x or y through it."""
    found = picture.map
    row = int(np.abs(found.y - tool[1]).argmin())
    column = int(np.abs(found.x - tool[0]).argmin())
    if along_x:
        return found.x, found.values[row], column
    return found.y, found.values[:, column], row
