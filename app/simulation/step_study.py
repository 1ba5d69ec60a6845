"""One drive after a step of its set-point: as the board does it, beside the ideal loop of the textbook."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.control import Motor
from app.control.frequency import OpenLoop
from app.control.margins import Margins, margins
from app.control.step_metrics import StepMetrics, step_metrics
from app.simulation.sampled_loop import DriveLoop, fewest_substeps, simulate

Array = NDArray[np.float64]

POINTS = 300
"""About this many points make a curve that looks smooth in a panel."""

NEARLY_IDEAL = 40.0
"""An ideal derivative is drawn as one that is filtered this many times above the crossover's usual place."""

MAX_PERIODS = 60_000


@dataclass(frozen=True)
class Question:
    """What is to be looked at."""

    loop: DriveLoop
    setpoint: float
    """Height of the step, in the motor's unit."""
    duration_s: float = 3.0
    seed: int = 0


class Response(NamedTuple):
    """Curves over time, and what they amount to."""

    t: Array
    """(k,) s"""
    y: Array
    """(k,) output, in the motor's unit."""
    u: Array
    """(k,) control signal, V."""
    metrics: StepMetrics


class Frequency(NamedTuple):
    """The open loop over frequency, its margins, and the poles of the closed one."""

    omega: Array
    """(m,) rad/s"""
    gain_db: Array
    """(m,); NaN above the frequency up to which a sampled loop has a meaning."""
    phase_deg: Array
    """(m,) unwrapped."""
    margins: Margins
    poles: NDArray[np.complex128]
    """rad/s"""


class Study(NamedTuple):
    """The answer."""

    board: Response
    """Sampled, with all imperfections that are switched on."""
    ideal: Response
    """Continuous and linear, without any."""
    board_frequency: Frequency
    ideal_frequency: Frequency


def study(question: Question) -> Study:
    """Everything about one loop, in a few milliseconds."""
    loop = question.loop
    continuous = OpenLoop(loop.motor, loop.pid)
    hardware = loop.hardware
    real_motor = loop.motor.loaded(hardware.inertia_factor, hardware.viscous)
    sampled = OpenLoop(real_motor, loop.pid, hardware.delay_s, loop.sampling)
    ideal_margins = margins(continuous)
    omega = np.geomspace(*_frequency_range(loop.motor, ideal_margins), 240)
    return Study(
        board_response(question),
        ideal_response(question),
        _frequency(sampled, omega, margins(sampled)),
        _frequency(continuous, omega, ideal_margins),
    )


def board_response(question: Question) -> Response:
    """The sampled loop, with values between the controller's instants too."""
    period = question.loop.sampling.period_s
    periods = min(max(2, math.ceil(question.duration_s / period)), MAX_PERIODS)
    fewest = fewest_substeps(question.loop.hardware, period)
    between = fewest * math.ceil(max(1.0, POINTS / (periods * fewest)))
    trace = simulate(question.loop, [question.setpoint] * periods, substeps=between, seed=question.seed)
    t = np.arange(len(trace.y), dtype=float) * (period / between)
    y, u = np.array(trace.y), np.array(trace.u)
    metrics = step_metrics(t, y, question.setpoint, u, question.loop.hardware.supply_v)
    return _thinned(t, y, u, replace(metrics, ise=trace.ise))


def ideal_response(question: Question) -> Response:
    """The continuous linear loop, exactly: its state (y, v, integral, filter) under a constant set-point.

    v' = K u - T1 v - T2 y,  u = kp (b r - y) + xi + d,  xi' = ki (r - y),  xd' = d = N (kd (c r - y) - xd)
    """
    motor, pid = question.loop.motor, question.loop.pid
    t = np.linspace(0.0, question.duration_s, 6 * POINTS + 1)
    n = pid.n if math.isfinite(pid.n) else NEARLY_IDEAL * max(10.0, math.sqrt(motor.K * abs(pid.kp)))
    n = n if pid.kd else 0.0
    control = np.array([-pid.kp - n * pid.kd, 0.0, 1.0, -n, pid.kp * pid.b + n * pid.kd * pid.c])
    rates = np.array(
        [
            [0.0, 1.0, 0.0, 0.0, 0.0],
            [-motor.T2, -motor.T1, 0.0, 0.0, 0.0] + motor.K * control,
            [-pid.ki, 0.0, 0.0, 0.0, pid.ki],
            [-n * pid.kd, 0.0, 0.0, -n, n * pid.kd * pid.c],
            [0.0, 0.0, 0.0, 0.0, 0.0],
        ]
    )
    states = _march(rates, np.array([0.0, 0.0, 0.0, 0.0, question.setpoint]), t)
    y, u = np.ascontiguousarray(states[:, 0]), states @ control
    return _thinned(t, y, u, step_metrics(t, y, question.setpoint, u))


def _march(rates: Array, state: Array, t: Array) -> Array:
    """(k, n) states of x' = A x from `state` on, at evenly spaced times t (k,)."""
    from scipy.linalg import expm

    step = expm(rates * (t[1] - t[0]))
    states = np.empty((len(t), len(state)))
    with np.errstate(over="ignore", invalid="ignore"):
        for k in range(len(t)):
            states[k] = state
            state = step @ state
    return states


def _thinned(t: Array, y: Array, u: Array, metrics: StepMetrics) -> Response:
    """Every k-th point of each curve, so that about `POINTS` are left."""
    every = max(1, len(t) // POINTS)
    return Response(*(np.ascontiguousarray(curve[::every]) for curve in (t, y, u)), metrics=metrics)


def _frequency_range(motor: Motor, found: Margins) -> tuple[float, float]:
    """Two decades below the crossover to two above."""
    middle = found.crossover_rad_s if math.isfinite(found.crossover_rad_s) else max(1.0, motor.T1)
    return middle / 100.0, middle * 100.0


def _frequency(loop: OpenLoop, omega: Array, found: Margins) -> Frequency:
    L = np.where(omega < loop.highest_rad_s, loop.response(omega), np.nan)
    with np.errstate(divide="ignore"):
        gain_db = 20.0 * np.log10(np.abs(L))
    phase = np.full_like(omega, np.nan)
    known = np.isfinite(L)
    phase[known] = np.degrees(np.unwrap(np.angle(L[known])))
    if known.any():
        phase[known] -= 360.0 * math.ceil((phase[known][0] - 45.0) / 360.0)
    return Frequency(omega, gain_db, phase, found, loop.poles())
