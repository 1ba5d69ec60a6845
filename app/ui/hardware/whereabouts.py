"""Where the robot on the table is, as a picture of it needs it: its pose with the joints that belong to it."""

from __future__ import annotations

from typing import NamedTuple

from app.link.protocol.codes import Flag
from app.link.status import LinkStatus, Pose


class Place(NamedTuple):
    """Where a robot is: pose (dof,) and joints (n,), m and rad."""

    pose: Pose
    joints: tuple[float, ...]


def measured(status: LinkStatus) -> Place | None:
    """As its sensors see it; None where that is not known, as before homing."""
    return None if status.telemetry is None else _place(status, status.measured_pose, status.telemetry.position)


def commanded(status: LinkStatus) -> Place | None:
    """Where the board's set-point is; None like the other."""
    return None if status.telemetry is None else _place(status, status.commanded_pose, status.telemetry.setpoint)


def _place(status: LinkStatus, pose: Pose | None, joints: tuple[float, ...]) -> Place | None:
    if pose is None or status.robot is None or status.telemetry is None or Flag.HOMED not in status.telemetry.flags:
        return None
    return Place(pose, joints[: len(status.robot.joint_names)])
