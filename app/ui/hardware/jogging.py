"""Jog buttons: which there are, and what each of them asks of the link."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

from app.link.programs import Jog
from app.link.protocol.settings import setting_id
from app.ui.panels.units import GREEK

if TYPE_CHECKING:
    from app.link.status import LinkStatus
    from app.robots import Robot

Space = Literal["joint", "pose"]

STEPS = (0.1, 1.0, 10.0)
"""mm or degrees."""

SPEED = {"rad": 0.5, "m": 0.1}
"""At 100 %, rad/s or m/s, as long as the board's own limits are not known."""


class JogAxis(NamedTuple):
    """What two buttons move."""

    space: Space
    axis: int
    name: str
    unit: Literal["rad", "m"]


def axes_of(robot: Robot, space: Space) -> list[JogAxis]:
    """The joints, or the axes of the pose."""
    if space == "joint":
        units = robot.joint_units
        return [
            JogAxis("joint", k, name, "m" if units[k] == "m" else "rad") for k, name in enumerate(robot.joint_names)
        ]
    return [
        JogAxis("pose", k, GREEK.get(name, name), "m" if k < 3 else "rad") for k, name in enumerate(robot.pose_names)
    ]


def key_of(axis: JogAxis, direction: int) -> str:
    """Name of a button: `joint:0:+`."""
    return f"{axis.space}:{axis.axis}:{'+' if direction > 0 else '-'}"


def jog_of(key: str, status: LinkStatus, share: float) -> tuple[Jog, JogAxis] | None:
    """What a button asks for, at a share of full jog speed; None for a key of another robot, or of none."""
    space, _, rest = key.partition(":")
    number, _, sign = rest.partition(":")
    if status.robot is None or space not in ("joint", "pose") or not number.isdecimal() or sign not in ("+", "-"):
        return None
    axes = axes_of(status.robot, "joint" if space == "joint" else "pose")
    if int(number) >= len(axes):
        return None
    axis = axes[int(number)]
    speed = share * full_speed(axis, status)
    return Jog(axis.space, axis.axis, 1 if sign == "+" else -1, speed), axis


def full_speed(axis: JogAxis, status: LinkStatus) -> float:
    """Of one axis, rad/s or m/s: no more than the board lets it have."""
    if axis.space == "joint":
        known = status.settings.get(setting_id("speed", axis.axis))
    else:
        known = status.settings.get(setting_id("tool_speed")) if axis.unit == "m" else None
    return SPEED[axis.unit] if known is None else min(SPEED[axis.unit], known)
