"""A laser's power, which follows the speed at which it really moves."""

from __future__ import annotations

import numpy as np
import viser

from app.ui import theme
from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.jobs import Plan
from app.ui.panels.text import small
from app.ui.plots import Axes, Curve, Plot

ABOUT = "Every millimetre gets the same energy: less power in corners, none at rest and between the strokes."


class LaserPanel:
    """The folder `Laser`, there while a laser is chosen."""

    def __init__(self, gui: viser.GuiApi, desk: DrawingDesk) -> None:
        self._desk = desk
        self._folder = gui.add_folder("Laser", visible=False)
        self._plot: Plot | None = None
        with self._folder:
            gui.add_html(small(ABOUT))
        self._gui = gui
        desk.planned.connect(self._show)

    def _show(self, plan: Plan | None) -> None:
        if plan is None or plan.laser is None:
            self._folder.visible = plan is None and self._folder.visible and self._desk.settings.pen.laser
            return
        if self._plot is None:
            with self._folder:
                speed = Curve("speed, of the drawing speed", theme.REFERENCE, 1.5)
                power = Curve("laser power", theme.MARK, 1.5)
                self._plot = Plot(self._gui, Axes("Time (s)", "Share (%)"), (speed, power), "Laser power", 180)
        t, speed_mm_s, share = plan.laser
        of_speed = 100.0 * np.minimum(speed_mm_s / self._desk.settings.pen.speed_mm_s, 1.0)
        self._plot.show(t, of_speed, 100.0 * share)
        self._folder.visible = True
