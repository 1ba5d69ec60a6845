"""The robot on the table as it reports itself: joints, drives and errors of the last seconds."""

from __future__ import annotations

import math
import time
from typing import NamedTuple

import viser

from app.link.protocol.codes import State
from app.link.status import LinkStatus
from app.robots import Robot
from app.ui import theme
from app.ui.hardware.desk import HardwareDesk
from app.ui.panels.text import small
from app.ui.panels.units import FACTOR, SHOWN_UNIT
from app.ui.plots import DASHED, Axes, Curve, Plot

BUSY_S, IDLE_S = 0.4, 2.0
"""Between two refreshes, while the robot moves and while it stands: each makes the page draw for some frames."""

MOVING = (State.MOVING, State.HOMING, State.TESTING, State.HELD)
TIME = "Time (s), now is 0"


class _Plots(NamedTuple):
    robot: str
    joints: Plot
    error: Plot
    drive: Plot


class LivePanel:
    """Three plots, made anew for another robot."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk) -> None:
        self._desk = desk
        self._client = client
        self._plots: _Plots | None = None
        self.visible = True
        """Whether anybody can see them: else nothing is sent."""
        self._wait = client.gui.add_html(small("Connect a board: what it reports is plotted here."))
        self._place = client.gui.add_folder(None)
        self._drawn_s = -math.inf
        desk.beat.connect(self._follow)

    def _follow(self, status: LinkStatus) -> None:
        if status.robot is not None and (self._plots is None or self._plots.robot != status.robot.name):
            self._build(status.robot)
        if not self.visible or status.telemetry is None:
            return
        now, moves = time.monotonic(), status.telemetry.state in MOVING or status.activity != "idle"
        if now - self._drawn_s >= (BUSY_S if moves else IDLE_S):
            self._drawn_s = now
            self._refresh()

    def _build(self, robot: Robot) -> None:
        if self._plots is not None:
            for plot in self._plots[1:]:
                plot.remove()
        self._wait.visible = False
        legs = [(name, theme.leg_color(k)) for k, name in enumerate(robot.joint_names)]
        unit = SHOWN_UNIT[robot.joint_unit]
        solid = [Curve(name, color) for name, color in legs]
        dashed = [Curve(f"{name} set-point", color, 1.2, DASHED) for name, color in legs]
        gui = self._client.gui
        with self._place:
            self._plots = _Plots(
                robot.name,
                Plot(gui, Axes(TIME, f"Joint ({unit})"), solid + dashed, "Joints and set-points", 215),
                Plot(gui, Axes(TIME, f"Error ({unit})"), solid, "Set-point minus joint", 150),
                Plot(gui, Axes(TIME, "Supply (%)"), solid, "Drives", 150),
            )

    def _refresh(self) -> None:
        robot, plots = self._desk.status.robot, self._plots
        if robot is None or plots is None or plots.robot != robot.name or not self.visible:
            return
        t, position, setpoint, drive = self._desk.workshop.watch.history.columns
        if len(t) < 2:
            return
        n, factor = len(robot.joint_names), FACTOR[robot.joint_unit]
        plots.joints.show(t, *factor * position.T[:n], *factor * setpoint.T[:n])
        plots.error.show(t, *factor * (setpoint - position).T[:n])
        plots.drive.show(t, *100.0 * drive.T[:n])
        self._client.flush()
