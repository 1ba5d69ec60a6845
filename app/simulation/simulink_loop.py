"""One drive as the paper simulated it: a continuous loop in Simulink, solver ode3 with a fixed step.

What the paper leaves open was found by reproducing all eight numbers of its Table 4: ode3 is Bogacki-Shampine's
rule of third order; drive and controller start at rest; the output is limited without anti-windup; the integral
of the squared error is computed by the same solver. A controller with an ideal derivative uses Simulink's
Derivative block: the change since the last full step, 0 in the first one, so that there is no kick.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from app.control import Motor, Pid

STAGES = (0.0, 0.5, 0.75)
"""Where within a step ode3 looks at the loop."""


class Trace(NamedTuple):
    """What one drive did; one value a full step."""

    y: list[float]
    """Output, in the motor's unit."""
    u: list[float]
    """Control signal."""
    ise: float
    """Integral of the squared error, unit^2 s."""


Derivative = Callable[[float, float, float, float], tuple[float, float]]
"""(error, state, error at the last full step, time since then) -> derivative part, rate of the state"""


def simulate(
    motor: Motor, pid: Pid, u_max: float, step_s: float, references: Sequence[Sequence[float]], start: float = 0.0
) -> Trace:
    """One drive from rest at `start`.

    `references` holds three sequences of equal length, the set-point at `STAGES` of every step, in the motor's
    unit. Set-point weights are not part of the paper's loop and do not count.
    """
    K, T1, T2, kp, ki, h = motor.K, motor.T1, motor.T2, pid.kp, pid.ki, step_s
    derivative = _derivative(pid)

    def rates(e: float, y: float, v: float, xi: float, xd: float, last: float, since: float) -> tuple[float, ...]:
        d, xd_rate = derivative(e, xd, last, since)
        u = kp * e + xi + d
        u = u_max if u > u_max else -u_max if u < -u_max else u
        return v, K * u - T1 * v - T2 * y, ki * e, xd_rate, u

    y, v, xi, xd, ise, last, since = start, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    outputs, controls = [], []
    half, most, w1, w2, w3 = h / 2, 0.75 * h, 2 * h / 9, h / 3, 4 * h / 9
    for r1, r2, r3 in zip(*references, strict=True):
        e1 = r1 - y
        y1, v1, i1, d1, u = rates(e1, y, v, xi, xd, last, since)
        outputs.append(y)
        controls.append(u)
        last, since = e1, h
        ya = y + half * y1
        e2 = r2 - ya
        y2, v2, i2, d2, _ = rates(e2, ya, v + half * v1, xi + half * i1, xd + half * d1, e1, half)
        yb = y + most * y2
        e3 = r3 - yb
        y3, v3, i3, d3, _ = rates(e3, yb, v + most * v2, xi + most * i2, xd + most * d2, e1, most)
        y += w1 * y1 + w2 * y2 + w3 * y3
        v += w1 * v1 + w2 * v2 + w3 * v3
        xi += w1 * i1 + w2 * i2 + w3 * i3
        xd += w1 * d1 + w2 * d2 + w3 * d3
        ise += w1 * e1 * e1 + w2 * e2 * e2 + w3 * e3 * e3
    return Trace(outputs, controls, ise)


def _derivative(pid: Pid) -> Derivative:
    """N (kd e - x) with x' = N (kd e - x), or Simulink's block for an ideal derivative."""
    kd, n = pid.kd, pid.n
    if math.isfinite(n):

        def filtered(e: float, xd: float, last: float, since: float) -> tuple[float, float]:
            d = n * (kd * e - xd)
            return d, d

        return filtered

    def differenced(e: float, xd: float, last: float, since: float) -> tuple[float, float]:
        return (kd * (e - last) / since if since else 0.0), 0.0

    return differenced
