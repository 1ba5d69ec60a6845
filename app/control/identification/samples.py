"""Measured input and output, checked and brought onto an even grid of samples."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

FEWEST_SAMPLES = 20
EVEN = 1e-6
"""Deviation from the even grid, in periods, that is mere rounding."""
JITTER = 0.5
"""Deviation from the typical step, in periods, that interpolation may repair; more is a gap."""


FASTEST_S, SLOWEST_S = 1e-6, 1.0
"""Sampling periods that make sense; 10 s are usually milliseconds taken for seconds."""
TINY, HUGE = 1e-9, 1e9
"""Volts and outputs below the first are nothing, above the second nonsense."""


class IdentificationError(ValueError):
    """Data from which no motor can be found; the message is one sentence saying why and what to do."""


class Samples(NamedTuple):
    """Evenly spaced measurements."""

    t: Array
    """(n,) s."""
    u: Array
    """(n,) V, each held until the next sample."""
    y: Array
    """(n,) in the motor's unit."""
    period_s: float


def even_samples(t: ArrayLike, u: ArrayLike, y: ArrayLike) -> Samples:
    """Check (n,) times in s, volts and outputs; interpolate if the times jitter by up to half a period.

    The output is interpolated linearly. The input, held from each measured time to the next, is averaged over
    each even period, which keeps its volt-seconds. IdentificationError for data that cannot be used.
    """
    t, u, y = (np.array(column, dtype=float) for column in (t, u, y))
    _check_columns(t, u, y)
    steps = np.diff(t)
    _check_times(t, steps)
    period_s = float(t[-1] - t[0]) / len(steps)
    grid = t[0] + period_s * np.arange(len(t))
    if np.abs(t - grid).max() <= EVEN * period_s:
        return Samples(t, u, y, period_s)
    volt_seconds = np.concatenate([[0.0], np.cumsum(u[:-1] * steps)])
    held = np.diff(np.interp(grid, t, volt_seconds)) / period_s
    return Samples(grid, np.append(held, u[-1]), np.interp(grid, t, y), period_s)


def _check_columns(t: Array, u: Array, y: Array) -> None:
    if t.ndim != 1 or not t.shape == u.shape == y.shape:
        raise IdentificationError("Time, voltage and output must be three columns of the same length.")
    if len(t) < FEWEST_SAMPLES:
        raise IdentificationError(f"There are only {len(t)} samples: record at least {FEWEST_SAMPLES}.")
    if not all(np.isfinite(column).all() for column in (t, u, y)):
        raise IdentificationError("A value is missing or not finite: delete its row.")
    if max(np.abs(u).max(), np.abs(y).max()) > HUGE:
        raise IdentificationError("A voltage or an output is absurdly large: delete its row.")
    if np.abs(u[:-1]).max() < TINY:
        raise IdentificationError("The voltage is always zero: drive the motor while recording.")
    if np.ptp(y) < TINY:
        raise IdentificationError("The output never changes: check that the motor turns and the sensor is connected.")


def _check_times(t: Array, steps: Array) -> None:
    if not (steps > 0.0).all():
        late = t[int(np.argmin(steps > 0.0))]
        raise IdentificationError(f"The time does not increase after {late:g} s: sort the rows, delete repeated ones.")
    typical = float(np.median(steps))
    if not FASTEST_S <= typical <= SLOWEST_S:
        raise IdentificationError(f"The samples are {typical:.4g} s apart: give the times in seconds, below 1 s apart.")
    uneven = np.abs(steps / typical - 1.0) > JITTER
    if uneven.any():
        where = t[int(np.argmax(uneven))]
        raise IdentificationError(
            f"The step after {where:g} s is not the usual {typical:.4g} s: record without gaps, or keep one even part."
        )
