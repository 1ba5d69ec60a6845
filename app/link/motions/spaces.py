"""The two kinds of axes that a robot is moved along: its joints, and the coordinates of its pose."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Protocol

from app.link.errors import LinkError
from app.link.motions.bounds import KEEP, RISE_S, TURN_SPEED, Bounds
from app.link.motions.motion import Joints
from app.link.programs import Jog
from app.robots import Robot

LEVER_STEP = 1e-4
"""rad or m"""


class Space(Protocol):
    """Coordinates in which one axis is changed."""

    bounds: Bounds
    start: Joints
    """Coordinates at the beginning."""

    def joints(self, at: Sequence[float]) -> Joints:
        """(n,) NaN where there are none."""
        ...

    def obstacle(self, at: Sequence[float]) -> str:
        """Why the robot must not be there; empty if it may."""
        ...

    def top_speed(self, axis: int) -> float: ...

    def too_fast(self, at: Sequence[float], then: Sequence[float], dt_s: float) -> bool: ...


class JointSpace:
    """Joints, one by one; before homing too, when nobody knows the pose."""

    def __init__(self, bounds: Bounds, joints: Joints) -> None:
        self.bounds, self.start = bounds, joints
        self._assembled = bounds.pose(joints) is not None
        self._lever = functools.lru_cache(1)(self._find_lever)

    def joints(self, at: Sequence[float]) -> Joints:
        return tuple(at)

    def obstacle(self, at: Sequence[float]) -> str:
        reason = self.bounds.obstacle(at)
        if not reason and self._assembled and self.bounds.pose(at) is None:
            return "The rods do not reach farther; move another joint, or this one the other way."
        return reason

    def top_speed(self, axis: int) -> float:
        return KEEP * self.bounds.speed[axis]

    def too_fast(self, at: Sequence[float], then: Sequence[float], dt_s: float) -> bool:
        axis = max(range(len(at)), key=lambda number: abs(then[number] - at[number]))
        way = self._lever(tuple(at), axis) * abs(then[axis] - at[axis])
        return way > KEEP * self.bounds.tool_speed * dt_s

    def _find_lever(self, at: Joints, axis: int) -> float:
        """How far the tool moves with one joint, m/rad or m/m; 0 where nobody knows. Forward kinematics take time."""
        beside = (*at[:axis], at[axis] + LEVER_STEP, *at[axis + 1 :])
        here, there = self.bounds.robot.forward([at, beside])[:, :3].tolist()
        lever = math.dist(here, there) / LEVER_STEP
        return lever if math.isfinite(lever) else 0.0


class PoseSpace:
    """Coordinates of the tool."""

    def __init__(self, bounds: Bounds, joints: Joints) -> None:
        pose = bounds.pose(joints)
        if pose is None:
            raise LinkError("The joints do not give a pose of the tool; home the robot, or jog its joints.")
        self.bounds, self.start = bounds, pose

    def joints(self, at: Sequence[float]) -> Joints:
        return self.bounds.robot.solve(*at)

    def obstacle(self, at: Sequence[float]) -> str:
        verdict = self.bounds.robot.reach(at)
        return self.bounds.obstacle(self.joints(at)) if verdict.ok else verdict.reason

    def top_speed(self, axis: int) -> float:
        return KEEP * self.bounds.tool_speed if axis < 3 else TURN_SPEED

    def too_fast(self, at: Sequence[float], then: Sequence[float], dt_s: float) -> bool:
        return not self.bounds.load(self.joints(at), self.joints(then), dt_s) <= 1.0


def space_of(jog: Jog, bounds: Bounds, joints: Joints) -> Space:
    """The space of a jog or a step, from where the joints are."""
    check_axis(jog, bounds.robot)
    return JointSpace(bounds, joints) if jog.space == "joint" else PoseSpace(bounds, joints)


def check_axis(jog: Jog, robot: Robot) -> None:
    """LinkError for an axis that this robot has not, or a speed that is none."""
    axes = robot.joint_names if jog.space == "joint" else robot.pose_names
    if not (0 <= jog.axis < len(axes) and abs(jog.direction) == 1):
        raise LinkError(f"The robot has no such axis; choose one of {', '.join(axes)}, and a direction.")
    if not (math.isfinite(jog.speed) and jog.speed > 0.0):
        raise LinkError("A jog needs a speed above 0; choose one.")


def acceleration(space: Space, axis: int) -> float:
    """Of one axis, per s^2."""
    return space.top_speed(axis) / RISE_S
