"""The real machine beside its twin: a table, and what they did."""

from __future__ import annotations

import html
import math

import numpy as np
import viser

from app.link.twin.compare import TwinComparison
from app.robots import ROBOTS
from app.ui import theme
from app.ui.panels.tables import table
from app.ui.panels.text import small
from app.ui.plots import DASHED, Axes, Curve, Plot

POINTS = 400
REAL: str = "real"


class TwinView:
    """Nothing until there is a comparison."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._gui = gui
        self._comparison: TwinComparison | None = None
        self._plots: list[Plot] = []
        self._built_for = ""
        self._table = gui.add_html("")
        self._joint = gui.add_dropdown("Joint shown", (REAL,), visible=False)
        self._place = gui.add_folder(None)

        @self._joint.on_update
        async def _(_: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._draw()

    def show(self, comparison: TwinComparison) -> None:
        self._comparison = comparison
        self._table.content = twin_table(comparison)
        names = ROBOTS[comparison.robot].build.joint_names
        if self._built_for != comparison.robot:
            self._built_for = comparison.robot
            self._joint.options = names
            self._joint.visible = True
            self._build(comparison, names)
        self._draw()

    def _build(self, comparison: TwinComparison, names: tuple[str, ...]) -> None:
        for plot in self._plots:
            plot.remove()
        unit, time = comparison.joint_unit, "Time (s)"
        three = [
            Curve("set-point", theme.REFERENCE, 1.2, DASHED),
            Curve(REAL, theme.ACTUAL),
            Curve("twin", theme.IDEAL, 1.5),
        ]
        legs = [Curve(name, theme.leg_color(k), 1.5) for k, name in enumerate(names)]
        with self._place:
            self._plots = [
                Plot(self._gui, Axes(time, f"Joint ({unit})"), three, "One joint", 190),
                Plot(self._gui, Axes(time, f"Real minus twin ({unit})"), legs, "Difference", 160),
                Plot(self._gui, Axes(time, "Distance (mm)"), [Curve("tool", theme.MARK, 1.5)], "Tool error", 140),
            ]

    def _draw(self) -> None:
        found = self._comparison
        if found is None or not self._plots:
            return
        names = ROBOTS[found.robot].build.joint_names
        joint = names.index(self._joint.value) if self._joint.value in names else 0
        chosen = np.unique(np.linspace(0, len(found.t) - 1, POINTS).astype(int))
        t = found.t[chosen]
        three = (found.shown(values)[chosen, joint] for values in (found.setpoint, found.measured, found.twin))
        self._plots[0].show(t, *three)
        self._plots[1].show(t, *found.shown(found.measured - found.twin)[chosen].T)
        self._plots[2].show(t, 1e3 * found.tool_error_m[chosen])


def twin_table(found: TwinComparison) -> str:
    """HTML: delay and error of each joint, and of the tool."""
    names = ROBOTS[found.robot].build.joint_names
    unit = found.joint_unit
    columns = (found.rms_error, found.largest_error, found.rms_error_in_step)
    rows = [
        (
            f'<b style="color:{theme.css(theme.leg_color(k))}">●</b> {html.escape(name)}',
            _number(1e3 * found.joint_lag_s[k]),
            *(_number(float(found.shown(column)[k])) for column in columns),
        )
        for k, name in enumerate(names)
    ]
    head = ("", "lag, ms", f"rms, {unit}", f"largest, {unit}", "rms without lag")
    tool = (
        f"Tool: rms {_number(1e3 * found.rms_tool_error_m)} mm, at most {_number(1e3 * found.largest_tool_error_m)} mm."
    )
    late = f" Behind its set-points: {_number(1e3 * found.following_lag_s)} ms."
    latency = found.latency
    if latency.count:
        late += f" Link: {_number(1e3 * latency.median_s)} ms, 95 % below {_number(1e3 * latency.p95_s)} ms."
    sentence = f"<b>{html.escape(found.sentence)}</b>"
    return small(sentence) + table(head, rows) + small(tool + late) + small(html.escape(found.note))


def _number(value: float) -> str:
    return "–" if math.isnan(value) else f"{value:.3g}"
