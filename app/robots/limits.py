"""How fast each robot's joints may turn and speed up, and what its motors can give."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from app.robots.robot import Array, Robot


class RateLimits(NamedTuple):
    """Largest speed and acceleration of each joint, to either side."""

    speed: Array
    """(n,) rad/s or m/s"""
    acceleration: Array
    """(n,) rad/s^2 or m/s^2"""


class DriveLimits(NamedTuple):
    """Largest speed, acceleration and effort of each joint, to either side."""

    speed: Array
    """(n,) rad/s or m/s"""
    acceleration: Array
    """(n,) rad/s^2 or m/s^2"""
    effort: Array
    """(n,) peak torque or force at the joint, N m or N"""


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

EFFORTS: dict[str, tuple[float, ...]] = {
    "par4": (3.0,) * 4,
    "delta3": (1.5,) * 3,
    "linear": (60.0,) * 3,
    "fivebar": (89.6, 89.6, 28.8, 28.8),
}
"""Peak efforts by robot. The five-bar's are printed (Table 2: motor torque times gear ratio, twice the rated). The
others are assumed, so that gravity and the declared acceleration leave something for control."""


def rate_limits(robot: Robot) -> RateLimits:
    """The declared speeds and accelerations of one robot."""
    speed, acceleration = RATES[robot.name]
    return RateLimits(np.array(speed), np.array(acceleration))


def drive_limits(robot: Robot) -> DriveLimits:
    """The declared limits of one robot's drives."""
    return DriveLimits(*rate_limits(robot), np.array(EFFORTS[robot.name]))
