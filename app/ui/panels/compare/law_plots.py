"""The curves of a comparison: errors of the tool, efforts of a joint, and what one law's effort is made of."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import viser
from numpy.typing import NDArray

from app.simulation.controlled_run import ControlledRun
from app.ui import theme
from app.ui.compare.score import STRETCHES, error_columns, quantities, unit_of
from app.ui.plots import DASHED, DOTTED, Axes, Curve, Plot

Array = NDArray[np.float64]

POINTS = 400
HEIGHT_PX = 220
DASHES: dict[str, tuple[int, ...]] = {"PDff": DASHED, "CTC+DOB": DASHED, "TSIIDC": DASHED, "PD+": DOTTED, "SMC": DOTTED}
"""A second mark beside the colour, for laws that do nearly the same."""
NEAR_LIMIT = 0.4
"""A limit is drawn once an effort has come to this share of it; otherwise the curves would be flat."""


class LivePlot:
    """A chart in a place of its own, made anew when its curves are others, or its times: viser keeps the part of the
    time axis that was shown, and gets it wrong where that axis changes twice in a row.
    """

    def __init__(self, gui: viser.GuiApi, title: str) -> None:
        self._gui = gui
        self._title = title
        self._place = gui.add_folder(None)
        self._plot: Plot | None = None
        self._made_for: tuple[object, ...] = ()

    def show(self, y_label: str, t: Array, curves: Sequence[Curve], ys: Sequence[Array]) -> None:
        """Curves over time t (k,) s; what is not there yet is NaN."""
        axes = Axes("Time (s)", y_label)
        made_for = (*curves, float(t[0]), float(t[-1]))
        if self._plot is None or made_for != self._made_for:
            self.clear()
            self._made_for = made_for
            with self._place:
                self._plot = Plot(self._gui, axes, curves, self._title, HEIGHT_PX)
        self._plot.rename(axes)
        self._plot.show(t, *ys)

    def clear(self) -> None:
        if self._plot is not None:
            self._plot.remove()
            self._plot = None


Runs = dict[str, ControlledRun]
"""By law."""


def moments(runs: Runs, stretch: str) -> Array:
    """(k,) s evenly through a part of the runs, or through all where they do not reach that part."""
    first, last = STRETCHES[stretch]
    end = float(next(iter(runs.values())).t[-1])
    return np.linspace(first, min(last, end), POINTS) if first < end else np.linspace(0.0, end, POINTS)


def draw_errors(plot: LivePlot, t: Array, laws: Sequence[str], runs: Runs, names: tuple[str, ...], what: str) -> None:
    """The error in one quantity, of a robot with these pose names."""
    column = quantities(names).index(what)
    found = {law: np.interp(t, run.t, error_columns(run)[:, column]) for law, run in runs.items()}
    plot.show(f"Error, {what} ({unit_of(what)})", t, _law_curves(laws), [found.get(law, _nothing(t)) for law in laws])


def draw_efforts(plot: LivePlot, t: Array, laws: Sequence[str], runs: Runs, joint: int) -> None:
    """The effort of one joint between its limits."""
    run = next(iter(runs.values()))
    found = {law: np.interp(t, run.t, run.torque[:, joint]) for law, run in runs.items()}
    limit = float(run.effort_limit[joint])
    near = any(np.abs(curve).max() >= NEAR_LIMIT * limit for curve in found.values())
    bands = [np.full(len(t), side * limit) if near else _nothing(t) for side in (1.0, -1.0)]
    upper = Curve("limit", theme.REFERENCE, 1.5, DASHED, optional=True)
    lower = Curve("lower limit", theme.REFERENCE, 1.5, DASHED, named=False)
    curves = [*_law_curves(laws), upper, lower]
    plot.show(f"Effort ({run.effort_unit})", t, curves, [*(found.get(law, _nothing(t)) for law in laws), *bands])


def draw_parts(plot: LivePlot, t: Array, run: ControlledRun, joint: int) -> None:
    """What a law wants of one joint, part by part, and their sum."""
    names = [name for name, part in run.components.items() if np.any(part)]
    parts = [np.interp(t, run.t, run.components[name][:, joint]) for name in names]
    curves = [*(Curve(name, theme.component_color(name)) for name in names), Curve("sum", theme.REFERENCE, 1.5, DASHED)]
    plot.show(f"Effort ({run.effort_unit})", t, curves, [*parts, np.sum(parts, axis=0)])


def _law_curves(laws: Sequence[str]) -> list[Curve]:
    return [Curve(law, theme.law_color(law), 2.0, DASHES.get(law, ())) for law in laws]


def _nothing(t: Array) -> Array:
    return np.full(len(t), np.nan)
