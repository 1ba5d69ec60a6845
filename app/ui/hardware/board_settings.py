"""A board's settings in the units that people use, and what somebody has changed but not applied yet."""

from __future__ import annotations

import math
from typing import NamedTuple

from app.link.protocol.settings import SETTINGS, Setting, setting_id
from app.link.status import LinkStatus
from app.robots import Robot

GROUPS: dict[str, tuple[str, ...]] = {
    "Gains": ("kp", "ki", "kd", "n"),
    "Limits and speeds": ("min", "max", "speed"),
    "Sensors and homing": ("offset", "scale", "home"),
    "Tool and supply": ("tool_speed", "home_speed", "supply", "duty_max", "pen_up", "pen_down"),
    "Safety": ("hold_after", "off_after", "stop_time", "jump", "following", "following_time"),
}
"""What is shown together; the board's number and its geometry are not changed by hand."""

ALL: str = "All joints"

_DEGREE = 180.0 / math.pi
_SHOWN = {
    "rad": ("°", _DEGREE),
    "rad/s": ("°/s", _DEGREE),
    "rad/raw": ("°/raw", _DEGREE),
    "V/rad": ("V/°", 1.0 / _DEGREE),
    "V/(rad s)": ("V/(° s)", 1.0 / _DEGREE),
    "V s/rad": ("V s/°", 1.0 / _DEGREE),
    "m": ("mm", 1e3),
    "m/s": ("mm/s", 1e3),
    "m/raw": ("mm/raw", 1e3),
    "V/m": ("V/mm", 1e-3),
    "V/(m s)": ("V/(mm s)", 1e-3),
    "V s/m": ("V s/mm", 1e-3),
    "share": ("%", 100.0),
}
"""Unit on the board -> unit on the page, and the factor."""


class Shown(NamedTuple):
    """How one setting is shown."""

    setting: Setting
    unit: str
    factor: float
    """Shown value per value on the board."""


def shown_as(name: str, robot: Robot) -> Shown:
    setting = SETTINGS[name]
    unit = setting.unit_of(robot.joint_unit)
    text, factor = (unit, 1.0) if name == "n" else _SHOWN.get(unit, (unit, 1.0))
    return Shown(setting, text, factor)


def ids_of(name: str, joint: str, robot: Robot) -> list[int]:
    """The settings that a field stands for; `joint` is a joint's name or `ALL`."""
    if not SETTINGS[name].per_joint:
        return [setting_id(name)]
    names = robot.joint_names
    joints = range(len(names)) if joint == ALL else [names.index(joint)]
    return [setting_id(name, k) for k in joints]


class Edits:
    """Values as they were typed, by setting."""

    def __init__(self) -> None:
        self._typed: dict[int, float] = {}

    def __len__(self) -> int:
        return len(self._typed)

    def type(self, name: str, joint: str, value: float, robot: Robot) -> None:
        """Somebody has typed a value in the unit of the page."""
        for id in ids_of(name, joint, robot):
            self._typed[id] = value / shown_as(name, robot).factor

    def value(self, name: str, joint: str, status: LinkStatus, robot: Robot) -> float | None:
        """What a field shows: what was typed, else what the board has; None where neither is known."""
        first = ids_of(name, joint, robot)[0]
        value = self._typed.get(first, status.settings.get(first))
        return None if value is None else float(f"{value * shown_as(name, robot).factor:.6g}")

    @property
    def values(self) -> dict[int, float]:
        """By id, as the board takes them."""
        return dict(self._typed)

    def clear(self) -> None:
        self._typed.clear()
