"""The smallest phase margin of a PID loop, quickly and with the exact delay: cheap enough to follow a slider.

All gain crossovers come from |C G|^2 = 1, a polynomial in w^2; a delay turns the phase without moving them.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

from app.control.frequency import Array, open_loop_polynomials
from app.control.motor import Motor
from app.control.pid import Pid


def smallest_margin(pid: Pid, motor: Motor, delay_s: float = 0.0) -> tuple[float, float]:
    """(crossover rad/s, phase margin deg) where the margin is smallest; a margin <= 0 means unstable.

    A loop that is stable without delay stays so until the delay eats the margin at one of its crossovers.
    (nan, -inf) if it is unstable even without delay or its gain is never one. Set-point weights do not matter.
    """
    under, over = open_loop_polynomials(motor, pid)
    if np.roots(np.polyadd(over, under)).real.max() >= 0.0:
        return math.nan, -math.inf
    squares = np.roots(np.polyadd(_gain_squared(over), -_gain_squared(under)))
    crossovers = [math.sqrt(x.real) for x in squares.tolist() if x.real > 0.0 and abs(x.imag) <= 1e-6 * x.real]
    margins = [(margin_at(w, pid, motor, delay_s), w) for w in crossovers]
    margin, w = min(margins, default=(-math.inf, math.nan))
    return w, margin


def margin_at(w: float, pid: Pid, motor: Motor, delay_s: float = 0.0) -> float:
    """180 deg + arg(C G) at w rad/s, the delay included; a phase margin if the gain is one there."""
    derivative = pid.kd * 1j * w / (1.0 + 1j * w / pid.n)
    controller = complex(pid.kp, -pid.ki / w) + derivative
    return 180.0 + math.degrees(cmath.phase(controller) + cmath.phase(plant_at(w, motor)) - w * delay_s)


def plant_at(w: float, motor: Motor) -> complex:
    """G(jw) without delay; its phase is from -180 deg to 0."""
    return motor.K / complex(motor.T2 - w * w, motor.T1 * w)


def _gain_squared(polynomial: Array) -> Array:
    """|p(jw)|^2 as a polynomial in w^2: p(s) p(-s) has even powers only, and s^2 = -w^2. Highest power first."""
    odd = polynomial.copy()
    odd[-2::-2] *= -1.0
    even = np.convolve(polynomial, odd)[::2]
    even[-2::-2] *= -1.0
    return even
