"""A delta against a serial arm of two links: an exercise, for want of what its source measured.

The paper on the delta3 (Rivas et al. 2015) says that it draws lines 20 % and tones 18 % faster than "the serial
robot", and neither which one, nor where it stood, nor what was drawn. So both robots get the same simple rule and
everything assumed is listed: the busiest joint always turns at its top speed, and a path takes

    t = sum over small steps of max_j |dq_j| / limit
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.drawing.errors import DrawingError
from app.drawing.toolpath import Placement, default_placement
from app.drawing.toolpath.placement import poses
from app.drawing.toolpath.polyline import check_strokes
from app.robots import Robot, make_robot
from app.robots.robot import Array

STEP_MM = 1.0
"""Longest step for which the joints are computed."""

SHARE = 0.6
"""Of the arm's reach, at which the sheet's middle lies: with 200 + 200 mm all of an A5 sheet is in reach."""

PUBLISHED = "The paper's 20 % (lines) and 18 % (tones) are not reproduced: it names no serial robot and no drawing."


@dataclass(frozen=True)
class SerialArm:
    """Two links that turn in the plane of the sheet; the elbow stays on one side. Sheet axes, origin in its middle."""

    l1_m: float
    """Shoulder to elbow."""
    l2_m: float
    """Elbow to pen."""
    base_m: tuple[float, float]
    """Where the shoulder stands."""
    elbow: int = 1
    """1 for an elbow angle between 0 and pi, -1 for the mirrored arm."""

    def __post_init__(self) -> None:
        if not (0.01 <= self.l1_m <= 10.0 and 0.01 <= self.l2_m <= 10.0 and self.elbow in (-1, 1)):
            raise DrawingError("An arm's links measure 0.01 to 10 m each; choose lengths in this range.")
        if not all(abs(along) <= 20.0 for along in self.base_m):
            raise DrawingError("The arm's shoulder must stand within 20 m of the sheet; choose a place nearby.")

    def inverse(self, points_m: Array) -> Array:
        """Shoulder and elbow angles (..., 2) at points (..., 2); NaN out of reach."""
        x, y = np.moveaxis(np.asarray(points_m, dtype=float) - self.base_m, -1, 0)
        c = (x * x + y * y - self.l1_m**2 - self.l2_m**2) / (2.0 * self.l1_m * self.l2_m)
        bend = self.elbow * np.arccos(np.where(np.abs(c) <= 1.0, c, np.nan))
        turn = np.arctan2(y, x) - np.arctan2(self.l2_m * np.sin(bend), self.l1_m + self.l2_m * np.cos(bend))
        return np.stack([turn, bend], axis=-1)

    def forward(self, angles: Array) -> Array:
        """Points (..., 2) of shoulder and elbow angles (..., 2)."""
        turn, bend = np.moveaxis(np.asarray(angles, dtype=float), -1, 0)
        x = self.l1_m * np.cos(turn) + self.l2_m * np.cos(turn + bend)
        y = self.l1_m * np.sin(turn) + self.l2_m * np.sin(turn + bend)
        return np.stack([x, y], axis=-1) + self.base_m

    def reach(self, points_m: Array) -> str:
        """Why the arm cannot draw through the points (n, 2), in one sentence; empty if it can."""
        distance = np.hypot(*(np.asarray(points_m, dtype=float) - self.base_m).T)
        too_far = float(distance.max()) - (self.l1_m + self.l2_m)
        too_near = abs(self.l1_m - self.l2_m) - float(distance.min())
        if too_far > 0.0:
            return f"The arm is {1e3 * too_far:.0f} mm too short; lengthen a link or bring its shoulder nearer."
        if too_near > 0.0:
            return f"The drawing comes {1e3 * too_near:.0f} mm too near the shoulder; move the shoulder away."
        return ""


@dataclass(frozen=True)
class ArmComparison:
    """Quasi-static times of one drawing, from the first stroke's beginning to the last one's end."""

    delta_s: float
    """NaN if the robot cannot draw it."""
    arm_s: float
    """NaN if the arm cannot draw it."""
    saving_percent: float
    """Of the arm's time; negative where the arm is faster, NaN where a time is missing."""
    assumptions: tuple[str, ...]
    """A sentence each."""
    reason: str = ""
    """Why a time is missing, one sentence."""


