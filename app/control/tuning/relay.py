"""Relay autotuning: let a relay shake the motor, and read the ultimate gain and period off the oscillation.

Astrom and Hagglund 1984: a relay of amplitude d in the place of the controller makes the loop oscillate near its
phase crossover. A swing of amplitude a then means Ku = 4 d / (pi sqrt(a^2 - eps^2)), eps being the hysteresis. A
second-order motor alone has no phase crossover; the hold of the sampled loop and the delay give it one.

The formula takes the swing for a sine. It is not quite one, so that Tu comes out about 5 % long and Ku 5 to 10 % low.
Hysteresis holds noise off but makes the swing slower than the ultimate one: keep it well below a.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.control.motor import Motor
from app.control.pid import Pid
from app.control.tuning.reaction_curve import TuningError
from app.control.tuning.rules import DEFAULT_N

Array = NDArray[np.float64]

MIN_CYCLES = 3
"""Fewer whole swings in the second half of a test say nothing of a steady oscillation."""


@dataclass(frozen=True, eq=False)
class RelayTest:
    """A recorded relay test of n samples, and what it says."""

    t: Array
    """(n,) s."""
    u: Array
    """(n,) V, held from each sample to the next."""
    y: Array
    """(n,) unit, about the set-point."""
    amplitude: float
    """d, V."""
    hysteresis: float
    """eps, unit."""
    Ku: float
    """Ultimate gain, V / unit."""
    Tu: float
    """Ultimate period, s."""

    def ziegler_nichols(self, n: float = DEFAULT_N) -> Pid:
        """Ziegler and Nichols 1942: kp = 0.6 Ku, Ti = Tu / 2, Td = Tu / 8. Quick, lively."""
        return Pid.ideal(0.6 * self.Ku, 0.5 * self.Tu, 0.125 * self.Tu, n)

    def tyreus_luyben(self, n: float = DEFAULT_N) -> Pid:
        """Tyreus and Luyben 1992: kp = Ku / 2.2, Ti = 2.2 Tu, Td = Tu / 6.3. Calm, a slow integral."""
        return Pid.ideal(self.Ku / 2.2, 2.2 * self.Tu, self.Tu / 6.3, n)


def relay_test(
    motor: Motor,
    amplitude: float = 6.0,
    hysteresis: float = 0.0,
    *,
    delay_s: float = 0.0,
    period_s: float = 0.01,
    duration_s: float = 10.0,
) -> RelayTest:
    """Simulate the sampled loop and measure its oscillation over the second half of the test.

    `amplitude` in V, `hysteresis` in the motor's unit; `delay_s` counts in whole sampling periods.
    Raises `TuningError` if no steady oscillation comes about, ValueError for a relay without amplitude.
    """
    if amplitude <= 0.0 or hysteresis < 0.0 or delay_s < 0.0:
        raise ValueError("a relay needs an amplitude above zero, and no negative hysteresis or delay")
    u, y = _simulate(motor, amplitude, hysteresis, round(delay_s / period_s), period_s, round(duration_s / period_s))
    rises = _rises(u)
    rises = rises[rises >= u.size // 2]
    if rises.size <= MIN_CYCLES:
        raise TuningError("The relay did not make a steady swing: give it more volts, less hysteresis or more time.")
    swings = y[rises[0] : rises[-1]]
    swing = float(swings.max() - swings.min()) / 2.0
    if swing <= hysteresis:
        raise TuningError("The swing is no larger than the hysteresis: give the relay more volts or less hysteresis.")
    Ku = 4.0 * amplitude / (math.pi * math.sqrt(swing * swing - hysteresis * hysteresis))
    Tu = period_s * float(rises[-1] - rises[0]) / (rises.size - 1)
    t = np.arange(u.size, dtype=np.float64) * period_s
    return RelayTest(t, u, y, amplitude, hysteresis, Ku, Tu)


def _simulate(
    motor: Motor, amplitude: float, hysteresis: float, delay: int, period_s: float, samples: int
) -> tuple[Array, Array]:
    """(u, y), each (samples,), from rest; plain floats because an array a step costs ten times as much."""
    a11, a12, a21, a22, b1, b2 = motor.zoh(period_s)
    y, v, u = 0.0, 0.0, amplitude
    on_the_way = deque([0.0] * delay)
    inputs, outputs = [], []
    for _ in range(samples):
        if (y > hysteresis and u > 0.0) or (y < -hysteresis and u < 0.0):
            u = -u
        inputs.append(u)
        outputs.append(y)
        on_the_way.append(u)
        arriving = on_the_way.popleft()
        y, v = a11 * y + a12 * v + b1 * arriving, a21 * y + a22 * v + b2 * arriving
    return np.array(inputs), np.array(outputs)


def _rises(u: Array) -> NDArray[np.intp]:
    """The samples at which the relay went from minus to plus."""
    return np.flatnonzero((u[1:] > 0.0) & (u[:-1] < 0.0)) + 1
