"""What a student should know before trusting an identified motor, in plain sentences."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from app.control.identification.output_error import Found, fit_percent, usual_response
from app.control.identification.samples import Samples

Array = NDArray[np.float64]

LONG_ENOUGH_S = 20.0
POOR_FIT_PERCENT = 50.0
OPPOSED = -0.5
"""Correlation of the output with a typical motor's from which it is taken to be the wrong way round."""
WIDE = 0.1
"""Half-width of a confidence interval, as a part of the value, from which it is called wide."""
LAGS = 20
CHANCE = 4.0
"""Standard deviations of a white residual's autocorrelation: passed by chance in one of 800 tests of 20 lags."""
ROUNDING = 1e-6
"""Residuals below this part of the output's range come from arithmetic, which is never white."""


def data_advice(data: Samples, assumes_rest: bool) -> list[str]:
    """Doubts about the recording itself."""
    advice = []
    duration_s = len(data.t) * data.period_s
    if duration_s < LONG_ENOUGH_S * (1.0 - 1e-3):
        advice.append(
            f"Only {duration_s:.3g} s of data: a slow pole of 20 s, as the Par4's motor has, is poorly seen; "
            f"record at least {LONG_ENOUGH_S:g} s."
        )
    if np.ptp(data.u[:-1]) == 0.0:
        advice.append("The voltage never changes: switch it to and fro, so that the motor shows more of itself.")
    if assumes_rest and abs(data.y[0]) > 0.05 * np.ptp(data.y):
        advice.append("The output does not start at zero: let the initial state be estimated too.")
    return advice


def fit_advice(found: Found, half_widths: Array, data: Samples) -> list[str]:
    """Doubts about the K, T1, T2 found, with the (3,) half-widths of their intervals, and about the residuals."""
    fit = fit_percent(found.residuals, data)
    if fit < POOR_FIT_PERCENT and np.corrcoef(usual_response(data), data.y)[0, 1] < OPPOSED:
        return ["The output moves against the voltage: swap the motor's wires or change the sign of the output."]
    if fit < POOR_FIT_PERCENT:
        return [f"The model explains only {max(fit, 0.0):.0f} % of the movement: do not trust it yet."]
    named = zip(("K", "T1", "T2"), found.parameters.tolist(), half_widths.tolist(), strict=False)
    advice = [_width(name, value, half) for name, value, half in named if half > WIDE * value]
    if np.sqrt(np.mean(found.residuals**2)) > ROUNDING * np.ptp(data.y):
        advice += _whiteness(found.residuals)
    if not found.settled:
        advice.append("The search stopped before it had settled: start it again from the values found.")
    return advice


def autocorrelation(residuals: Array, lags: int = LAGS) -> Array:
    """(lags,) autocorrelation at lags 1, 2, ...; for white noise each is about normal with variance 1 / n."""
    n = len(residuals)
    lags = min(lags, n - 1)
    return np.array([residuals[lag:] @ residuals[: n - lag] for lag in range(1, lags + 1)]) / (residuals @ residuals)


def _width(name: str, value: float, half_width: float) -> str:
    if name == "T2" and half_width >= value:
        return "T2 cannot be told from 0: this motor may well be an integrator, which keeps turning and does not droop."
    return f"{name} is known only to ±{100.0 * half_width / value:.0f} %: record longer, or move the motor more."


def _whiteness(residuals: Array) -> list[str]:
    r = autocorrelation(residuals)
    worst = int(np.argmax(np.abs(r)))
    if abs(r[worst]) <= CHANCE / np.sqrt(len(residuals)):
        return []
    return [
        f"The residuals are not white (correlation {r[worst]:.2f} at lag {worst + 1}): the model misses something, "
        "perhaps friction or backlash, and the true uncertainty is larger than the intervals say."
    ]
