"""What a motor does under a given voltage, without feedback: exact at the samples, as fast as a filter."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.control.motor import Motor


def open_loop(motor: Motor, u: ArrayLike, period_s: float, y0: float = 0.0, v0: float = 0.0) -> NDArray[np.float64]:
    """(n,) output in the motor's unit at the samples of (n,) `u` in volts, each held for `period_s`.

    `y0` and `v0` are output and speed at the first sample. The state x+ = A x + B u of `Motor.zoh`, written as
    y[k+2] - tr(A) y[k+1] + det(A) y[k] = b1 u[k+1] + (a12 b2 - a22 b1) u[k].
    """
    from scipy.signal import lfilter

    step = motor.zoh(period_s)
    numerator, denominator = step.polynomials
    memory = [y0, step.a12 * v0 - step.a22 * y0]
    y, _ = lfilter([0.0, *numerator], denominator, np.asarray(u, dtype=float), zi=memory)
    return np.asarray(y)
