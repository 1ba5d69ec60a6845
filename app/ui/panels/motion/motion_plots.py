"""Position, speed, acceleration and effort of all joints of a motion, or of one, each with its limits."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import viser
from numpy.typing import NDArray

from app.motion import Motion
from app.robots import ROBOTS
from app.ui import theme
from app.ui.motion.desk import MotionDesk
from app.ui.panels.motion.joint_units import JointUnits, joint_units
from app.ui.panels.options import show_options
from app.ui.plots import DASHED, Axes, Curve, Plot

ALL = "All joints"
POINTS = 350
HEIGHT_PX = 190
FAR = 4.0
"""A limit that lies farther beyond the curves, in their height, is not drawn."""

STALE = '<span class="deltalab-stale"></span>'
STALE_STYLE = "<style>div:has(> .deltalab-stale) ~ div .uplot { opacity: 0.3; }</style>"
"""To be put on the page once: the plots that follow a mark in the same folder are faded."""

Array = NDArray[np.floating[Any]]


class Quantity(NamedTuple):
    """What one plot shows of a motion, in the units that people read."""

    values: Array
    """(k, n)"""
    low: Array
    """(n,)"""
    high: Array
    """(n,)"""


class MotionPlots:
    """Four plots; they stay while the robot does."""

    def __init__(self, gui: viser.GuiApi, desk: MotionDesk) -> None:
        self._gui = gui
        self._desk = desk
        self._joint = gui.add_dropdown("Joint", (ALL, *desk.robot.joint_names))
        self._limits = gui.add_checkbox("Show limits", True, hint="Dashed; those far away are left out")
        self._folder = gui.add_folder(None)
        with self._folder:
            self._stale = gui.add_html("")
        self._plots: list[Plot] = []
        self._built_for = ""
        desk.planned.connect(lambda _: self._draw())
        desk.refused.connect(lambda _: self._fade())
        self._listen()
        if desk.motion is not None:
            self._draw()

    def _listen(self) -> None:
        @self._joint.on_update
        async def _(_: object) -> None:
            self._draw()

        @self._limits.on_update
        async def _(_: object) -> None:
            self._draw()

    def _fade(self) -> None:
        """What is shown beside a refusal is not what was asked for."""
        content = STALE if self._desk.refusal else ""
        if content != self._stale.content:
            self._stale.content = content

    def _build(self, robot: str) -> None:
        if robot == self._built_for:
            return
        self._built_for = robot
        names, units = ROBOTS[robot].build.joint_names, joint_units(robot)
        show_options(self._joint, (ALL, *names), ALL)
        for plot in self._plots:
            plot.remove()
        curves = [Curve(name, theme.leg_color(k)) for k, name in enumerate(names)]
        curves += [Curve("limits", theme.REFERENCE, 1.2, DASHED, named=k == 0) for k in range(2 * len(names))]
        with self._folder:
            self._plots = [
                Plot(self._gui, Axes("Time (s)", y), curves, title, HEIGHT_PX) for title, y in _titles(units)
            ]

    def _draw(self) -> None:
        motion = self._desk.motion
        self._fade()
        if motion is None:
            return
        robot = self._desk.robot
        self._build(robot.name)
        names = robot.joint_names
        one = names.index(self._joint.value) if self._joint.value in names else None
        hidden = np.array([one is not None and k != one for k in range(len(names))])
        chosen = np.unique(np.linspace(0, len(motion.t) - 1, POINTS).astype(int))
        for plot, quantity in zip(
            self._plots, quantities(motion, robot.joint_limits, joint_units(robot.name)), strict=True
        ):
            values = np.where(hidden, np.nan, quantity.values[chosen])
            lines = limit_lines(quantity, values) if self._limits.value else np.full(2 * len(names), np.nan)
            plot.show(motion.t[chosen], *values.T, *(np.full(len(chosen), line) for line in lines))


def limit_lines(quantity: Quantity, values: Array) -> Array:
    """(2 n,) limits of the joints whose values (k, n) are shown; NaN for others, and for what is far off: beside a
    limit of five turns nobody would see a joint move."""
    shown = np.isfinite(values[0])
    low, high = np.nanmin(values), np.nanmax(values)
    room = FAR * max(high - low, 1e-9)
    limits = np.stack([quantity.low, quantity.high], axis=1)
    near = (limits >= low - room) & (limits <= high + room)
    return np.where(near & shown[:, None], limits, np.nan).ravel()


def _titles(units: JointUnits) -> list[tuple[str, str]]:
    """Title and y axis of each plot."""
    return [
        ("Joint position", f"Position ({units.position})"),
        ("Joint speed", f"Speed ({units.position}/s)"),
        ("Joint acceleration", f"Acceleration ({units.position}/s²)"),
        (f"Joint {units.effort_name}", f"{units.effort_name.capitalize()} ({units.effort})"),
    ]


def quantities(motion: Motion, joint_limits: Array, units: JointUnits) -> list[Quantity]:
    """What the four plots show; `joint_limits` (n, 2) in rad or m."""
    limits, factor = motion.limits, units.factor
    stops = np.where(np.isfinite(joint_limits), factor * joint_limits, np.nan)
    return [
        Quantity(factor * motion.q, stops[:, 0], stops[:, 1]),
        _both_ways(factor * motion.joint_rates, factor * limits.speed),
        _both_ways(factor * motion.joint_accelerations, factor * limits.acceleration),
        _both_ways(motion.efforts, limits.effort),
    ]


def _both_ways(values: Array, limit: Array) -> Quantity:
    return Quantity(values, -limit, limit)
