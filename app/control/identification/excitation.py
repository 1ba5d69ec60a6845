"""Input voltages for identifying a motor, each on a grid of samples.

Every signal takes (amplitude_v, duration_s, period_s), where `period_s` is the sampling period, and gives
(t, u): (n,) times in seconds from 0 and (n,) volts, each held until the next sample; n = duration_s / period_s.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.control.motor import PAR4_MOTOR, Motor

Array = NDArray[np.float64]
Signal = Callable[[float, float, float], tuple[Array, Array]]

STAIRS = np.array([1.0, 0.0, -1.0, 0.0, 0.5, -0.5, 1.0, -1.0])
PULSES = np.array([1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0, 0.0])
"""There, back, to the other side, back: the joint stays within one pulse's travel of its start."""

MARGIN = 0.8
"""Part of the permitted swing that pulses use; the rest is for a motor stronger than the model."""


@dataclass(frozen=True)
class Excitation:
    """A signal a student can choose."""

    title: str
    explanation: str
    signal: Signal
    """(amplitude_v, duration_s, period_s) -> (t, u)."""


def step(amplitude_v: float, duration_s: float, period_s: float) -> tuple[Array, Array]:
    """The full voltage from the first sample on. ValueError for an impossible grid, as in every signal."""
    t = _grid(duration_s, period_s)
    return t, np.full(len(t), float(amplitude_v))


def square(amplitude_v: float, duration_s: float, period_s: float, *, cycle_s: float = 8.0) -> tuple[Array, Array]:
    """Plus and minus in turn, half of `cycle_s` each."""
    t = _grid(duration_s, period_s)
    return t, _held([amplitude_v, -amplitude_v], len(t), _samples(cycle_s / 2, period_s))


def prbs(
    amplitude_v: float, duration_s: float, period_s: float, *, hold_s: float = 0.5, seed: int = 0
) -> tuple[Array, Array]:
    """Pseudo-random binary sequence: plus or minus, drawn anew every `hold_s`; the same for the same seed."""
    t = _grid(duration_s, period_s)
    hold = _samples(hold_s, period_s)
    signs = np.random.default_rng(seed).choice([-1.0, 1.0], size=math.ceil(len(t) / hold))
    return t, _held(amplitude_v * signs, len(t), hold)


def staircase(amplitude_v: float, duration_s: float, period_s: float) -> tuple[Array, Array]:
    """Eight levels of equal length, full and half voltage both ways with rests between."""
    t = _grid(duration_s, period_s)
    level = np.arange(len(t)) * len(STAIRS) // len(t)
    return t, amplitude_v * STAIRS[level]


def pulses(
    amplitude_v: float, duration_s: float, period_s: float, *, swing_deg: float = 45.0, motor: Motor = PAR4_MOTOR
) -> tuple[Array, Array]:
    """Pulses and rests that keep a mounted joint within `swing_deg` to either side of where it starts.

    A pulse of w seconds turns a motor without droop by K U w / T1, and droop only takes away. `swing_deg` is in
    the motor's unit. ValueError when one sample of the voltage is already too much.
    """
    t = _grid(duration_s, period_s)
    speed = motor.K * abs(amplitude_v) / motor.T1
    longest_s = MARGIN * swing_deg / speed if speed else duration_s
    # Two whole patterns fit in any test, so that a weak voltage is seen both ways as well.
    width = int(min(longest_s, duration_s / (2 * len(PULSES))) / period_s + 1e-9)
    if width < 1:
        raise ValueError("these pulses would be shorter than one sample: lower the voltage or lengthen the test")
    return t, _held(amplitude_v * PULSES, len(t), width)


def _grid(duration_s: float, period_s: float) -> Array:
    """(n,) sample times; the end itself is not one of them."""
    if not 0.0 < period_s <= duration_s < math.inf:
        raise ValueError("an excitation needs a positive sampling period that is no longer than its duration")
    return np.arange(round(duration_s / period_s), dtype=np.float64) * np.float64(period_s)


def _samples(length_s: float, period_s: float) -> int:
    return max(1, round(length_s / period_s))


def _held(levels: Array | list[float], count: int, hold: int) -> Array:
    """(count,) the levels over and over, each for `hold` samples."""
    return np.asarray(levels, dtype=float)[np.arange(count) // hold % len(levels)]


EXCITATIONS: dict[str, Excitation] = {
    "step": Excitation("Step", "One voltage, held: easy to read by eye, but it shows the motor only once.", step),
    "square": Excitation("Square wave", "Full voltage to and fro, 4 s each: a free shaft turns 110 degrees.", square),
    "prbs": Excitation("Random switching (PRBS)", "To or fro by chance every 0.5 s: fast and slow in one test.", prbs),
    "steps": Excitation("Staircase", "Eight levels with rests: shows whether half the voltage does half.", staircase),
    "pulses": Excitation("Short pulses", "Kicks both ways that keep a mounted arm within 45 degrees.", pulses),
}
"""By the name used in files and on the page."""
