"""What a person chooses about a motion: plain data, with sensible defaults for each robot."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from app.robots import Robot, build_robot
from app.robots.limits import DriveLimits, drive_limits


@dataclass(frozen=True)
class MotionSettings:
    """A curve around the robot's home, a time law, and how much of the drives may be used."""

    robot: str = "par4"
    dimensions: dict[str, float] = field(default_factory=dict)
    """Changed dimensions of the robot, m and rad."""
    curve: str = "circle"
    """Key of `CURVES`."""
    profile: str = "jerk-limited"
    """Key of `PROFILES`."""
    size_m: float = 0.06
    """Radius of the upright cylinder that the curve just fits in."""
    height_m: float = 0.03
    """Rise of a line or helix from end to end, lift of an arch."""
    lower_m: float = 0.0
    """The middle of the curve below home."""
    turns: float = 3.0
    """Of a helix."""
    sides: int = 4
    """Of a polygon."""
    laps: int = 1
    """Rounds of a closed curve."""
    turn_rad: float = 0.0
    """How far the tool turns along the curve, and back on a closed one; for robots with a rotation."""
    duration_s: float | None = None
    """None: as short as the limits allow."""
    speed_share: float = 0.8
    """How much of the drives' speed may be used, in (0, 1]."""
    acceleration_share: float = 0.8
    effort_share: float = 0.8
    """Of the peak torque or force; the rest is left to the controller and to friction."""
    payload_kg: float = 0.0

    def build(self) -> Robot:
        return build_robot(self.robot, self.dimensions)

    def limits(self, robot: Robot) -> DriveLimits:
        """What the planner may use of the drives."""
        speed, acceleration, effort = drive_limits(robot)
        return DriveLimits(speed * self.speed_share, acceleration * self.acceleration_share, effort * self.effort_share)


DEFAULTS: dict[str, MotionSettings] = {
    "par4": MotionSettings("par4", size_m=0.06, height_m=0.04, turn_rad=math.radians(60.0)),
    "delta3": MotionSettings("delta3", size_m=0.08, height_m=0.05, lower_m=0.02),
    "linear": MotionSettings("linear", curve="helix", size_m=0.08, height_m=0.12, lower_m=0.12),
    "fivebar": MotionSettings("fivebar", size_m=0.06, height_m=0.02, turn_rad=math.radians(90.0)),
}


def default_motion(robot_name: str) -> MotionSettings:
    """Settings with which every curve stays within reach of the robot's default geometry."""
    return DEFAULTS[robot_name]
