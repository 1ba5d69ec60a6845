"""The reaction curve: the tangent at the inflection of a step response, and what it says of the motor.

The tangent leaves zero after the delay T0 and reaches the final value k after a further T, so that the motor
looks like k e^(-T0 s) / (T s + 1) to the rules of `rules`. Table 3 of Laski & Smykowski 2021 is read
off such a curve.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.control.motor import PAR4_MOTOR, Motor

PAPER_PERIOD_S = 0.01
PAPER_DURATION_S = 144.80
"""Where the paper's step response must have ended for its gain to be 52.5561."""

SETTLED_SHARE = 0.05
"""A recording whose last tenth still climbs faster than this share of the steepest slope has no final value."""


class TuningError(ValueError):
    """A method cannot be used on this motor; the message is one sentence with what to use instead."""


@dataclass(frozen=True)
class ReactionCurve:
    """The tangent at the inflection of a step response, per volt."""

    k: float
    """Gain, unit / V."""
    T0: float
    """Delay, s: where the tangent leaves zero."""
    T: float
    """Time constant, s: how long the tangent takes from zero to k."""
    t_inflection: float
    """s."""
    y_inflection: float
    """unit / V."""
    slope: float
    """Of the tangent, unit / (V s)."""

    @classmethod
    def through(cls, k: float, t_inflection: float, y_inflection: float, slope: float) -> ReactionCurve:
        """The curve with final value k whose tangent touches (t_inflection, y_inflection)."""
        return cls(k, t_inflection - y_inflection / slope, k / slope, t_inflection, y_inflection, slope)


def exact(motor: Motor) -> ReactionCurve:
    """From the model itself. With poles -a, -b (a <= b) the steepest moment is t = ln(b/a) / (b - a).

    There y' = K e^(-a t) / b, and y'' = 0 leaves T1 y' + T2 y = K for the height.
    Raises `TuningError` if the step has no final value (T2 = 0) or overshoots it.
    """
    a, b = real_poles(motor)
    if a == 0.0:
        raise TuningError("This motor keeps turning under a constant voltage, its step has no final value: use SIMC.")
    spread = (b - a) / a
    t = math.log1p(spread) / (b - a) if spread else 1.0 / a
    slope = motor.K * math.exp(-a * t) / b
    return ReactionCurve.through(motor.dc_gain, t, (motor.K - motor.T1 * slope) / motor.T2, slope)


def real_poles(motor: Motor) -> tuple[float, float]:
    """(a, b), 0 <= a <= b in rad/s, the poles being -a and -b. Raises `TuningError` if they are not so."""
    discriminant = motor.T1 * motor.T1 - 4.0 * motor.T2
    if motor.T1 <= 0.0 or motor.T2 < 0.0:
        raise TuningError("This motor is unstable by itself, and no step test can describe it: check T1 and T2.")
    if discriminant < 0.0:
        raise TuningError("This motor overshoots by itself, which a delay and a lag cannot describe: use loop shaping.")
    b = (motor.T1 + math.sqrt(discriminant)) / 2.0
    return motor.T2 / b, b


def from_step(t: ArrayLike, y: ArrayLike, step_v: float = 1.0) -> ReactionCurve:
    """From a recorded step: t (n,) s and y (n,) unit, from rest at y = 0, after `step_v` volts at t = 0.

    The slope is the steepest between two neighbouring samples, k the last sample; noise should be filtered out
    before. Raises `TuningError` if the recording has not settled or is steepest at once.
    """
    if not step_v:
        raise ValueError("a step of 0 V says nothing of the motor")
    times, values = np.asarray(t, dtype=float), np.asarray(y, dtype=float) / step_v
    if times.ndim != 1 or times.shape != values.shape or times.size < 3:
        raise ValueError("t and y must be two rows of the same length, of three samples or more")
    slopes = np.diff(values) / np.diff(times)
    steepest = int(np.argmax(slopes))
    slope, last_slope = float(slopes[steepest]), _climb_at_end(times, values)
    if values[-1] <= 0.0 or slope <= 0.0:
        raise TuningError("The output does not follow the voltage upwards: swap the motor's wires or the sign.")
    if last_slope > SETTLED_SHARE * slope:
        raise TuningError("The output is still climbing at the end: record for longer, or use SIMC if it never stops.")
    curve = ReactionCurve.through(float(values[-1]), float(times[steepest]), float(values[steepest]), slope)
    if steepest == 0 or curve.T0 <= 0.0:
        raise TuningError("The response is steepest at once, so there is no delay to read off: use loop shaping.")
    return curve


def _climb_at_end(t: NDArray[np.float64], y: NDArray[np.float64]) -> float:
    """Mean slope over the last tenth of a recording."""
    start = min(int(0.9 * t.size), t.size - 2)
    return float((y[-1] - y[start]) / (t[-1] - t[start]))


@cache
def paper_reaction_curve() -> ReactionCurve:
    """The curve behind Table 3: k 52.5561, T0 0.2445, T 20.9963. The paper's motor, sampled at 0.01 s for 144.80 s."""
    step = PAR4_MOTOR.zoh(PAPER_PERIOD_S)
    y, v, samples = 0.0, 0.0, [0.0]
    for _ in range(round(PAPER_DURATION_S / PAPER_PERIOD_S)):
        y, v = step.a11 * y + step.a12 * v + step.b1, step.a21 * y + step.a22 * v + step.b2
        samples.append(y)
    return from_step(PAPER_PERIOD_S * np.arange(len(samples)), samples)
