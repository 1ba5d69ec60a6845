"""What running along a curve asks of the drives, and how long it must take at least.

With s(t) along the curve, joint speeds are q' s', accelerations q' s'' + q'' s'^2, and since the dynamics are
quadratic in the rates, efforts are a s'' + b s'^2 + g. So each demand has the form

    linear s'' + square s'^2 + constant        within +- limit

(the speeds squared). When the same course s(t / T) takes T instead of 1, the first two terms shrink by 1 / T^2: the
shortest T is found without iteration.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from app.motion.placed import PlacedCurve
from app.motion.trajectory import Array
from app.robots.dynamics import Dynamics
from app.robots.dynamics.elementwise import stacked
from app.robots.limits import DriveLimits

KINDS = ("speed", "acceleration", "effort")


class Demands(NamedTuple):
    """At k points of a curve, on n joints: m = 3 n columns, all speeds first, then accelerations, then efforts."""

    linear: Array
    """(k, m)"""
    square: Array
    """(k, m)"""
    constant: Array
    """(k, m)"""
    limit: Array
    """(m,)"""

    def least_durations(self, rate: Array, acceleration: Array) -> Array:
        """(k, m) the least T for each demand when the course that takes 1 has s' and s'' (k,) here; inf where
        the drive cannot even hold the robot."""
        moving = self.linear * acceleration[:, None] + self.square * (rate * rate)[:, None]
        room = self.limit - np.sign(moving) * self.constant
        with np.errstate(divide="ignore", invalid="ignore"):
            least = np.sqrt(np.abs(moving) / room)
        return np.where((room > 0.0) & (np.abs(self.constant) < self.limit), least, np.inf)

    def name(self, column: int) -> tuple[int, str]:
        """Joint (from 0) and kind of a demand."""
        n = len(self.limit) // len(KINDS)
        return column % n, KINDS[column // n]


def demands_along(dynamics: Dynamics, curve: PlacedCurve, s: Array, limits: DriveLimits) -> Demands:
    """At s (k,) of a curve."""
    pose, first, second = curve.at(s)
    terms = dynamics.columns(pose, first)
    joint_first, joint_second = stacked(terms.joint_rates), stacked(terms.joint_acceleration(tuple(second.T)))
    gravity = stacked(terms.gravity())
    effort_first, effort_second = stacked(terms.inertial(terms.rate)), stacked(terms.effort(tuple(second.T))) - gravity
    nothing = np.zeros_like(joint_first)
    return Demands(
        np.hstack([nothing, joint_first, effort_first]),
        np.hstack([joint_first**2, joint_second, effort_second]),
        np.hstack([nothing, nothing, gravity]),
        np.concatenate([limits.speed**2, limits.acceleration, limits.effort]),
    )
