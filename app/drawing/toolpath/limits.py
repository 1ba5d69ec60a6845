"""How fast each robot's joints may turn and speed up. Reach says where a robot can stand; this, how it moves."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from app.robots import Robot
from app.robots.robot import Array


class RateLimits(NamedTuple):
    """Largest speed and acceleration of each joint, to either side."""

    speed: Array
    """(n,) rad/s or m/s"""
    acceleration: Array
    """(n,) rad/s^2 or m/s^2"""


RATES: dict[str, tuple[tuple[float, ...], tuple[float, ...]]] = {
    "par4": ((4.0,) * 4, (60.0,) * 4),
    "delta3": ((4.0,) * 3, (60.0,) * 3),
    "linear": ((1.0,) * 3, (10.0,) * 3),
    "fivebar": ((7.8125, 7.8125, 12.5, 12.5), (60.0, 60.0, 390.0, 390.0)),
}
"""Speeds and accelerations by robot. Only the five-bar's speeds are printed (Table 2 of its paper). The deltas'
are assumed: small geared motors. 1 m/s and 10 m/s^2 suit carriages on toothed belts. The five-bar's arms are held
to the deltas' acceleration, of which they have more than 60 rad/s^2 (89.6 N m for at most 1.02 kg m^2); its nuts
get what their rated 14.4 N m gives their 0.0366 kg m^2."""


def rate_limits(robot: Robot) -> RateLimits:
    """The declared limits of one robot."""
    speed, acceleration = RATES[robot.name]
    return RateLimits(np.array(speed), np.array(acceleration))
