"""The PID as a microcontroller computes it, once a period: sampled, saturated, with or without anti-windup.

Backward Euler replaces s by (1 - 1/z) / h, Tustin by 2 (1 - 1/z) / (h (1 + 1/z)).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from app.control.pid import Pid

Method = Literal["backward Euler", "Tustin"]
AntiWindup = Literal["none", "clamping", "back-calculation"]

ControlLaw = Callable[[float, float], float]
"""(set-point, measurement) -> output; to be called once a period, it remembers."""


@dataclass(frozen=True)
class Sampling:
    """How a controller is turned into a program."""

    period_s: float = 0.01
    method: Method = "backward Euler"
    anti_windup: AntiWindup = "none"


def sampled_pid(pid: Pid, sampling: Sampling, u_max: float = math.inf, start: float = 0.0) -> ControlLaw:
    """A program whose output is limited to +-`u_max` and which is at rest while set-point and drive are at `start`.

    Clamping leaves the integral as it was while the output is limited and the error would push it further.
    Back-calculation lets it forget what the limit cut off, within the tracking time sqrt(Ti Td) (Ti for a PI).
    """
    kp, b, c = pid.kp, pid.b, pid.c
    integrate_new, integrate_old = _integral_weights(pid, sampling)
    keep, differentiate = _derivative_weights(pid, sampling)
    clamping = sampling.anti_windup == "clamping"
    forget = sampling.period_s / _tracking_time_s(pid) if sampling.anti_windup == "back-calculation" else 0.0
    integral, last_slope = kp * (1.0 - b) * start, (c - 1.0) * start
    derivative = last_error = 0.0

    def law(r: float, y: float) -> float:
        nonlocal integral, derivative, last_error, last_slope
        error, slope = r - y, c * r - y
        growth = integrate_new * error + integrate_old * last_error
        derivative = keep * derivative + differentiate * (slope - last_slope)
        last_error, last_slope = error, slope
        wanted = kp * (b * r - y) + integral + growth + derivative
        if -u_max <= wanted <= u_max:
            integral += growth
            return wanted
        u = u_max if wanted > 0.0 else -u_max
        if not (clamping and growth * wanted > 0.0):
            integral += growth + forget * (u - wanted)
        return u

    return law


def _integral_weights(pid: Pid, sampling: Sampling) -> tuple[float, float]:
    """Of the new and the last error in one period's growth of the integral."""
    step = pid.ki * sampling.period_s
    return (step, 0.0) if sampling.method == "backward Euler" else (step / 2, step / 2)


def _derivative_weights(pid: Pid, sampling: Sampling) -> tuple[float, float]:
    """Of the last derivative and of the change in what is differentiated. kd N s / (s + N), or kd s."""
    h, kd, n = sampling.period_s, pid.kd, pid.n
    if not kd:
        return 0.0, 0.0
    if sampling.method == "backward Euler":
        return (1.0 / (1.0 + n * h), kd * n / (1.0 + n * h)) if math.isfinite(n) else (0.0, kd / h)
    return ((2.0 - n * h) / (2.0 + n * h), 2.0 * kd * n / (2.0 + n * h)) if math.isfinite(n) else (-1.0, 2.0 * kd / h)


def _tracking_time_s(pid: Pid) -> float:
    if not pid.ki:
        return math.inf
    Ti, Td = abs(pid.Ti), abs(pid.Td)
    return math.sqrt(Ti * Td) if Td else max(Ti, 1e-9)
