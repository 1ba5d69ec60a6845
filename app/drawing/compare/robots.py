"""The same strokes on each of the robots, every one with its sheet where it draws best."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.drawing.errors import DrawingError
from app.drawing.toolpath import (
    PenSettings,
    Placement,
    Toolpath,
    ToolpathError,
    default_pen,
    default_placement,
    plan_toolpath,
    unreachable,
)
from app.robots import GeometryError, Robot, build_robot
from app.robots.limits import rate_limits
from app.robots.robot import Array

LEAST_SCALE = 0.01
HALVINGS = 10
SHRINK, SHRINKINGS = 0.97, 20
"""Where the strokes fit and the ways between them do not, the drawing is made smaller in such steps."""

CONDITIONING_STEP = 5
"""Samples (ms) from one condition number to the next: the pen moves by 2 mm at most in between."""


@dataclass(frozen=True)
class RobotResult:
    """One robot's drawing; numbers are NaN where it cannot draw at all."""

    robot: str
    """Name in `ROBOTS`."""
    time_s: float = math.nan
    """Of the whole trajectory, the sum of the following two."""
    down_s: float = math.nan
    """On the strokes."""
    hops_s: float = math.nan
    """Between, before and after them."""
    peak_joint_speed: float = math.nan
    """Of the joint that comes nearest to its limit, in `speed_unit`."""
    peak_joint_speed_ratio: float = math.nan
    """The same as a share of that joint's limit."""
    worst_conditioning: float = math.nan
    """Condition number of the Jacobian, 1 at best."""
    mean_conditioning: float = math.nan
    """Over time."""
    reason: str = ""
    """Why the robot draws it smaller or not at all, one sentence."""
    scaled_to: float = 1.0
    """The largest scale, at most 1, at which the drawing fits; the numbers are those of that drawing."""
    speed_unit: str = "rad/s"
    """rad/s or m/s"""


def draw_on(
    strokes: Sequence[Array],
    robot_name: str,
    pen: PenSettings | None = None,
    dimensions: Mapping[str, float] | None = None,
) -> RobotResult:
    """What one robot makes of the strokes, (n, 2) sheet mm each, at its default placement; never an exception.

    pen: by default what suits the robot. dimensions: of `build_robot`, by default the robot's own.
    """
    try:
        robot = build_robot(robot_name, dimensions or {})
        return _drawn(strokes, robot, pen or default_pen(robot))
    except (DrawingError, GeometryError) as error:
        return RobotResult(robot_name, reason=str(error))


def largest_scale(strokes: Sequence[Array], robot: Robot, placement: Placement, pen: PenSettings) -> float:
    """The largest scale, at most 1, at which the strokes and their lifted ends are in reach; NaN if none is."""

    def fits(scale: float) -> bool:
        return _fits(_scaled(strokes, scale), robot, placement, pen)

    if fits(1.0):
        return 1.0
    if not fits(LEAST_SCALE):
        return math.nan
    low, high = LEAST_SCALE, 1.0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if fits(middle) else (low, middle)
    return low


def _drawn(strokes: Sequence[Array], robot: Robot, pen: PenSettings) -> RobotResult:
    placement = default_placement(robot)
    try:
        return _measured(plan_toolpath(strokes, robot, placement, pen), robot)
    except ToolpathError as error:
        why = str(error).partition(";")[0]
    scale = largest_scale(strokes, robot, placement, pen)
    if math.isnan(scale):
        return RobotResult(robot.name, reason=f"{why}; it can draw nothing of this where its sheet lies.")
    toolpath, scale = _planned_smaller(strokes, robot, placement, pen, scale)
    reason = f"{why}: drawn at {100 * scale:.3g} % of the size."
    return _measured(toolpath, robot, scale, reason)


def _planned_smaller(
    strokes: Sequence[Array], robot: Robot, placement: Placement, pen: PenSettings, scale: float
) -> tuple[Toolpath, float]:
    """The toolpath at this scale, or at the next smaller one at which also the hops are in reach."""
    for _ in range(SHRINKINGS):
        try:
            return plan_toolpath(_scaled(strokes, scale), robot, placement, pen), scale
        except ToolpathError:
            scale *= SHRINK
    return plan_toolpath(_scaled(strokes, scale), robot, placement, pen), scale


def _fits(strokes: Sequence[Array], robot: Robot, placement: Placement, pen: PenSettings) -> bool:
    if any(outside.any() for outside in unreachable(strokes, robot, placement)):
        return False
    if not pen.rises:
        return True
    lifted = replace(placement, height_m=placement.height_m + 1e-3 * pen.lift_mm)
    ends = np.concatenate([stroke[[0, -1]] for stroke in strokes])
    return not unreachable([ends], robot, lifted)[0].any()


def _scaled(strokes: Sequence[Array], scale: float) -> list[Array]:
    return [scale * np.asarray(stroke, dtype=float) for stroke in strokes]


def _measured(toolpath: Toolpath, robot: Robot, scale: float = 1.0, reason: str = "") -> RobotResult:
    down_s = toolpath.duration_s * float(np.mean(toolpath.stroke >= 0))
    speed = np.abs(np.diff(toolpath.q, axis=0)).max(axis=0) / (toolpath.t[1] - toolpath.t[0])
    ratio = speed / rate_limits(robot).speed
    busiest = int(np.argmax(ratio))
    conditioning = robot.conditioning(toolpath.pose[::CONDITIONING_STEP])
    return RobotResult(
        robot.name,
        toolpath.duration_s,
        down_s,
        toolpath.duration_s - down_s,
        float(speed[busiest]),
        float(ratio[busiest]),
        float(conditioning.max()),
        float(conditioning.mean()),
        reason,
        scale,
        f"{robot.joint_units[busiest]}/s",
    )
