"""The plots of the step experiment: response and control signal, frequency response and poles, and the numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import viser
from numpy.typing import NDArray

from app.simulation.step_study import Frequency, Response, Study
from app.ui import theme
from app.ui.downloads import offer
from app.ui.lab.desk import ControlDesk
from app.ui.lab.jobs import Answer
from app.ui.panels.lab.metrics_table import metrics_table
from app.ui.plots import DASHED, DOTTED, Axes, Curve, Plot

Array = NDArray[np.float64]

FARTHEST_DRAWN = 20.0
"""Times the set-point."""
MOST_DRAWN_V = 1e5

NOW = Curve("now", theme.ACTUAL, 2.5)
IDEAL = Curve("ideal", theme.IDEAL, 1.5, DASHED)
BASELINE = Curve("baseline", theme.BASELINE, 1.5, optional=True)
SETPOINT = Curve("set-point", theme.REFERENCE, 1.5, DASHED)


MARKS = (
    Curve("peak", theme.MARK, marks_only=True),
    Curve("10 % and 90 %", theme.MARK_2, marks_only=True),
    Curve("settled", theme.LEGS[2], marks_only=True),
)


class ResponsePlot:
    """The step response with its set-point and marks."""

    def __init__(self, gui: viser.GuiApi, desk: ControlDesk, height: int) -> None:
        self._desk = desk
        self._unit = desk.settings.motor.unit
        self._plot = Plot(gui, self._axes(), (SETPOINT, IDEAL, BASELINE, NOW, *MARKS), "Step response", height)
        desk.answered.connect(self._show)

    def csv(self) -> str:
        return self._plot.csv()

    def _axes(self) -> Axes:
        return Axes("Time (s)", f"Position ({self._unit})")

    def _show(self, answer: Answer) -> None:
        if answer.settings.motor.unit != self._unit:
            self._unit = answer.settings.motor.unit
            self._plot.rename(self._axes())
        board, ideal = answer.study.board, answer.study.ideal
        kept = self._desk.baseline.study.board if self._desk.baseline else None
        setpoint = np.full_like(board.t, answer.settings.setpoint)
        far = FARTHEST_DRAWN * answer.settings.setpoint
        curves = setpoint, *(_within(far, y) for y in (_on(board.t, ideal, "y"), _on(board.t, kept, "y"), board.y))
        self._plot.show(board.t, *curves, *_marks(board, answer.settings.setpoint))


class StepPlots:
    """What the joint does, and what that takes."""

    def __init__(self, client: viser.ClientHandle, desk: ControlDesk) -> None:
        gui = client.gui
        self._desk = desk
        response = ResponsePlot(gui, desk, 260)
        limits = (Curve("limit", theme.REFERENCE, 1.5, DOTTED), Curve("limit (negative)", theme.REFERENCE, 1.5, DOTTED))
        volts = Axes("Time (s)", "Control signal (V)")
        self._control = Plot(gui, volts, (*limits, IDEAL, BASELINE, NOW), "Control signal", 190)
        self._table = gui.add_html("")
        offer(client, "Save step as CSV", lambda: ("step.csv", response.csv()))
        offer(client, "Save control signal as CSV", lambda: ("control-signal.csv", self._control.csv()))
        desk.answered.connect(self._show)

    def _show(self, answer: Answer) -> None:
        settings, study = answer.settings, answer.study
        t, kept = study.board.t, self._desk.baseline.study.board if self._desk.baseline else None
        limit = settings.hardware.supply_v if np.isfinite(settings.hardware.supply_v) else np.nan
        limits = (np.full_like(t, limit), np.full_like(t, -limit))
        ideal = _within(_room_for(study, limit), _on(t, study.ideal, "u"))
        self._control.show(t, *limits, ideal, _on(t, kept, "u"), _within(MOST_DRAWN_V, study.board.u))
        self._table.content = metrics_table(answer, self._desk.baseline)


class FrequencyPlots:
    """The open loop over frequency, and the poles of the closed one."""

    def __init__(self, client: viser.ClientHandle, desk: ControlDesk) -> None:
        gui = client.gui
        self._desk = desk
        crossover = Curve("crossover", theme.MARK, marks_only=True)
        omega = "Frequency (rad/s)"
        self._gain = Plot(
            gui, Axes(omega, "Gain of L (dB)", log_x=True), (IDEAL, BASELINE, NOW, crossover), "Open loop: gain", 200
        )
        line = Curve("-180°", theme.REFERENCE, 1.5, DOTTED)
        self._phase = Plot(
            gui,
            Axes(omega, "Phase of L (deg)", log_x=True),
            (line, IDEAL, BASELINE, NOW, crossover),
            "Open loop: phase, and the margin above -180°",
            200,
        )
        points = [replace(curve, marks_only=True, size=size) for curve, size in ((IDEAL, 13), (BASELINE, 10), (NOW, 7))]
        plane = Axes("Real part (1/s)", "Imaginary part (1/s)")
        self._poles = Plot(gui, plane, points, "Poles of the closed loop: stable left of 0", 220)
        self._table = gui.add_html("")
        offer(client, "Save gain as CSV", lambda: ("gain.csv", self._gain.csv()))
        offer(client, "Save phase as CSV", lambda: ("phase.csv", self._phase.csv()))
        offer(client, "Save poles as CSV", lambda: ("poles.csv", self._poles.csv()))
        desk.answered.connect(self._show)

    def _show(self, answer: Answer) -> None:
        now, ideal = answer.study.board_frequency, answer.study.ideal_frequency
        kept = self._desk.baseline.study.board_frequency if self._desk.baseline else None
        omega = now.omega
        cross = _nearest_mark(omega, now.margins.crossover_rad_s)
        self._gain.show(omega, ideal.gain_db, _over(omega, kept, "gain_db"), now.gain_db, np.where(cross, 0.0, np.nan))
        phase = np.where(cross, now.margins.phase_margin_deg - 180.0, np.nan)
        baseline = _over(omega, kept, "phase_deg")
        self._phase.show(omega, np.full_like(omega, -180.0), ideal.phase_deg, baseline, now.phase_deg, phase)
        poles = [ideal.poles, kept.poles if kept else np.array([], dtype=complex), now.poles]
        self._poles.show(*_scatter(poles))
        self._table.content = metrics_table(answer, self._desk.baseline, frequency=True)


def _on(t: Array, response: Response | None, what: str) -> Array:
    """A curve of another experiment at these times; NaN beyond its end."""
    if response is None:
        return np.full_like(t, np.nan)
    return np.interp(t, response.t, getattr(response, what), right=np.nan)


def _over(omega: Array, frequency: Frequency | None, what: str) -> Array:
    if frequency is None:
        return np.full_like(omega, np.nan)
    return np.interp(omega, frequency.omega, getattr(frequency, what), left=np.nan, right=np.nan)


def _within(far: float, curve: Array) -> Array:
    """The curve of a loop that diverges is drawn no farther than this."""
    return np.where(np.abs(curve) <= far, curve, np.nan)


def _room_for(study: Study, limit: float) -> float:
    """The ideal signal may start with a spike that would flatten everything else; beyond this it is left out."""
    return 1.5 * max(float(np.max(np.abs(study.board.u))), 0.0 if np.isnan(limit) else limit, 1e-6)


def _marks(board: Response, setpoint: float) -> tuple[Array, Array, Array]:
    """Peak, rise and settling as points on the curve; NaN elsewhere."""
    metrics = board.metrics
    progress = board.y / setpoint
    first = [int(np.argmax(progress >= level)) for level in (0.1, 0.9) if (progress >= level).any()]
    settled = [int(np.searchsorted(board.t, metrics.settling_s))] if np.isfinite(metrics.settling_s) else []
    peak = [int(np.argmax(board.y))] if metrics.overshoot_pct > 0.05 else []
    return _points(board, peak), _points(board, first), _points(board, settled)


def _points(board: Response, indices: list[int]) -> Array:
    marks = np.full_like(board.y, np.nan)
    for index in indices:
        if index < len(marks):
            marks[index] = board.y[index]
    return marks


def _nearest_mark(omega: Array, at: float) -> NDArray[np.bool_]:
    """True at the grid point next to a frequency."""
    if not omega[0] <= at <= omega[-1]:
        return np.zeros(len(omega), dtype=bool)
    return np.arange(len(omega)) == int(np.argmin(np.abs(np.log(omega / at))))


def _scatter(groups: list[NDArray[np.complex128]]) -> tuple[Array, ...]:
    """Points of several groups over one axis in ascending order; NaN where a point is another group's. The axis
    goes on a little to either side, and beyond 0, where a loop becomes unstable."""
    points = np.concatenate(groups)
    owner = np.repeat(np.arange(len(groups)), [len(group) for group in groups])
    order = np.argsort(points.real, kind="stable")
    x, y, owner = points.real[order], points.imag[order], owner[order]
    margin = 0.08 * max(float(x.max(initial=0.0) - x.min(initial=0.0)), 1e-3)
    x = np.concatenate([[x.min(initial=0.0) - margin], x, [x.max(initial=0.0) + margin]])
    columns = [np.where(owner == k, y, np.nan) for k in range(len(groups))]
    return x, *(np.concatenate([[np.nan], column, [np.nan]]) for column in columns)
