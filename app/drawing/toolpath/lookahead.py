"""How fast along the strokes: a look-ahead that knows the joints.

Along a segment with direction u the joints move by J u for each metre, so that their limits bound the tool's speed
and acceleration there. At a vertex the direction changes by du; two bounds hold for the speed v:

    v^2 <= a jd s / (1 - s)      a corner, rounded by `jd` (junction deviation); s = cos of half the turn
    v^2 |J du| / ds <= limit     a polyline that stands for a curve

with a the acceleration at which |J n| a reaches the limit, n = du / |du|. The deviation is in Cartesian space: in
joint space a delta would slow down at its centre. Both take one half of the joints' acceleration and leave the
other to speeding up and braking. A stroke begins and ends with the jump of velocity that the moving average turns
into the latter half, so that the average costs no time. The passes forward and back, v_i^2 <= v_j^2 + 2 a |s_i - s_j|
for every j, are running minima.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.drawing.toolpath.filter import WINDOW_S
from app.drawing.toolpath.placement import poses
from app.drawing.toolpath.polyline import Polylines
from app.robots import Robot
from app.robots.limits import RateLimits
from app.robots.robot import Array

SHARE = 0.5
"""Of the joints' acceleration, for bends and for changes of speed each."""

JUNCTION_DEVIATION_M = 0.02e-3

MAX_ACCELERATION = 50.0
"""m/s^2, where the joints hardly move with the tool."""

STRAIGHT = 1e-6
"""A change of direction that is none."""


class Bounds(NamedTuple):
    """What the joints and the pen allow."""

    vertex: Array
    """(m,) largest squared speed at each vertex, m^2/s^2."""
    cruise: Array
    """(m,) largest squared speed along each segment."""
    acceleration: Array
    """(m,) along each segment, m/s^2."""

    def eased(self, ease: Array) -> Bounds:
        """Slower where `ease` (m,) of the segments is below 1: 0.25 takes twice the time."""
        at_vertex = np.minimum(ease, np.concatenate([ease[:1], ease[:-1]]))
        return Bounds(self.vertex * at_vertex, self.cruise * ease, self.acceleration * ease)


class Profile(NamedTuple):
    """Each segment is run through in three parts: faster, steady, slower."""

    begin: Array
    """(m,) s, when each segment begins, all strokes in a row without hops."""
    enter: Array
    """(m,) m/s, speed at its beginning."""
    leave: Array
    """(m,) m/s, speed at its end."""
    acceleration: Array
    """(m,) m/s^2"""
    faster: Array
    """(m,) s, duration of the first part."""
    steady: Array
    """(m,) s, duration of the second part."""
    duration: Array
    """(m,) s, of all three."""

    def travelled(self, segment: NDArray[np.int64], t: Array, length: Array) -> Array:
        """(r,) m since the beginning of the segments (r,), `t` (r,) s after it."""
        v, a, t1 = self.enter[segment], self.acceleration[segment], self.faster[segment]
        t_up = np.minimum(t, t1)
        up = (v + 0.5 * a * t_up) * t_up
        steady = (v + a * t1) * np.clip(t - t1, 0.0, self.steady[segment])
        left = np.maximum(self.duration[segment] - t, 0.0)
        from_end = length[segment] - (self.leave[segment] + 0.5 * a * left) * left
        return np.where(t > t1 + self.steady[segment], from_end, up + steady)


def find_bounds(lines: Polylines, robot: Robot, height_m: float, limits: RateLimits, speed_m_s: float) -> Bounds:
    """Bounds from the Jacobian at every vertex; all of them must be in reach."""
    jacobian = robot.jacobian(poses(robot, lines.points, height_m))[..., :2]
    ahead = np.concatenate([jacobian[1:], jacobian[-1:]])
    leaving, arriving = _times(jacobian, lines.direction), _times(ahead, lines.direction)
    rates = np.maximum(np.abs(leaving), np.abs(arriving))
    cruise = np.minimum(speed_m_s, _room(limits.speed, rates)) ** 2
    drift = np.abs(arriving - leaving) / np.maximum(lines.length, 1e-6)[:, None]
    cruise = np.minimum(cruise, SHARE * _room(limits.acceleration, drift))
    acceleration = np.minimum(MAX_ACCELERATION, SHARE * _room(limits.acceleration, rates))
    bends = np.abs(_times(jacobian[lines.inner], lines.direction[lines.inner] - lines.direction[lines.inner - 1]))
    room = SHARE * _room(limits.acceleration, bends)
    return Bounds(_vertex_bounds(lines, room, cruise, acceleration), cruise, acceleration)


def _vertex_bounds(lines: Polylines, room: Array, cruise: Array, acceleration: Array) -> Array:
    """(m,) largest squared speeds, with the share of the joints' acceleration for each du at the inner vertices."""
    here = lines.inner
    size = np.hypot(*(lines.direction[here] - lines.direction[here - 1]).T)
    s = np.sqrt(np.maximum(1.0 - 0.25 * size * size, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        corner = room * size * JUNCTION_DEVIATION_M * s / (1.0 - s)
        curve = room * 0.5 * (lines.length[here] + lines.length[here - 1])
    limited = np.where(size > STRAIGHT, np.minimum(corner, curve), np.inf)
    squared = np.empty(len(lines.points))
    squared[here] = np.minimum(limited, np.minimum(cruise[here], cruise[here - 1]))
    begin, end = lines.first[:-1], lines.last
    squared[begin] = np.minimum((acceleration[begin] * WINDOW_S) ** 2, cruise[begin])
    squared[end] = np.minimum((acceleration[end - 1] * WINDOW_S) ** 2, cruise[end - 1])
    return squared


def find_profile(lines: Polylines, bounds: Bounds) -> Profile:
    """The fastest speeds within the bounds, for each stroke on its own."""
    length, a = lines.length, bounds.acceleration
    gain = 2.0 * a * length
    gain[lines.last] = bounds.cruise.max()  # from one stroke to the next there is no bound
    before = np.cumsum(gain) - gain
    forward = np.minimum.accumulate(bounds.vertex - before) + before
    squared = np.minimum.accumulate((forward + before)[::-1])[::-1] - before
    enter = np.maximum(squared, 0.0)
    leave = np.concatenate([enter[1:], [0.0]])
    peak = np.maximum(np.minimum(bounds.cruise, 0.5 * (enter + leave + gain)), np.maximum(enter, leave))
    steady_length = np.maximum(length - (peak - 0.5 * (enter + leave)) / a, 0.0)
    v_enter, v_leave, v_peak = np.sqrt(enter), np.sqrt(leave), np.sqrt(peak)
    faster, slower = (v_peak - v_enter) / a, (v_peak - v_leave) / a
    steady = steady_length / np.maximum(v_peak, 1e-12)
    duration = np.where(length > 0.0, faster + steady + slower, 0.0)
    return Profile(np.cumsum(duration) - duration, v_enter, v_leave, a, faster, steady, duration)


def _times(jacobian: Array, vectors: Array) -> Array:
    """(m, n) J_i v_i."""
    return np.einsum("mnd,md->mn", jacobian, vectors)


def _room(limit: Array, rates: Array) -> Array:
    """(m,) how far `rates` (m, n) may be multiplied within `limit` (n,); inf for no rates."""
    with np.errstate(divide="ignore"):
        return np.min(limit / rates, axis=-1)
