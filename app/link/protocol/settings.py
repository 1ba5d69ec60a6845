"""Everything that can be set on a board: numbers, names, units, and when a board lets itself be changed."""

from __future__ import annotations

from dataclasses import dataclass

from app.link.errors import LinkError
from app.link.protocol.messages import JOINTS

JOINT_SETTINGS = 10
"""Joint j has the ids from 10 j on."""

GEOMETRY_ID = 53
GEOMETRY_SIZE = 23
SETTING_COUNT = GEOMETRY_ID + GEOMETRY_SIZE


@dataclass(frozen=True)
class Setting:
    """One number on the board; of a joint's, `id` is that of joint 0."""

    id: int
    name: str
    unit: str
    """As for a robot whose joints are angles; see `unit_of`."""
    label: str
    per_joint: bool = False
    live: bool = False
    """May be set while the motors hold (READY, HELD, STOPPED); the others in OFF only."""

    def unit_of(self, joint_unit: str) -> str:
        """The unit for a robot whose joints are in `rad` or `m`."""
        return self.unit if self.name == "n" else self.unit.replace("rad", joint_unit)


_JOINT = (
    ("kp", "V/rad", "Proportional gain"),
    ("ki", "V/(rad s)", "Integral gain"),
    ("kd", "V s/rad", "Derivative gain"),
    ("n", "rad/s", "Cut-off of the derivative's filter, 0 for none"),
    ("min", "rad", "Lower limit"),
    ("max", "rad", "Upper limit"),
    ("speed", "rad/s", "Speed limit"),
    ("offset", "rad", "Joint where the sensor reads 0"),
    ("scale", "rad/raw", "Joint per unit of the sensor"),
    ("home", "rad", "Where homing ends"),
)
_LIVE_JOINT = {"kp", "ki", "kd", "n"}

_BOARD = (
    ("tool_speed", "m/s", "Speed limit of the tool in manual mode"),
    ("hold_after", "ms", "Hold after this time without a set-point"),
    ("off_after", "ms", "Off after this time without a sign of life"),
    ("jump", "s", "Farthest target: so long a way at full speed"),
    ("following", "rad", "Largest difference of set-point and position"),
    ("following_time", "ms", "For so long: fault"),
    ("home_speed", "share", "Speed of homing, share of the limit"),
    ("supply", "V", "Supply of the motors"),
    ("serial", "", "Number of the board"),
    ("pen_up", "us", "Pulse of the pen's servo, lifted"),
    ("pen_down", "us", "Pulse of the pen's servo, lowered"),
    ("stop_time", "ms", "From full speed to rest"),
    ("duty_max", "share", "Largest share of the supply"),
)
_LIVE_BOARD = {"tool_speed", "pen_up", "pen_down"}

SETTINGS: dict[str, Setting] = {
    **{
        name: Setting(k, name, unit, label, per_joint=True, live=name in _LIVE_JOINT)
        for k, (name, unit, label) in enumerate(_JOINT)
    },
    **{
        name: Setting(JOINTS * JOINT_SETTINGS + k, name, unit, label, live=name in _LIVE_BOARD)
        for k, (name, unit, label) in enumerate(_BOARD)
    },
}
"""By name. The geometry (ids 53 to 75) is one thing: see `app.link.board_geometry`."""

_BY_ID = {setting.id: setting for setting in SETTINGS.values()}


def setting_id(name: str, joint: int | None = None) -> int:
    """The id of a setting; those of a joint (from 0) need one.

    Raises:
        LinkError: if there is no such setting or joint.
    """
    setting = SETTINGS.get(name)
    if setting is None:
        raise LinkError(f"A board has no setting {name!r}; it has {', '.join(SETTINGS)}.")
    if not setting.per_joint:
        return setting.id
    if joint is None or not 0 <= joint < JOINTS:
        raise LinkError(f"{name} belongs to a joint; say which one, 0 to {JOINTS - 1}.")
    return JOINT_SETTINGS * joint + setting.id


def setting_of(id: int) -> tuple[Setting, int | None]:
    """The setting with this id (0 to 52), and its joint if it is a joint's.

    Raises:
        LinkError: if there is none, or it is part of the geometry.
    """
    joint, k = divmod(id, JOINT_SETTINGS)
    if 0 <= joint < JOINTS:
        return _BY_ID[k], joint
    if id not in _BY_ID:
        raise LinkError(f"A board has no setting number {id}; 0 to {GEOMETRY_ID - 1} have names.")
    return _BY_ID[id], None


def is_live(id: int) -> bool:
    """Whether a board lets this setting be changed while its motors hold."""
    return id < GEOMETRY_ID and setting_of(id)[0].live
