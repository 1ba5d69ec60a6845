"""The settings on a board: what they may be, and how they are kept."""

from __future__ import annotations

import binascii
import math
import struct

from app.link.board_geometry import BOARD_ROBOTS
from app.link.errors import LinkError
from app.link.firmware.generate import BUILDS, settings
from app.link.protocol.codes import PROTOCOL_VERSION, DriveKind, Refusal, RobotKind, SettingsSource
from app.link.protocol.messages import JOINTS
from app.link.protocol.settings import GEOMETRY_ID, JOINT_SETTINGS, SETTING_COUNT, SETTINGS, setting_id

_IMAGE = struct.Struct(f"<{SETTING_COUNT}f")
IMAGE_BYTES = _IMAGE.size + 2
_SPEED, _SCALE = SETTINGS["speed"].id, SETTINGS["scale"].id
_MIN, _MAX, _HOME, _OFFSET = (SETTINGS[name].id for name in ("min", "max", "home", "offset"))
_LARGEST, _SMALLEST = 1e6, 1e-9
_ANY = (-_LARGEST, _LARGEST)

_RANGES: dict[str, tuple[float, float]] = {
    "tool_speed": (0.0, 0.25),
    "hold_after": (20.0, 150.0),
    "off_after": (200.0, 5000.0),
    "jump": (0.0, _LARGEST),
    "following": (0.0, _LARGEST),
    "following_time": (0.0, 60_000.0),
    "home_speed": (0.0, 1.0),
    "supply": (0.0, _LARGEST),
    "serial": (0.0, 16_777_215.0),
    "pen_up": (500.0, 2500.0),
    "pen_down": (500.0, 2500.0),
    "stop_time": (10.0, 80.0),
    "duty_max": (0.0, 1.0),
}
_BOARD_RANGES = {setting_id(name): limits for name, limits in _RANGES.items()}
_SERIAL = setting_id("serial")
_MAY_BE_ZERO = {setting_id("following_time"), _SERIAL}


def joints_of(robot: RobotKind) -> int:
    """How many joints a robot has."""
    return 3 if robot in (RobotKind.DELTA3, RobotKind.LINEAR) else 4


class Store:
    """All settings of one board, as floats of 4 bytes."""

    def __init__(self, robot: RobotKind, drive: DriveKind, stored: bytes | None) -> None:
        self.robot, self.drive = robot, drive
        self.built_in = _built_in(robot, drive)
        self.values = list(self.built_in)
        self.source = self._load(stored)
        self.save_requested = False

    def _load(self, stored: bytes | None) -> SettingsSource:
        if stored is None or stored == b"\xff" * IMAGE_BYTES:
            return SettingsSource.BUILT_IN
        if stored[-2:] != self._crc(stored[:-2]):
            return SettingsSource.DAMAGED
        self.values = list(_IMAGE.unpack(stored[:-2]))
        return SettingsSource.STORED

    def image(self) -> bytes:
        """As it goes to permanent memory."""
        content = _IMAGE.pack(*self.values)
        return content + self._crc(content)

    def _crc(self, content: bytes) -> bytes:
        head = bytes([PROTOCOL_VERSION, self.robot, self.drive])
        return binascii.crc_hqx(head + content, 0xFFFF).to_bytes(2, "big")

    def joint(self, k: int, joints: int) -> list[float]:
        """Setting `k` of each joint."""
        return [self.values[JOINT_SETTINGS * j + k] for j in range(joints)]

    def knows(self, id: int) -> bool:
        """Whether this robot has such a setting."""
        joint = id // JOINT_SETTINGS
        return id < SETTING_COUNT and not joints_of(self.robot) <= joint < JOINTS

    def check(self, id: int, value: float) -> Refusal:
        """OK, or why the setting cannot have this value."""
        if not self.knows(id):
            return Refusal.UNKNOWN
        low, high = self._range(id)
        strict = id < GEOMETRY_ID and not self._may_be_zero(id)
        fits = low <= value <= high and not (strict and abs(value) < _SMALLEST)
        if id == _SERIAL:
            fits = fits and value == math.floor(value) and self.values[id] in (0.0, value)
        elif id < JOINTS * JOINT_SETTINGS:
            limit = {_MIN: high, _MAX: low}.get(id % JOINT_SETTINGS)  # the limits have room between them
            fits = fits and value != limit
        return Refusal.OK if fits else Refusal.VALUE

    def _may_be_zero(self, id: int) -> bool:
        if id < JOINTS * JOINT_SETTINGS:
            return id % JOINT_SETTINGS not in (_SPEED, _SCALE)
        return id in _MAY_BE_ZERO

    def _range(self, id: int) -> tuple[float, float]:
        joint, k = divmod(id, JOINT_SETTINGS)
        if joint >= JOINTS:
            return _BOARD_RANGES.get(id, _ANY)
        low, high = (self.values[JOINT_SETTINGS * joint + end] for end in (_MIN, _MAX))
        ranges = {_MIN: (-_LARGEST, high), _MAX: (low, _LARGEST), _HOME: (low, high), _OFFSET: _ANY, _SCALE: _ANY}
        return ranges.get(k, (0.0, _LARGEST))


def _built_in(robot: RobotKind, drive: DriveKind) -> list[float]:
    """Raises a LinkError where no firmware is built for the two."""
    name = next(name for name, kind in BOARD_ROBOTS.items() if kind == robot)
    if (name, drive) not in BUILDS:
        raise LinkError(f"There is no {robot.name} with {drive.name} drives; choose another drive.")
    return list(_IMAGE.unpack(_IMAGE.pack(*settings(name, drive))))
