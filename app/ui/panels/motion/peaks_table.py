"""How near every joint of a motion comes to its limits."""

from __future__ import annotations

import math

import numpy as np
import viser

from app.motion import Motion
from app.robots import ROBOTS
from app.ui import theme
from app.ui.motion.desk import MotionDesk
from app.ui.panels.motion.joint_units import joint_units
from app.ui.panels.tables import table

TOUCHED = 0.99


class PeaksTable:
    """One row a joint."""

    def __init__(self, gui: viser.GuiApi, desk: MotionDesk) -> None:
        self._desk = desk
        self._html = gui.add_html("")
        desk.planned.connect(self._show)
        if desk.motion is not None:
            self._show(desk.motion)

    def _show(self, motion: Motion) -> None:
        self._html.content = peaks_table(motion, self._desk.robot.name)


def peaks_table(motion: Motion, robot: str) -> str:
    """HTML of the largest magnitudes and their shares of the limits."""
    units = joint_units(robot)
    head = ("peak", f"{units.position}/s", f"{units.position}/s²", units.effort)
    pairs = (
        (motion.joint_rates, motion.limits.speed, units.factor),
        (motion.joint_accelerations, motion.limits.acceleration, units.factor),
        (motion.efforts, motion.limits.effort, 1.0),
    )
    columns = [(np.abs(values).max(axis=0), limit, factor) for values, limit, factor in pairs]
    rows = [
        (name, *(_cell(factor * peak[k], peak[k] / limit[k]) for peak, limit, factor in columns))
        for k, name in enumerate(ROBOTS[robot].build.joint_names)
    ]
    return table(head, rows)


def _cell(value: float, share: float) -> str:
    digits = max(0, 2 - math.floor(math.log10(value))) if value > 0.0 else 0
    said = f"{value:.{digits}f} <small>({100.0 * share:.0f} %)</small>"
    return f'<b style="color:{theme.css(theme.MARK)}">{said}</b>' if share >= TOUCHED else said
