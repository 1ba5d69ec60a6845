"""The same drawing on all four robots."""

from __future__ import annotations

import html
import math

import viser

from app.drawing.compare import RobotResult
from app.robots import ROBOTS
from app.ui.drawing.compare_jobs import on_robot
from app.ui.drawing.desk import DrawingDesk
from app.ui.panels.drawing.preview_panel import duration
from app.ui.panels.tables import table
from app.ui.panels.text import small
from app.ui.series import Series

ABOUT = (
    "Each robot draws it on a sheet that lies where it has room, with the joint limits that README and code declare. "
    "Conditioning 1 is best; large means near a singularity."
)


class RobotsPanel:
    """The folder `The same drawing on four robots`."""

    def __init__(self, gui: viser.GuiApi, desk: DrawingDesk, series: Series) -> None:
        self._desk = desk
        self._series = series
        self._results: list[RobotResult] = []
        with gui.add_folder("The same drawing on four robots"):
            gui.add_html(small(ABOUT))
            self._go = gui.add_button("Compare the robots", icon=viser.Icon.ROBOT, disabled=desk.sketch is None)
            self._table = gui.add_html("")
        desk.sketched.connect(lambda _: setattr(self._go, "disabled", series.busy))
        series.progressed.connect(lambda _: setattr(self._go, "disabled", series.busy))

        @self._go.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            self._start()

    def _start(self) -> None:
        sketch = self._desk.sketch
        if sketch is not None:
            self._results = []
            self._series.start([(on_robot, (sketch.strokes, name, sketch.setup)) for name in ROBOTS], self._receive)

    def _receive(self, result: RobotResult) -> None:
        self._results = [*self._results, result]
        self._table.content = robots_table(self._results)


def robots_table(results: list[RobotResult]) -> str:
    """HTML of what each robot makes of it."""
    head = ("robot", "time", "pen down", "hops", "fastest joint", "conditioning, worst")
    rows, notes = [], []
    for one in results:
        title = ROBOTS[one.robot].build.title
        if one.reason:
            notes.append(f"▲ {title}: {one.reason}")
        if math.isnan(one.time_s):
            rows.append((title, "cannot draw it"))
            continue
        joint = f"{one.peak_joint_speed:.2f} {one.speed_unit} ({one.peak_joint_speed_ratio:.0%})"
        worst = f"{one.worst_conditioning:.2f}"
        rows.append((title, duration(one.time_s), duration(one.down_s), duration(one.hops_s), joint, worst))
    return table(head, rows) + "".join(small(html.escape(note)) for note in notes)
