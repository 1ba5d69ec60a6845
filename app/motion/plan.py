"""From settings to a motion: a curve, a time law, and the time it takes."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from app.motion.checks import check
from app.motion.curves import CURVES
from app.motion.demands import KINDS, Demands, demands_along
from app.motion.motion import Motion, drive_name, record
from app.motion.placed import AlongCurve, PlacedCurve, place
from app.motion.profiles import PROFILES, ProfileKind
from app.motion.settings import MotionSettings
from app.motion.time_optimal import time_optimal
from app.motion.trajectory import Array, Law, MotionError
from app.robots import Robot
from app.robots.dynamics import INERTIA, Dynamics, dynamics_of
from app.robots.limits import DriveLimits

LAP_POINTS, MOST_POINTS = 400, 1600
"""Points along a curve at which laws are compared: in a lap or a turn, and at most."""

OPTIMAL_LAP_POINTS, OPTIMAL_MOST_POINTS = 1600, 8000
"""Those of the time-optimal law: the more there are, the nearer it keeps to the limits."""

NEIGHBOURS = 4
"""Ramps tried between the best one and the next on either side."""

FINER = 4
"""The duration follows from so many times more points."""

MARGIN = 1.0005
"""On the duration, for what lies between the points."""


def plan_motion(settings: MotionSettings) -> Motion:
    """The motion of these settings, as short as the limits allow or as long as asked.

    Raises:
        MotionError: for settings that make no sense, a curve out of reach, or too short a duration.
    """
    check(settings)
    robot = settings.build()
    inertia = INERTIA[robot.name].changed(payload=settings.payload_kg)
    dynamics, limits = dynamics_of(robot, inertia), settings.limits(robot)
    curve = place(settings, robot)
    timing = _timing(dynamics, curve, limits, settings.profile)
    least = MARGIN * float(timing.least.max())
    duration = settings.duration_s or least
    if duration < least * (1.0 - 1e-9):
        raise _too_short(robot, timing, duration, least)
    title = f"{CURVES[settings.curve].title}, {PROFILES[settings.profile].title.lower()}"
    corners = () if PROFILES[settings.profile].law is None else duration * timing.corners
    return record(settings, dynamics, AlongCurve(title, duration, curve, timing.law), limits, corners=corners)


class _Timing(NamedTuple):
    """The quickest law of a profile."""

    law: Law
    corners: Array
    """Where its acceleration has corners or jumps."""
    least: Array
    """(k, m) the least durations that the demands at k points need."""


def _timing(dynamics: Dynamics, curve: PlacedCurve, limits: DriveLimits, profile: str) -> _Timing:
    kind = PROFILES[profile]
    lap, most = (LAP_POINTS, MOST_POINTS) if kind.law else (OPTIMAL_LAP_POINTS, OPTIMAL_MOST_POINTS)
    points = min(lap * curve.rounds, most)
    s = np.linspace(0.0, 1.0, points + 1)
    rough = demands_along(dynamics, curve, s, limits)
    _check_holding(dynamics.robot, rough)
    law, corners = _shape(kind, rough, s)
    u = _between(corners, FINER * points)
    there, rate, acceleration = law.at(u)
    fine = demands_along(dynamics, curve, np.clip(there, 0.0, 1.0), limits)
    _check_holding(dynamics.robot, fine)
    return _Timing(law, corners, fine.least_durations(rate, acceleration))


def _shape(kind: ProfileKind, demands: Demands, s: Array) -> tuple[Law, Array]:
    """The quickest law of a family, by the demands at s (k,), and where it has corners."""
    if kind.law is None:
        optimal = time_optimal(demands, s)
        return optimal, optimal.knots
    law, knots = kind.law, kind.knots

    def duration(ramp: float) -> float:
        return _least_duration(law(ramp), knots(ramp), demands, s)

    if len(kind.ramps) == 1:
        return law(kind.ramps[0]), np.array(knots(kind.ramps[0]))
    best = min(kind.ramps, key=duration)
    at = kind.ramps.index(best)
    around = np.linspace(kind.ramps[max(at - 1, 0)], kind.ramps[min(at + 1, len(kind.ramps) - 1)], 2 * NEIGHBOURS + 1)
    best = min([best, *around.tolist()], key=duration)
    return law(best), np.array(knots(best))


def _least_duration(law: Law, times: tuple[float, ...], demands: Demands, s: Array) -> float:
    u = _between(np.array(times), len(s))
    _, rate, acceleration = law.at(np.interp(s, law.at(u)[0], u))
    return float(demands.least_durations(rate, acceleration).max())


def _between(times: Array, count: int) -> Array:
    """About `count` instants, and enough between any two of the times to see a short ramp's peak, from right after
    the one to right before the other: an acceleration that jumps is seen on both sides."""
    lengths = np.diff(times)
    least = max(4, count // (4 * len(lengths)))
    counts = np.maximum(np.ceil(count * lengths / (times[-1] - times[0])).astype(int), least)
    piece = np.repeat(np.arange(len(lengths)), counts)
    place = np.arange(len(piece)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = np.clip(place / (counts - 1)[piece], 1e-9, 1.0 - 1e-9)
    return times[piece] + share * lengths[piece]


def _check_holding(robot: Robot, demands: Demands) -> None:
    share = np.abs(demands.constant / demands.limit).max(axis=0)
    column = int(np.argmax(share))
    if share[column] < 1.0:
        return
    name, kind = drive_name(robot, *demands.name(column))
    raise MotionError(
        f"{name} cannot even hold the tool: that takes {100 * share[column]:.0f} % of the {kind} allowed; "
        "use a lighter payload or allow more."
    )


def _too_short(robot: Robot, timing: _Timing, duration: float, least: float) -> MotionError:
    n, column = len(robot.joint_names), int(np.argmax(timing.least.max(axis=0)))
    name, word = drive_name(robot, column % n, KINDS[column // n])
    needed = math.ceil(least * 1e3) / 1e3
    return MotionError(f"{name} has too little {word} to do this in {duration:.3g} s; give it at least {needed:g} s.")
