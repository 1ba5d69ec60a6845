"""Time laws: how a tool runs along a curve, from 0 to 1 within one unit of time, at rest at both ends.

Those that cruise speed up during the first `ramp` of the time and slow down during the last; in between the speed
is v = 1 / (1 - ramp), whatever the shape of the (symmetric) ramp. The sin2 law is that of the five-bar's work cycle.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.motion.pieces import Pieces, joined
from app.motion.trajectory import Array, Law

RAMPS = (0.01, 0.02, 0.035, 0.05, 0.075, 0.1, 0.14, 0.18, 0.23, 0.28, 0.34, 0.4, 0.45, 0.5)
"""Shares of the time that are tried for speeding up."""

JERK_SHARE = 0.25
"""Of a jerk-limited ramp, the part in which the acceleration builds up, and that in which it fades."""


@dataclass(frozen=True)
class ProfileKind:
    """A family of time laws."""

    title: str
    note: str
    """What is special about it, one sentence for students."""
    law: Callable[[float], Law] | None
    """From the share of time for speeding up (0..0.5]; None where the law follows from the limits."""
    knots: Callable[[float], tuple[float, ...]] = lambda ramp: (0.0, 1.0)
    """Where the acceleration has a corner or jumps, by the same share."""
    ramps: tuple[float, ...] = (0.5,)
    """The shares to choose from."""


@dataclass(frozen=True)
class Sin2:
    """Acceleration A sin^2(pi t / ramp) up to cruising speed, and mirrored down to rest: no jump, bounded jerk.

    A = 2 v / ramp with the cruising speed v = distance / (duration - ramp), as in the five-bar's work cycle.
    """

    distance: float = 1.0
    duration: float = 1.0
    ramp: float = 0.25
    """Time of speeding up, at most half of the duration."""

    def at(self, u: ArrayLike) -> tuple[Array, Array, Array]:
        t = np.asarray(u, dtype=float)
        up, up_rate, up_acceleration = self._launch(t)
        down, down_rate, down_acceleration = self._launch(t - (self.duration - self.ramp))
        return up - down, up_rate - down_rate, up_acceleration - down_acceleration

    def _launch(self, t: Array) -> tuple[Array, Array, Array]:
        """From rest to cruising, and on for ever."""
        speed = self.distance / (self.duration - self.ramp)
        x = np.clip(t / self.ramp, 0.0, 1.0)
        turn = 2.0 * math.pi
        risen = x * x / 2.0 + (np.cos(turn * x) - 1.0) / (turn * turn)
        value = speed * (self.ramp * risen + np.maximum(t - self.ramp, 0.0))
        rate = speed * (x - np.sin(turn * x) / turn)
        return value, rate, 2.0 * speed / self.ramp * np.sin(math.pi * x) ** 2


def cubic() -> Pieces:
    """s = 3 u^2 - 2 u^3: the acceleration jumps at both ends."""
    return joined([(1.0, [0.0, 0.0, 3.0, -2.0])])


def quintic_law() -> Pieces:
    """s = 10 u^3 - 15 u^4 + 6 u^5."""
    return joined([(1.0, [0.0, 0.0, 0.0, 10.0, -15.0, 6.0])])


def trapezoid(ramp: float) -> Pieces:
    """Constant acceleration, constant speed, constant deceleration."""
    return from_accelerations([ramp, 1.0 - 2.0 * ramp, ramp], [0.0] * 3, [1.0, 0.0, -1.0])


def s_curve(ramp: float) -> Pieces:
    """Seven pieces of constant jerk."""
    rise, hold = JERK_SHARE * ramp, (1.0 - 2.0 * JERK_SHARE) * ramp
    up, jerk = [rise, hold, rise], 1.0 / rise
    jerks = [jerk, 0.0, -jerk, 0.0, -jerk, 0.0, jerk]
    starts = [0.0, 1.0, 1.0, 0.0, 0.0, -1.0, -1.0]
    return from_accelerations([*up, 1.0 - 2.0 * ramp, *up], jerks, starts)


def from_accelerations(lengths: list[float], jerks: list[float], starts: list[float]) -> Pieces:
    """A law from 0 to 1, at rest at its start, in the given proportions of length, jerk and acceleration."""
    position = speed = 0.0
    pieces = []
    for h, jerk, a in zip(lengths, jerks, starts, strict=True):
        if h > 0.0:
            pieces.append((h, [position, speed, a / 2.0, jerk / 6.0]))
        position += h * (speed + h * (a / 2.0 + h * jerk / 6.0))
        speed += h * (a + h * jerk / 2.0)
    law = joined(pieces)
    return Pieces(law.knots, law.coefficients / position)


def _cruising(ramp: float) -> tuple[float, ...]:
    return (0.0, ramp, 1.0 - ramp, 1.0)


def _jerking(ramp: float) -> tuple[float, ...]:
    rise = JERK_SHARE * ramp
    up = (0.0, rise, ramp - rise, ramp)
    return (*up, *(1.0 - u for u in reversed(up)))


PROFILES: dict[str, ProfileKind] = {
    "cubic": ProfileKind("Cubic", "The simplest law, but the acceleration jumps at both ends.", lambda _: cubic()),
    "quintic": ProfileKind("Quintic", "Smooth in acceleration too, with a high peak speed.", lambda _: quintic_law()),
    "trapezoidal": ProfileKind(
        "Trapezoidal speed", "Constant acceleration, cruise, brake: fast, with jumps.", trapezoid, _cruising, RAMPS
    ),
    "jerk-limited": ProfileKind(
        "Jerk-limited (S-curve)", "A trapezoid whose acceleration builds up and fades.", s_curve, _jerking, RAMPS
    ),
    "sin2": ProfileKind(
        "sin² law", "The five-bar paper's: ramps with the square of a sine.", lambda r: Sin2(ramp=r), _cruising, RAMPS
    ),
    "time-optimal": ProfileKind("Time-optimal", "Always at some limit: nothing along this curve is faster.", None),
}
