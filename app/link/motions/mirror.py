"""After a hand: to the newest pose, along a straight line, at most with the manual speed."""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.link.errors import LinkError
from app.link.motions.bounds import KEEP, RISE_S, TURN_SPEED, Bounds
from app.link.motions.motion import Joints, Target
from app.link.status import Activity

ATTEMPTS = 4
STANDS = 1e-6
"""Closer than this (m or rad) it is there."""


class MirrorMotion:
    """Follows until it is given up; a pose out of reach is followed to the nearest one within."""

    activity: Activity = "mirror"
    finished = False
    notice = ""

    def __init__(self, bounds: Bounds, pose: Sequence[float], joints: Joints) -> None:
        start = bounds.pose(joints)
        if start is None:
            raise LinkError("The joints do not give a pose of the tool; home the robot first.")
        self._bounds, self._joints = bounds, joints
        self._at, self._goal = start, start
        self._speed = 0.0
        self._top = KEEP * bounds.tool_speed
        self.follow(pose)

    def follow(self, pose: Sequence[float]) -> None:
        """The newest pose (dof,)."""
        robot = self._bounds.robot
        if len(pose) != robot.dof or not all(map(math.isfinite, pose)):
            raise LinkError(f"A pose of this robot has {robot.dof} numbers; choose it on the robot in the picture.")
        self._goal = tuple(robot.nearest(pose, seed=self._at).tolist())

    def advance(self, dt_s: float, share: float) -> Target:
        gaps = [goal - at for goal, at in zip(self._goal, self._at, strict=True)]
        # a turn counts as the way that takes as long
        gap = math.hypot(*gaps[:3], *(turn * self._top / TURN_SPEED for turn in gaps[3:]))
        acceleration = self._top / RISE_S
        braking = math.sqrt(2.0 * acceleration * gap)
        self._speed = min(self._speed + acceleration * dt_s, share * self._top, braking)
        if gap > STANDS:
            self._step([value * min(self._speed * dt_s / gap, 1.0) for value in gaps], dt_s)
        return Target(self._joints)

    def _step(self, way: list[float], dt_s: float) -> None:
        """Go by `way`, or by the part of it that the joints can follow; along the edge of what is in reach."""
        part = 1.0
        for _ in range(ATTEMPTS):
            ahead = self._ahead([part * value for value in way])
            joints = self._bounds.robot.solve(*ahead)
            load = self._bounds.load(self._joints, joints, dt_s)
            if load <= 1.0 and not self._bounds.obstacle(joints):
                self._at, self._joints = ahead, joints
                return
            part *= KEEP / load if load > 1.0 else 0.5
        self._speed = 0.0

    def _ahead(self, way: list[float]) -> Joints:
        ahead = tuple(at + value for at, value in zip(self._at, way, strict=True))
        robot = self._bounds.robot
        return ahead if robot.reach(ahead).ok else tuple(robot.nearest(ahead, seed=self._at).tolist())
