"""Every plot of the page is made here: axes with units, a legend, colours by meaning, and its data as CSV."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import viser
from numpy.typing import ArrayLike, NDArray
from viser import uplot

from app.ui import theme

HEIGHT_PX = 210
DASHED = (6, 4)
DOTTED = (2, 4)
AXIS_FONT = "11px system-ui, sans-serif"
HIDDEN = "deltalab-hidden"
"""Class of legend entries that nobody should see."""

PLOT_STYLE = f"<style>.uplot .{HIDDEN} {{ display: none; }}</style>"
"""To be put on the page once."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Curve:
    """How one series looks."""

    label: str
    color: theme.Rgb
    width: float = 2.0
    dash: tuple[int, ...] = ()
    marks_only: bool = False
    """Points instead of a line."""
    size: int = 9
    """Of the points, pixels."""
    optional: bool = False
    """Named in the legend only while it is there. Coming and going rebuilds the chart, so not for what often does."""
    named: bool = True
    """Whether the legend names it at all."""


@dataclass(frozen=True)
class Axes:
    """What is plotted over what."""

    x: str
    """Name and unit, say `Time (s)`."""
    y: str
    log_x: bool = False


class Plot:
    """A chart whose curves can be exchanged while it stands; NaN leaves a gap.

    uPlot takes a range from the first value of a curve on, and a NaN there spoils it. So the range comes from a
    curve of its own that is not drawn and spans all others.
    """

    def __init__(
        self, gui: viser.GuiApi, axes: Axes, curves: Sequence[Curve], title: str = "", height: int = HEIGHT_PX
    ) -> None:
        self._axes = axes
        self._curves = tuple(curves)
        self._absent = frozenset(k for k, curve in enumerate(self._curves) if curve.optional)
        empty = np.array([1.0, 2.0])  # a logarithmic axis has no zero
        self._chart = gui.add_uplot(
            (empty, empty, *(np.full(2, np.nan) for _ in curves)),
            self._series(),
            title=title or None,
            scales={"x": uplot.Scale(time=False, distr=3 if axes.log_x else 1), "y": uplot.Scale()},
            axes=self._both_axes(),
            legend=uplot.Legend(show=True, live=False),
            height=height,
            padding=(10, 20, 0, 0),
        )

    def show(self, x: ArrayLike, *ys: ArrayLike) -> None:
        """New data: x (k,), and one (k,) array a curve, in the curves' order."""
        abscissa, *ordinates = (np.array(values, dtype=float) for values in (x, *ys))
        if len(ordinates) != len(self._curves):
            raise ValueError(f"{len(self._curves)} curves need as many arrays, not {len(ordinates)}.")
        absent = frozenset(
            k for k, curve in enumerate(self._curves) if curve.optional and not np.isfinite(ordinates[k]).any()
        )
        if absent != self._absent:
            self._absent = absent
            self._chart.series = self._series()
        self._chart.data = (abscissa, _extent(ordinates), *ordinates)

    def rename(self, axes: Axes) -> None:
        """Other names or units."""
        self._axes = axes
        self._chart.axes = self._both_axes()

    def csv(self) -> str:
        """What is shown, as a table."""
        head = [self._axes.x, *(f"{curve.label}: {self._axes.y}" for curve in self._curves)]
        x, _, *ys = self._chart.data
        return csv_table(head, np.column_stack([x, *ys]))

    def remove(self) -> None:
        self._chart.remove()

    def _both_axes(self) -> tuple[uplot.Axis, ...]:
        return _axis("x", self._axes.x, 34), _axis("y", self._axes.y, 58)

    def _series(self) -> tuple[uplot.Series, ...]:
        extent = uplot.Series({"label": "", "class": HIDDEN, "width": 0, "points": {"show": False}})
        drawn = [_series(curve, k in self._absent) for k, curve in enumerate(self._curves)]
        return (uplot.Series(label=self._axes.x), extent, *drawn)


def csv_table(head: Sequence[str], rows: NDArray[np.floating[Any]]) -> str:
    """Comma-separated; what is not a number is left empty."""
    quoted = [f'"{name}"' if "," in name else name for name in head]
    lines = [",".join("" if value != value else f"{value:.8g}" for value in row) for row in rows.tolist()]
    return "\n".join([",".join(quoted), *lines, ""])


def _series(curve: Curve, absent: bool) -> uplot.Series:
    color = theme.css(curve.color)
    series = uplot.Series(label=curve.label, stroke=color, width=0 if curve.marks_only else curve.width, auto=False)
    if curve.marks_only:
        series["points"] = uplot.Series_Points(show=True, size=curve.size, fill=color, width=1)
    else:
        series["points"] = uplot.Series_Points(show=False)
    if curve.dash:
        series["dash"] = curve.dash
    if absent or not curve.named:
        series["class"] = HIDDEN
    return series


def _extent(curves: Sequence[Array]) -> Array:
    """(k,) that spans every finite value, up and down in turn. What is flat lies in the middle: of a flat zero, uPlot
    would make 0 to 100."""
    extent = np.zeros(len(curves[0]))
    finite = np.concatenate(curves)
    finite = finite[np.isfinite(finite)]
    if finite.size:
        low, high = finite.min(), finite.max()
        room = (0.1 * abs(low) or 1.0) if low == high else 0.0
        extent[0::2], extent[1::2] = low - room, high + room
    return extent


def _axis(scale: str, label: str, size: int) -> uplot.Axis:
    return uplot.Axis(scale=scale, label=label, labelSize=18, labelFont=AXIS_FONT, font=AXIS_FONT, size=size)
