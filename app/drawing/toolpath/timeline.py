"""Strokes and hops in turn, as one row of samples at 1 kHz."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from app.drawing.toolpath.filter import STEP_S, counted
from app.drawing.toolpath.hops import Hops, Pace, pose_at
from app.drawing.toolpath.lookahead import Profile
from app.drawing.toolpath.placement import poses
from app.drawing.toolpath.polyline import Polylines
from app.drawing.toolpath.tracing import stroke_samples, trace
from app.robots import Robot
from app.robots.robot import Array


@dataclass(frozen=True, eq=False)
class Timeline:
    """n samples in blocks: hop 0, stroke 0, hop 1, ... , hop k. Strokes include their ends, hops do not."""

    pose: Array
    """(n, dof)"""
    block: NDArray[np.int64]
    """(n,) 2 i for hop i, 2 i + 1 for stroke i."""
    segment: NDArray[np.int64]
    """(n,) of the polylines; -1 in hops."""

    @cached_property
    def stroke(self) -> NDArray[np.int64]:
        """(n,) the stroke being drawn, -1 in hops."""
        return np.where(self.block % 2 == 1, self.block // 2, -1)


def sample_count(lines: Polylines, profile: Profile, pace: Pace) -> int:
    """How many samples the timeline will have."""
    return int(stroke_samples(lines, profile).sum() + _hop_samples(_whole_steps(pace)).sum())


def assemble(lines: Polylines, profile: Profile, hops: Hops, pace: Pace, robot: Robot) -> Timeline:
    """Sample strokes and hops; each takes a whole number of steps."""
    traced = trace(lines, profile)
    steps = _whole_steps(pace)
    hop_counts = _hop_samples(steps)
    counts = np.zeros(2 * len(steps) - 1, dtype=int)
    counts[0::2], counts[1::2] = hop_counts, traced.samples
    block = np.repeat(np.arange(len(counts)), counts)
    drawn = block % 2 == 1
    which = np.repeat(np.arange(len(steps)), hop_counts)
    # the very first sample belongs to the first hop; the others begin after the last sample of a stroke
    place = counted(hop_counts) + (which > 0)
    whole = pace.times(steps * STEP_S / np.maximum(pace.total, 1e-9))
    pose = np.empty((len(block), robot.dof))
    pose[~drawn] = pose_at(hops, whole, which, STEP_S * place.astype(float), robot)
    pose[drawn] = poses(robot, traced.points, hops.paper)
    segment = np.full(len(block), -1)
    segment[drawn] = traced.segment
    return Timeline(pose, block, segment)


def _whole_steps(pace: Pace) -> NDArray[np.int64]:
    """Of each hop; at least two, so that there is a sample between any two strokes."""
    return np.maximum(np.ceil(pace.total / STEP_S - 1e-6), 2).astype(int)


def _hop_samples(steps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Samples of each hop that are not a stroke's: all but both ends, and the outer ends of first and last."""
    samples = steps - 1
    samples[[0, -1]] += 1
    return samples
