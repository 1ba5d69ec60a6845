"""Before anything moves: is every point of a drawing, and every sample of its trajectory, inside reach and limits?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.toolpath.placement import Placement, poses
from app.drawing.toolpath.polyline import Polylines, check_strokes
from app.robots import Robot
from app.robots.robot import Array


class ToolpathError(DrawingError):
    """A drawing that this robot cannot draw where it lies; the message names the stroke and the limit."""


def unreachable(strokes: Sequence[Array], robot: Robot, placement: Placement) -> list[NDArray[np.bool_]]:
    """Which vertices of each stroke the pen cannot reach on the paper: (n,) for a stroke of (n, 2) mm."""
    if not len(strokes):
        return []
    check_strokes(strokes)
    points = placement.on_table(np.concatenate(strokes))
    outside = ~robot.reachable(poses(robot, points, placement.height_m))
    return np.split(outside, np.cumsum([len(stroke) for stroke in strokes])[:-1])


def check_lines(lines: Polylines, robot: Robot, paper_m: float, lift_m: float, *, rises: bool = True) -> None:
    """ToolpathError unless the pen reaches every vertex on the paper, and the places where it is lifted.

    Args:
        rises: whether these are the ends of every stroke, or only where the drawing begins and ends.
    """
    _check(robot, poses(robot, lines.points, paper_m), lines.stroke, "Stroke {} is beyond the robot")
    ends = np.concatenate([lines.first[:-1], lines.last]) if rises else np.array([0, lines.last[-1]])
    lifted = poses(robot, lines.points[ends], paper_m + lift_m)
    _check(robot, lifted, lines.stroke[ends], "The pen cannot be lifted at an end of stroke {}")


def check_samples(robot: Robot, pose: Array, stroke: NDArray[np.int64], before: NDArray[np.int64]) -> None:
    """ToolpathError unless every sample is in reach.

    Args:
        pose: (k, dof)
        stroke: (k,) the stroke being drawn, -1 in hops.
        before: (k,) the stroke that is drawn or comes next.
    """
    drawn = stroke >= 0
    _check(robot, pose[drawn], stroke[drawn], "Stroke {} is beyond the robot")
    _check(robot, pose[~drawn], before[~drawn], "The way to stroke {} is beyond the robot")


def _check(robot: Robot, pose: Array, stroke: NDArray[np.int64], complaint: str) -> None:
    inside = robot.reachable(pose)
    if inside.all():
        return
    first = int(np.argmin(inside))
    reason = robot.reach(pose[first]).reason.rstrip(".")
    where = complaint.format(int(stroke[first]) + 1)
    raise ToolpathError(f"{where} ({reason}); make the drawing smaller or move the sheet.")
