"""How good a step response is, in the numbers that papers and data sheets use."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

BAND = 0.02
"""Settled within this share of the step."""


@dataclass(frozen=True)
class StepMetrics:
    """Times in s, `peak` and `steady_state_error` in the unit of the output; NaN for what never happens."""

    overshoot_pct: float
    """Of the step; 0 without overshoot."""
    rise_s: float
    """From 10 to 90 % of the step."""
    settling_s: float
    """After which the output stays within 2 % of the step around the set-point."""
    peak: float
    peak_s: float
    steady_state_error: float
    """Set-point minus mean output over the last twentieth of the record."""
    ise: float
    """Integral of the squared error, unit^2 s."""
    iae: float
    """Integral of the absolute error, unit s."""
    itae: float
    """The same weighted with time, unit s^2."""
    control_energy: float
    """Integral of the squared control signal, V^2 s."""
    saturation_pct: float
    """Share of the time that the control signal stands at its limit."""


@np.errstate(over="ignore", invalid="ignore")  # a loop may diverge
def step_metrics(t: ArrayLike, y: ArrayLike, setpoint: float, u: ArrayLike, u_max: float = math.inf) -> StepMetrics:
    """Metrics of a step from 0 to `setpoint` (not 0) at t[0]; all arrays (k,), evenly spaced times in s."""
    time, output, control = (np.asarray(values, dtype=float) for values in (t, y, u))
    progress, error = output / setpoint, setpoint - output
    top = int(np.argmax(progress))
    tail = max(1, len(time) // 20)
    return StepMetrics(
        overshoot_pct=100.0 * max(float(progress[top]) - 1.0, 0.0),
        rise_s=_first_crossing(time, progress, 0.9) - _first_crossing(time, progress, 0.1),
        settling_s=_settling(time, progress),
        peak=float(output[top]),
        peak_s=float(time[top] - time[0]),
        steady_state_error=float(np.mean(error[-tail:])),
        ise=float(np.trapezoid(error**2, time)),
        iae=float(np.trapezoid(np.abs(error), time)),
        itae=float(np.trapezoid(np.abs(error) * (time - time[0]), time)),
        control_energy=float(np.trapezoid(control**2, time)),
        saturation_pct=100.0 * float(np.mean(np.abs(control) >= u_max * (1.0 - 1e-9))) if u_max < math.inf else 0.0,
    )


def _first_crossing(t: Array, progress: Array, level: float) -> float:
    """Time at which a share of the step is first reached, between the samples; NaN if never."""
    above = progress >= level
    k = int(np.argmax(above))
    if not above[k]:
        return math.nan
    if k == 0:
        return float(t[0])
    share = (level - progress[k - 1]) / (progress[k] - progress[k - 1])
    return float(t[k - 1] + share * (t[k] - t[k - 1]))


def _settling(t: Array, progress: Array) -> float:
    outside = np.flatnonzero(~(np.abs(progress - 1.0) <= BAND))
    if not outside.size:
        return 0.0
    return float(t[outside[-1] + 1] - t[0]) if outside[-1] + 1 < len(t) else math.nan