def arm_behind(l1_m: float = 0.2, l2_m: float = 0.2, share: float = SHARE) -> SerialArm:
    """An arm below the lower edge of the sheet, whose middle lies at this share of the arm's reach."""
    return SerialArm(l1_m, l2_m, (0.0, -share * (l1_m + l2_m)))


def compare_with_arm(
    strokes: Sequence[Array],
    arm: SerialArm,
    joint_speed_rad_s: float = 4.0,
    robot: str | Robot = "delta3",
    placement: Placement | None = None,
) -> ArmComparison:
    """How long a robot and the arm take for the same strokes, (n, 2) mm each.

    What cannot be compared has NaN for its time and the reason; DrawingError for no strokes or no speed.
    """
    machine = make_robot(robot) if isinstance(robot, str) else robot
    if not 0.0 < joint_speed_rad_s < math.inf:
        raise DrawingError("The joints need a speed above 0 rad/s to be compared; choose one.")
    way = _small_steps(strokes)
    delta_q, delta_reason = _joints(machine, way, placement or default_placement(machine))
    arm_reason = arm.reach(1e-3 * way)
    delta_s = math.nan if delta_reason else quasi_static_s(delta_q, joint_speed_rad_s)
    arm_s = math.nan if arm_reason else quasi_static_s(arm.inverse(1e-3 * way), joint_speed_rad_s)
    return ArmComparison(
        delta_s,
        arm_s,
        100.0 * (1.0 - delta_s / arm_s) if arm_s else math.nan,
        _assumptions(machine, arm, joint_speed_rad_s),
        delta_reason or arm_reason,
    )


def quasi_static_s(q: Array, limit: float) -> float:
    """Time of a path of joints (n, joints) in small steps whose busiest joint always moves at the limit, rad/s."""
    return float(np.abs(np.diff(np.unwrap(q, axis=0), axis=0)).max(axis=1).sum()) / limit


def _small_steps(strokes: Sequence[Array]) -> Array:
    """(n, 2) mm along all strokes and straight from each to the next."""
    check_strokes(strokes)
    corners = np.concatenate(strokes)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))])
    at = np.union1d(along, np.arange(0.0, along[-1], STEP_MM))
    return np.column_stack([np.interp(at, along, corners[:, axis]) for axis in (0, 1)])


def _joints(robot: Robot, way_mm: Array, placement: Placement) -> tuple[Array, str]:
    """Joints (n, joints) along the way, and why they cannot be compared with an arm's."""
    pose = poses(robot, placement.on_table(way_mm), placement.height_m)
    q, inside = robot.inverse(pose), robot.reachable(pose)
    if robot.joint_unit != "rad":
        return q, f"The joints of the {robot.title} slide and an arm's turn; choose a robot whose joints turn."
    if not inside.all():
        return q, f"{robot.title}: {robot.reach(pose[int(np.argmin(inside))]).reason}"
    return q, ""


def _assumptions(robot: Robot, arm: SerialArm, joint_speed_rad_s: float) -> tuple[str, ...]:
    x, y = (1e3 * along for along in arm.base_m)
    return (
        f"The busiest joint of each robot always turns at {joint_speed_rad_s:g} rad/s; masses, motors and "
        "accelerations do not count.",
        f"The {robot.title} has the dimensions and the sheet where they are now.",
        f"The arm has links of {1e3 * arm.l1_m:.0f} and {1e3 * arm.l2_m:.0f} mm, its shoulder at x = {x:.0f}, "
        f"y = {y:.0f} mm from the middle of the sheet, and its elbow on one side.",
        "Between strokes both go straight across at the same rule; lifting the pen takes no time.",
        PUBLISHED,
    )
