"""How far a loop is from instability, read off its frequency response."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.control.frequency import OpenLoop

Array = NDArray[np.float64]

LOWEST_RAD_S = 1e-3
HIGHEST_RAD_S = 1e4
GRID_POINTS = 1500


@dataclass(frozen=True)
class Margins:
    """NaN or inf for what does not occur."""

    phase_margin_deg: float
    """Smallest distance of the phase from -180 degrees where |L| = 1."""
    crossover_rad_s: float
    """Where that is."""
    gain_margin: float
    """Factor of the gain nearest to 1 at which the loop begins to oscillate; inf where there is none."""
    phase_crossover_rad_s: float
    delay_margin_s: float
    """Additional delay at which the loop begins to oscillate."""
    Ms: float
    """Largest |1 / (1 + L)|: below 1.4 robust, above 2 fragile."""
    bandwidth_rad_s: float
    """Where the closed loop has fallen to -3 dB."""
    stable: bool
    """Whether every closed-loop pole decays."""


def margins(loop: OpenLoop) -> Margins:
    """Margins of the closed loop with unity feedback."""
    omega = np.geomspace(LOWEST_RAD_S, min(HIGHEST_RAD_S, 0.9999 * loop.highest_rad_s), GRID_POINTS)
    L = loop.response(omega)
    with np.errstate(divide="ignore"):  # a controller without any gain
        logs = np.log(np.abs(L))
    gains = _crossings(loop, omega, logs, lambda value: math.log(abs(value)))
    turns = [w for w in _crossings(loop, omega, L.imag, lambda value: value.imag) if _at(loop, w).real < 0.0]
    phase = [(math.remainder(float(np.angle(_at(loop, w))) - math.pi, math.tau), w) for w in gains]
    pm, crossover = min(phase, key=lambda found: abs(found[0]), default=(math.inf, math.nan))
    gm = [(-1.0 / _at(loop, w).real, w) for w in turns]
    gain_margin, turn = min(gm, key=lambda found: abs(math.log(found[0])), default=(math.inf, math.nan))
    delays = [(angle if angle > 0.0 else angle + math.tau) / w for angle, w in phase]
    return Margins(
        phase_margin_deg=math.degrees(pm),
        crossover_rad_s=crossover,
        gain_margin=gain_margin,
        phase_crossover_rad_s=turn,
        delay_margin_s=min(delays, default=math.inf),
        Ms=float(np.max(1.0 / np.abs(1.0 + L))),
        bandwidth_rad_s=_bandwidth(omega, L),
        stable=_is_stable(loop),
    )


def _at(loop: OpenLoop, omega: float) -> complex:
    return complex(loop.response(np.array([omega]))[0])


def _crossings(loop: OpenLoop, omega: Array, values: Array, of: Callable[[complex], float]) -> list[float]:
    """Frequencies at which a function of L changes its sign: bracketed on the grid, then refined."""
    from scipy.optimize import brentq

    logs = np.log(omega)
    brackets = np.flatnonzero(np.sign(values[:-1]) * np.sign(values[1:]) < 0.0)
    return [
        math.exp(float(brentq(lambda x: of(_at(loop, math.exp(x))), logs[k], logs[k + 1], xtol=1e-12)))  # pyright: ignore[reportArgumentType]
        for k in brackets
    ]


def _bandwidth(omega: Array, L: NDArray[np.complex128]) -> float:
    """Interpolated on the grid; inf where the closed loop never falls."""
    gain = np.abs(L / (1.0 + L))
    low = np.flatnonzero(gain < gain[0] / math.sqrt(2.0))
    if not low.size or low[0] == 0:
        return math.inf
    k = int(low[0])
    share = (gain[k - 1] - gain[0] / math.sqrt(2.0)) / (gain[k - 1] - gain[k])
    return float(omega[k - 1] * (omega[k] / omega[k - 1]) ** share)


def _is_stable(loop: OpenLoop) -> bool:
    """By the poles without the delay, which must then be shorter than what that loop can bear."""
    if not np.all(loop.poles().real < 0.0):
        return False
    return not loop.delay_s or loop.delay_s < margins(replace(loop, delay_s=0.0)).delay_margin_s
