"""Poses of the robot on the table that belong to the newest joints, computed once for all rooms.

Those in the link's status are a little older than its telemetry: good for numbers, but a picture would come apart.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from app.link.protocol.codes import Flag
from app.link.protocol.messages import Telemetry
from app.link.status import LinkStatus
from app.robots import Robot


class Place(NamedTuple):
    """Where a robot is: pose (dof,) and joints (n,), m and rad."""

    pose: tuple[float, ...]
    joints: tuple[float, ...]


class Whereabouts:
    """Remembers the newest telemetry's."""

    def __init__(self) -> None:
        self._telemetry: Telemetry | None = None
        self._places: tuple[Place | None, Place | None] = (None, None)

    def measured(self, status: LinkStatus) -> Place | None:
        """As its sensors see it; None where that is not known, as before homing."""
        return self._look(status)[0]

    def commanded(self, status: LinkStatus) -> Place | None:
        """Where the board's set-point is; None like the other."""
        return self._look(status)[1]

    def _look(self, status: LinkStatus) -> tuple[Place | None, Place | None]:
        telemetry, robot = status.telemetry, status.robot
        if telemetry is None or robot is None or Flag.HOMED not in telemetry.flags:
            return None, None
        if telemetry is not self._telemetry:
            self._telemetry, self._places = telemetry, _places(robot, telemetry)
        return self._places


def _places(robot: Robot, telemetry: Telemetry) -> tuple[Place | None, Place | None]:
    n = len(robot.joint_names)
    joints = telemetry.position[:n], telemetry.setpoint[:n]
    measured, commanded = (
        None if np.isnan(pose).any() else Place(tuple(pose.tolist()), own)
        for pose, own in zip(robot.forward(np.array(joints)), joints, strict=True)
    )
    return measured, commanded
