"""Emulated boards by name: `sim:par4?noise=0.01&stuck_joint=2`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any
from urllib.parse import parse_qsl

from app.link.board_geometry import BOARD_ROBOTS
from app.link.emulated.board import EmulatedBoard
from app.link.emulated.faults import Faults
from app.link.errors import LinkError
from app.link.protocol.codes import DriveKind
from app.robots import make_robot

SIM = "sim:"
"""How the port of an emulated board begins."""


def board_of(port: str) -> EmulatedBoard:
    """A new board as its port's name describes it.

    Raises:
        LinkError: if the name or an option makes no sense.
    """
    name, _, query = port.removeprefix(SIM).partition("?")
    if name not in BOARD_ROBOTS:
        robots = ", ".join(SIM + robot for robot in BOARD_ROBOTS)
        raise LinkError(f"There is no emulated board {port!r}; choose one of {robots}.")
    joints = len(make_robot(name).joint_names)
    faults: dict[str, Any] = {}
    build: dict[str, Any] = {}
    for key, text in parse_qsl(query, keep_blank_values=True):
        if key in _FAULTS:
            field, read = _FAULTS[key]
            faults[field] = read(key, text, joints)
        elif key in _BUILD:
            field, read = _BUILD[key]
            build[field] = read(key, text, joints)
        else:
            raise LinkError(f"An emulated board has no option {key!r}; it has {', '.join([*_BUILD, *_FAULTS])}.")
    return EmulatedBoard(name, faults=Faults(**faults), **build)


def _share(key: str, text: str, _: int) -> float:
    return _number(key, text, 1.0, "between 0 and 1")


def _delay_s(key: str, text: str, _: int) -> float:
    return 1e-3 * _number(key, text, 5000.0, "in milliseconds, up to 5000")


def _number(key: str, text: str, largest: float, what: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 <= value <= largest:
        raise LinkError(f"{key}={text} makes no sense; give a number {what}.")
    return value


def _joint(key: str, text: str, joints: int) -> int:
    """From 1, as people count."""
    if text not in map(str, range(1, joints + 1)):
        raise LinkError(f"{key}={text} makes no sense; give the number of a joint, 1 to {joints}.")
    return int(text) - 1


def _switch(key: str, text: str, _: int) -> bool:
    return bool(_choice({"0": 0, "1": 1}, key, text))


def _drive(key: str, text: str, _: int) -> DriveKind:
    return _choice({kind.name.lower(): kind for kind in DriveKind}, key, text)


def _core(key: str, text: str, _: int) -> str:
    return _choice({"compiled": "compiled", "twin": "twin"}, key, text)


def _serial(key: str, text: str, _: int) -> int:
    return int(_number(key, text, 16_777_215.0, "up to 16777215"))


def _misaligned(key: str, text: str, joints: int) -> tuple[float, ...]:
    """rad or m, one a joint."""
    try:
        values = tuple(map(float, text.split(",")))
    except ValueError:
        values = ()
    if len(values) != joints or not all(abs(value) <= 0.2 for value in values):
        raise LinkError(f"{key}={text} makes no sense; give {joints} numbers with commas, each at most 0.2 (rad or m).")
    return values


def _choice(choices: Mapping[str, Any], key: str, text: str) -> Any:
    if text not in choices:
        raise LinkError(f"{key}={text} makes no sense; choose one of {', '.join(choices)}.")
    return choices[text]


_Option = tuple[str, Callable[[str, str, int], Any]]
"""Keyword that it sets, and how its text is read."""

_BUILD: dict[str, _Option] = {
    "drive": ("drive", _drive),
    "core": ("core", _core),
    "boot_ms": ("boot_s", _delay_s),
    "serial": ("serial", _serial),
    "misaligned": ("misaligned", _misaligned),
}
_FAULTS: dict[str, _Option] = {
    "noise": ("noise", _share),
    "loss": ("loss", _share),
    "delay_ms": ("delay_s", _delay_s),
    "stuck_joint": ("stuck_joint", _joint),
    "limit_switch": ("limit_switch", _joint),
    "sensor_broken": ("sensor_broken", _joint),
    "estop": ("estop", _switch),
    "unplugged": ("unplugged", _switch),
}
