"""How far and how fast a robot may be moved by hand."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from app.link.motions.motion import Joints
from app.link.protocol.settings import setting_id
from app.robots import Robot
from app.robots.limits import rate_limits
from app.simulation.run import SHOWN

TOOL_SPEED = 0.25
"""m/s, of the tool in manual mode."""

KEEP = 0.95
"""Share of a speed limit that the host makes use of: the board must never have to slow down for it."""

RISE_S = 0.25
"""From rest to full manual speed."""

AHEAD = 0.5
"""Share of the longest jump that a target may be ahead of the board's set-point."""

JUMP_S = 0.2
"""The longest jump, as time at full speed, until the board's own is known."""

UNHOMED_SHARE = 0.3
"""Of the joints' speeds before homing, until the board's own share is known."""

TURN_SPEED = 1.5
"""rad/s, of a rotating tool in manual mode."""


@dataclass(frozen=True, eq=False)
class Bounds:
    """Of one robot with n joints on one board."""

    robot: Robot
    low: Joints
    high: Joints
    speed: Joints
    """(n,) rad/s or m/s, to either side"""
    tool_speed: float
    jump: Joints
    """(n,) how far a target may be from the board's set-point."""

    @property
    def joints(self) -> int:
        return len(self.low)

    def pose(self, joints: Sequence[float]) -> Joints | None:
        """(dof,) None where the joints do not assemble."""
        pose = tuple(self.robot.forward(joints).tolist())
        return None if any(value != value for value in pose) else pose

    def obstacle(self, joints: Sequence[float]) -> str:
        """Why the joints must not be there, with the advice for a hand that moves them; empty if they may."""
        unit, factor = SHOWN[self.robot.joint_unit]
        for number, (q, low, high) in enumerate(zip(joints, self.low, self.high, strict=True), 1):
            if not low <= q <= high:
                limit = factor * (high if q > high else low)
                return f"Joint {number} is at its limit of {limit:.1f} {unit}; move it the other way."
        return ""

    def outruns(self, target: Sequence[float], setpoint: Sequence[float]) -> bool:
        """Whether the board is so far behind its targets that they had better wait."""
        gaps = zip(target, setpoint, self.jump, strict=False)
        return any(abs(b - a) > AHEAD * jump for a, b, jump in gaps)

    def load(self, joints: Sequence[float], others: Sequence[float], dt_s: float) -> float:
        """The fastest joint's share of the speed that it may have, on the way from one to the other."""
        steps = zip(joints, others, self.speed, strict=True)
        return max(abs(b - a) / (KEEP * speed * dt_s) for a, b, speed in steps)


def bounds_of(robot: Robot, settings: Mapping[int, float], homed: bool) -> Bounds:
    """The narrower of the robot's own limits and the board's. Before homing a board lets joints creep only."""
    joints = range(len(robot.joint_names))
    declared, limits = rate_limits(robot).speed.tolist(), robot.joint_limits.tolist()
    speeds = [settings.get(setting_id("speed", j), declared[j]) for j in joints]
    share = 1.0 if homed else settings.get(setting_id("home_speed"), UNHOMED_SHARE)
    jump_s = settings.get(setting_id("jump"), JUMP_S)
    return Bounds(
        robot,
        tuple(max(limits[j][0], settings.get(setting_id("min", j), -math.inf)) for j in joints),
        tuple(min(limits[j][1], settings.get(setting_id("max", j), math.inf)) for j in joints),
        tuple(share * speed for speed in speeds),
        min(TOOL_SPEED, settings.get(setting_id("tool_speed"), TOOL_SPEED)),
        tuple(jump_s * speed for speed in speeds),
    )
