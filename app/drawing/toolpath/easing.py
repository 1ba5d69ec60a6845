"""What the joints really do, sample by sample, and where the plan must slow down for it.

The look-ahead bounds accelerations in its own terms; what counts is the second difference of the joints at 1 kHz.
Where that exceeds a limit the segments around are slowed down and the plan is made again.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import minimum_filter1d

from app.drawing.toolpath.filter import STEP_S, TAPS
from app.drawing.toolpath.timeline import Timeline
from app.robots.limits import RateLimits
from app.robots.robot import Array

MARGIN = 0.99


class Loads(NamedTuple):
    """Of the joint that is nearest to its limit at each sample: 1 is the limit."""

    speed: Array
    """(n,)"""
    acceleration: Array
    """(n,)"""

    @property
    def worst(self) -> float:
        """NaN if a sample is out of reach."""
        return float(np.maximum(self.speed.max(), self.acceleration.max()))


class Ease(NamedTuple):
    """How much slower than its bounds the plan is."""

    segments: Array
    """(m,) factor of the squared speed and of the acceleration along each segment, at most 1."""
    hops: Array
    """(h,) factor of the time, at least 1."""


def find_loads(q: Array, limits: RateLimits) -> Loads:
    """Loads of joints (n, dof) sampled at 1 kHz, at rest before and after."""
    joints = np.ascontiguousarray(np.concatenate([q[:1], q, q[-1:]]).T)  # joint by joint NumPy is three times quicker
    step = np.diff(joints)
    speed = np.max(np.abs(step) / limits.speed[:, None], axis=0) / STEP_S
    bend = np.max(np.abs(np.diff(step)) / limits.acceleration[:, None], axis=0)
    return Loads(np.maximum(speed[1:], speed[:-1]), bend / STEP_S**2)


def slowed(ease: Ease, timeline: Timeline, loads: Loads, *, whole_strokes: bool) -> Ease:
    """Slower around every sample beyond a limit, or along every stroke with such a sample."""
    excess = np.maximum(1.0, np.maximum(loads.speed, loads.acceleration))
    factor = np.where(excess > 1.0, MARGIN / excess**2, 1.0)
    worst = np.ones(timeline.block[-1] + 1)
    np.minimum.at(worst, timeline.block, factor)
    drawn = timeline.segment >= 0
    around = worst[timeline.block] if whole_strokes else minimum_filter1d(np.where(drawn, factor, 1.0), 2 * TAPS + 1)
    segments = _on_segments(timeline.segment[drawn], around[drawn], len(ease.segments))
    return Ease(ease.segments * segments, ease.hops / np.sqrt(np.sqrt(worst[0::2])))


def _on_segments(segment: NDArray[np.int64], factor: Array, count: int) -> Array:
    """Least factor of the samples on each segment; one without a sample takes the next sample's."""
    following = np.minimum(np.searchsorted(segment, np.arange(count)), len(segment) - 1)
    least = factor[following]
    np.minimum.at(least, segment, factor)
    return least
