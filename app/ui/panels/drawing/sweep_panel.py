"""Quality against speed: one setting is swept, and every drawing timed and looked at."""

from __future__ import annotations

import html
import math

import numpy as np
import viser

from app.drawing.compare import SWEEPS, SweepPoint, sweep_values
from app.drawing.modes import DRAWING_MODES
from app.ui import theme
from app.ui.downloads import offer
from app.ui.drawing.compare_jobs import sweep_point
from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.jobs import Sketch
from app.ui.panels.drawing.preview_panel import duration
from app.ui.panels.options import show_options
from app.ui.panels.tables import table
from app.ui.panels.text import small
from app.ui.plots import Axes, Curve, Plot
from app.ui.series import Series

ABOUT = (
    "A finer drawing takes longer. Sweep one setting: each point is a whole drawing, timed on the robot, and its ink "
    "compared with the picture from a little away."
)
LABELS = {"scale": "Scale", "speed_mm_s": "Drawing speed (mm/s)"}


class SweepPanel:
    """The folder `Quality against speed`."""

    def __init__(self, client: viser.ClientHandle, desk: DrawingDesk, series: Series) -> None:
        self._desk = desk
        self._series = series
        self._points: list[SweepPoint] = []
        self._names: dict[str, str] = {"Scale": "scale"}
        self._mode = self._swept = ""
        gui = client.gui
        with gui.add_folder("Quality against speed"):
            gui.add_html(small(ABOUT))
            self._choice = gui.add_dropdown("Sweep", tuple(self._names))
            self._go = gui.add_button("Sweep it", icon=viser.Icon.CHART_DOTS, disabled=True)
            tried = Curve("swept", theme.ACTUAL, 1.5)
            points = Curve("drawings", theme.MARK, marks_only=True, size=8)
            axes = Axes("Drawing time (s)", "Similarity (%)")
            self._plot = Plot(gui, axes, (tried, points), "Quality against speed", 200)
            self._table = gui.add_html("")
            self._save = offer(client, "Save sweep as CSV", lambda: ("sweep.csv", sweep_csv(self._points)))
            self._save.visible = False
        desk.sketched.connect(self._follow)
        series.progressed.connect(lambda _: setattr(self._go, "disabled", series.busy))
        if desk.sketch is not None:
            self._follow(desk.sketch)

        @self._go.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            self._start()

    def _follow(self, sketch: Sketch) -> None:
        """Offer what the present mode has."""
        self._go.disabled = self._series.busy
        if sketch.mode == self._mode:
            return
        self._mode = sketch.mode
        parameters = DRAWING_MODES[sketch.mode].parameters if sketch.mode in DRAWING_MODES else ()
        labels = LABELS | {one.name: f"{one.label}{f' ({one.unit})' if one.unit else ''}" for one in parameters}
        self._names = {labels[name]: name for name in SWEEPS[sketch.mode]}
        show_options(self._choice, tuple(self._names), next(iter(self._names)))

    def _start(self) -> None:
        sketch, source = self._desk.sketch, self._desk.source
        if sketch is None or source is None:
            return
        self._swept = self._choice.value
        name = self._names[self._swept]
        values = sweep_values(sketch.mode, name)
        self._points = []
        tasks = [(sweep_point, (source, sketch.chosen_look, sketch.setup, name, value)) for value in values]
        self._series.start(tasks, self._receive)

    def _receive(self, point: SweepPoint) -> None:
        self._points = [*self._points, point]
        good = sorted((one for one in self._points if not math.isnan(one.time_s)), key=lambda one: one.time_s)
        if len(good) > 1:
            time_s = [one.time_s for one in good]
            likeness = [100.0 * one.similarity for one in good]
            self._plot.show(time_s, likeness, likeness)
        self._table.content = sweep_table(self._swept, self._points)
        self._save.visible = True


def sweep_table(label: str, points: list[SweepPoint]) -> str:
    """HTML of every drawing of a sweep."""
    head = (label, "time", "similarity", "ink", "strokes", "off by")
    rows = [
        (
            f"{one.value:g}",
            duration(one.time_s),
            f"{one.similarity:.1%}",
            f"{one.ink_mm / 1e3:.2f} m",
            str(one.strokes),
            f"{one.deviation_um:.0f} µm",
        )
        if not one.reason
        else (f"{one.value:g}", f"▲ {html.escape(one.reason)}")
        for one in points
    ]
    return table(head, rows)


def sweep_csv(points: list[SweepPoint]) -> str:
    """The same for a spreadsheet."""
    head = "value,time_s,similarity,ink_mm,strokes,deviation_um"
    numbers = np.array([(p.value, p.time_s, p.similarity, p.ink_mm, p.strokes, p.deviation_um) for p in points])
    lines = [",".join("" if math.isnan(value) else f"{value:.8g}" for value in row) for row in numbers.tolist()]
    return "\n".join([head, *lines, ""])
