"""Between the strokes: up, across, down, each by a quintic and overlapping, as fast as the joints allow.

The pen moves across only while it is more than the clearance above the paper, and takes all of that time. The
quintics start and end at rest in speed and acceleration; the pace of the whole comes from the joints' accelerations
along the very hop, sampled. All hops are treated at once.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.drawing.toolpath.placement import poses
from app.motion.paths import quintic
from app.robots import Robot
from app.robots.limits import RateLimits
from app.robots.robot import Array

CLEARANCE_M = 1e-3
"""Height above the paper below which the pen does not move across."""

PEAK_SPEED = 1.875
PEAK_ACCELERATION = 10.0 / math.sqrt(3.0)
"""Of a quintic over a distance and a time of 1."""

SAMPLES = 96
"""Intervals in which a hop is sampled for its pace."""


class Hops(NamedTuple):
    """h hops in the robot's frame, m."""

    start: Array
    """(h, 2)"""
    stop: Array
    """(h, 2)"""
    rise: Array
    """(h,) from the start to the top; 0 for the first, which begins lifted."""
    fall: Array
    """(h,) from the top to the stop; 0 for the last, which ends lifted."""
    paper: float
    """z on the paper."""

    @property
    def top(self) -> Array:
        """(h,) highest z"""
        return self.paper + np.maximum(self.rise, self.fall)


class Pace(NamedTuple):
    """How long the parts of each hop take, (h,) s."""

    total: Array
    up: Array
    across: Array
    down: Array

    def times(self, factor: Array) -> Pace:
        """All parts longer by a factor (h,)."""
        return Pace(self.total * factor, self.up * factor, self.across * factor, self.down * factor)


def between(starts: Array, stops: Array, paper_m: float, lift_m: float, *, lift: bool) -> Hops:
    """Hops onto the first stroke, from each to the next, and off the last.

    Args:
        starts: (k, 2) first points of the strokes.
        stops: (k, 2) last points of the strokes.
        lift: without it the pen stays on the paper between the strokes.
    """
    start, stop = np.concatenate([starts[:1], stops]), np.concatenate([starts, stops[-1:]])
    rise = np.full(len(start), lift_m if lift else 0.0)
    fall = rise.copy()
    rise[0], fall[0] = 0.0, lift_m
    rise[-1], fall[-1] = lift_m, 0.0
    return Hops(start, stop, rise, fall, paper_m)


def pose_at(hops: Hops, pace: Pace, which: NDArray[np.int64], t: Array, robot: Robot) -> Array:
    """(r, dof) on the hops (r,), `t` (r,) s after their beginning."""
    total, up, across, down = (np.maximum(part, 1e-9)[which] for part in pace)
    share = quintic((t - 0.5 * (total - across)) / across)
    xy = hops.start[which] + share[:, None] * (hops.stop - hops.start)[which]
    below = hops.rise[which] * (1.0 - quintic(t / up)) + hops.fall[which] * quintic((t - total) / down + 1.0)
    return poses(robot, xy, hops.top[which] - below)


def find_pace(hops: Hops, robot: Robot, limits: RateLimits, speed_m_s: float) -> Pace:
    """Parts as quick as each could be alone, then longer as a whole until the sampled joints keep their limits."""
    return _scaled(_overlapped(hops, *_alone(hops, robot, limits, speed_m_s)), hops, robot, limits)


def _alone(hops: Hops, robot: Robot, limits: RateLimits, speed_m_s: float) -> tuple[Array, Array, Array]:
    """Times up, across and down (h,), each as if alone, with the Jacobian at the worse end."""
    way = hops.stop - hops.start
    length = np.hypot(*way.T)
    direction = np.zeros((len(way), robot.dof))
    direction[:, :2] = way / np.maximum(length, 1e-12)[:, None]
    upward = np.eye(robot.dof)[2]
    ends = [robot.jacobian(poses(robot, point, hops.top)) for point in (hops.start, hops.stop)]
    across = np.max([np.abs(np.einsum("hnd,hd->hn", jacobian, direction)) for jacobian in ends], axis=0)
    vertical = np.max([np.abs(jacobian @ upward) for jacobian in ends], axis=0)
    return (
        _quintic_time(hops.rise, vertical, limits, speed_m_s),
        _quintic_time(length, across, limits, speed_m_s),
        _quintic_time(hops.fall, vertical, limits, speed_m_s),
    )


def _quintic_time(distance: Array, rates: Array, limits: RateLimits, speed_m_s: float) -> Array:
    """(h,) s for a quintic over each distance, its joints moving by `rates` (h, n) for each metre."""
    slow = np.max(rates / limits.speed, axis=-1)
    sluggish = np.max(rates / limits.acceleration, axis=-1)
    by_speed = PEAK_SPEED * distance * np.maximum(slow, 1.0 / speed_m_s)
    return np.maximum(by_speed, np.sqrt(PEAK_ACCELERATION * distance * sluggish))


def _overlapped(hops: Hops, up: Array, across: Array, down: Array) -> Pace:
    """Across as soon and as long as the pen is clear of the paper."""
    low = _time_to(hops.rise) * up + _time_to(hops.fall) * down
    total = np.maximum(up + down, across + low)
    return Pace(total, up, total - low, down)


def _time_to(height: Array) -> Array:
    """(h,) share of a rise to `height` after which the pen is above the clearance; 1 where it never is."""
    share = np.linspace(0.0, 1.0, 1001)
    reached = np.minimum(CLEARANCE_M / np.maximum(height, CLEARANCE_M), 1.0)
    return np.interp(reached, quintic(share), share)


def _scaled(pace: Pace, hops: Hops, robot: Robot, limits: RateLimits) -> Pace:
    count = len(pace.total)
    which = np.repeat(np.arange(count), SAMPLES + 1)
    t = (pace.total[:, None] * np.linspace(0.0, 1.0, SAMPLES + 1)).ravel()
    q = robot.inverse(pose_at(hops, pace, which, t, robot)).reshape(count, SAMPLES + 1, -1)
    step = np.maximum(pace.total, 1e-9) / SAMPLES
    speed = np.max(np.abs(np.diff(q, axis=1)) / limits.speed, axis=(1, 2)) / step
    bend = np.max(np.abs(np.diff(q, n=2, axis=1)) / limits.acceleration, axis=(1, 2)) / step**2
    # out of reach there is no pace; whoever checks the samples says so
    return pace.times(np.nan_to_num(np.maximum(1.0, np.maximum(speed, np.sqrt(bend))), nan=1.0))
