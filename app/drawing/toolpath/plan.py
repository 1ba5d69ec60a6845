"""A drawing as a timed trajectory: planned, measured against the joints' limits, slowed down where it exceeds them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.drawing.errors import DrawingError
from app.drawing.toolpath.check import ToolpathError, check_lines, check_samples
from app.drawing.toolpath.easing import Ease, Loads, find_loads, slowed
from app.drawing.toolpath.filter import STEP_S
from app.drawing.toolpath.hops import between, find_pace
from app.drawing.toolpath.lookahead import find_bounds, find_profile
from app.drawing.toolpath.pen import PenSettings, default_pen
from app.drawing.toolpath.placement import Placement
from app.drawing.toolpath.polyline import lay_out
from app.drawing.toolpath.timeline import Timeline, assemble, sample_count
from app.robots import Robot
from app.robots.limits import rate_limits
from app.robots.robot import Array

LONGEST_S = 3600.0
ROUNDS, LOCAL_ROUNDS = 20, 8
"""At first the plan is slowed down around what exceeds a limit, in the end along whole strokes."""


@dataclass(frozen=True, eq=False)
class Toolpath:
    """A drawing at 1 kHz, from rest above its first point to rest above its last. k samples."""

    t: Array
    """(k,) s, from 0"""
    pose: Array
    """(k, dof) m and rad; a rotation is 0."""
    q: Array
    """(k, n) rad or m"""
    pen: NDArray[np.bool_]
    """(k,) whether the pen is down on the paper."""
    stroke: NDArray[np.int64]
    """(k,) index of the stroke being drawn, -1 in hops."""
    speed_m_s: Array
    """(k,) of the tool."""
    max_joint_speed_ratio: float
    """Of the joints' limits; at most 1."""
    max_joint_acceleration_ratio: float
    """Of the joints' limits, by second differences of `q`; at most 1."""
    stray_ink_mm: float
    """Length drawn between the strokes, for want of a lift."""

    @property
    def duration_s(self) -> float:
        return float(self.t[-1])


class Sample(NamedTuple):
    """The robot at some times (...)."""

    pose: Array
    """(..., dof)"""
    q: Array
    """(..., n)"""
    pen: NDArray[np.bool_]
    """(...,)"""
    stroke: NDArray[np.int64]
    """(...,)"""


def plan_toolpath(
    strokes: Sequence[Array], robot: Robot, placement: Placement, pen: PenSettings | None = None
) -> Toolpath:
    """The trajectory that draws the strokes in their order.

    Args:
        strokes: (n, 2) each, sheet millimetres.
        pen: by default `default_pen(robot)`.

    Raises:
        ToolpathError: where the robot cannot reach; the message names the stroke and the limit.
        DrawingError: for no strokes, strokes that are no points, or a drawing of more than an hour.
    """
    pen = pen or default_pen(robot)
    lines, limits = lay_out(strokes, placement), rate_limits(robot)
    paper, lift = placement.height_m, 1e-3 * pen.lift_mm
    check_lines(lines, robot, paper, lift, rises=pen.rises)
    bounds = find_bounds(lines, robot, paper, limits, 1e-3 * pen.speed_mm_s)
    hops = between(lines.points[lines.first[:-1]], lines.points[lines.last], paper, lift, lift=pen.rises)
    pace = find_pace(hops, robot, limits, 1e-3 * pen.up_speed_mm_s)
    ease = Ease(np.ones(len(lines.points)), np.ones(len(hops.top)))
    for attempt in range(ROUNDS):
        profile, eased = find_profile(lines, bounds.eased(ease.segments)), pace.times(ease.hops)
        _check_duration(sample_count(lines, profile, eased))
        timeline = assemble(lines, profile, hops, eased, robot)
        q = robot.inverse(timeline.pose)
        loads = find_loads(q, limits)
        if not loads.worst > 1.0:  # NaN where a hop leaves the reach: the check below names it
            check_samples(robot, timeline.pose, timeline.stroke, timeline.block // 2)
            return _toolpath(timeline, q, loads, pen)
        ease = slowed(ease, timeline, loads, whole_strokes=attempt >= LOCAL_ROUNDS)
    raise ToolpathError("The joints cannot follow this drawing where it lies; move the sheet or draw more slowly.")


def sample(toolpath: Toolpath, t: ArrayLike) -> Sample:
    """The robot at the times t (...), s, between the samples by straight lines; at rest before and after."""
    place = np.clip(np.asarray(t, dtype=float) / STEP_S, 0.0, len(toolpath.t) - 1)
    before = np.minimum(place.astype(int), len(toolpath.t) - 2)
    share, nearest = (place - before)[..., None], np.rint(place).astype(int)
    pose, q = toolpath.pose, toolpath.q
    return Sample(
        pose[before] + share * (pose[before + 1] - pose[before]),
        q[before] + share * (q[before + 1] - q[before]),
        toolpath.pen[nearest],
        toolpath.stroke[nearest],
    )


def _check_duration(samples: int) -> None:
    if samples * STEP_S > LONGEST_S:
        minutes = samples * STEP_S / 60
        raise DrawingError(f"This drawing would take {minutes:.0f} minutes; keep fewer strokes or draw faster.")


def _toolpath(timeline: Timeline, q: Array, loads: Loads, pen: PenSettings) -> Toolpath:
    stroke, block = timeline.stroke, timeline.block
    travelling = (stroke < 0) & (block > 0) & (block < block[-1])
    down = (stroke >= 0) | (travelling & pen.marks_hops)
    step = np.linalg.norm(np.diff(timeline.pose[:, :3], axis=0), axis=1)
    stray = down[1:] & down[:-1] & ((stroke[1:] < 0) | (block[1:] != block[:-1]))
    return Toolpath(
        t=STEP_S * np.arange(float(len(q))),
        pose=timeline.pose,
        q=q,
        pen=down,
        stroke=stroke,
        speed_m_s=np.concatenate([[0.0], 0.5 * (step[1:] + step[:-1]) / STEP_S, [0.0]]),
        max_joint_speed_ratio=float(loads.speed.max()),
        max_joint_acceleration_ratio=float(loads.acceleration.max()),
        stray_ink_mm=1e3 * float(step[stray].sum()),
    )
