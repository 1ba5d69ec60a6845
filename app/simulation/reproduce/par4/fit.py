"""What the eight numbers of Table 4 say of a setting that the paper does not print."""

from __future__ import annotations

from functools import cache
from typing import Literal, NamedTuple

import numpy as np

from app.control import PID_APPROX, PID_AUTO, Pid
from app.motion import Tour
from app.robots.par4 import Par4Geometry
from app.robots.robot import Array
from app.simulation.tracking import Task, follow_simulink

Tuning = Literal["auto", "approx"]
PIDS: dict[Tuning, Pid] = {"auto": PID_AUTO, "approx": PID_APPROX}

TABLE_4: dict[Tuning, tuple[str, str, str, str]] = {
    "auto": ("91.45", "124", "126", "88.85"),
    "approx": ("234.8", "305.4", "307.9", "231.7"),
}
"""As printed, deg^2 s, drives I to IV."""


class Settings(NamedTuple):
    """Of the simulation, all of them found."""

    P_z: float = Par4Geometry().P_z
    """m"""
    u_max: float = 100.0
    """%"""
    lap_s: float = 100.0


class Fit(NamedTuple):
    """The value that Table 4 asks for, and by how much its rounded digits can move it."""

    value: float
    either_way: float


@cache
def indices(settings: Settings) -> dict[Tuning, Array]:
    """Table 4: (4,) integrals of the squared error of each tuning, deg^2 s."""
    task = Task(dimensions={"P_z": settings.P_z}, tour=Tour(lap_s=settings.lap_s))
    return {tuning: follow_simulink(task, pid, settings.u_max).ise for tuning, pid in PIDS.items()}


def fit(setting: Literal["P_z", "u_max", "lap_s"], step: float) -> Fit:
    """Least squares for a setting near ours, in its unit, over differences in units of the last printed digit.

    `step` is by how much the setting is varied to see what depends on it; the rest stays as found.
    """
    ours = Settings()
    base, varied = _misses(ours), _misses(ours._replace(**{setting: getattr(ours, setting) + step}))
    slope = (varied - base) / step
    pull = slope / (slope @ slope)
    return Fit(getattr(ours, setting) - float(pull @ base), 0.5 * float(np.abs(pull).sum()))


def _misses(settings: Settings) -> Array:
    """(8,) ours minus printed."""
    ours = np.concatenate(list(indices(settings).values()))
    texts = [text for row in TABLE_4.values() for text in row]
    last_digits = np.array([10.0 ** -len(text.partition(".")[2]) for text in texts])
    return (ours - np.array([float(text) for text in texts])) / last_digits
