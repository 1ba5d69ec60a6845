"""The geometry that a board holds: 23 numbers that give its inverse kinematics, and a hash that tells two apart."""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np

from app.link.protocol.codes import RobotKind
from app.link.protocol.settings import GEOMETRY_SIZE
from app.robots import ROBOTS, GeometryError, Robot, build_robot

BOARD_ROBOTS: dict[str, RobotKind] = {
    "par4": RobotKind.PAR4,
    "delta3": RobotKind.DELTA3,
    "linear": RobotKind.LINEAR,
    "fivebar": RobotKind.FIVEBAR,
}
"""By the robot's name."""

_SAME_M = 1e-6
"""Two geometries closer than this are one: a board's floats resolve 0.03 um at 0.4 m, and 30 of them at 314 rad/m."""

_DIGITS = 12
"""Behind the point: the hash must not depend on how a computer rounds a cosine."""


def geometry_values(robot: Robot) -> tuple[float, ...]:
    """(23,) what the board of this robot needs, in the order of PROTOCOL.md; metres and radians."""
    values = [round(value, _DIGITS) for value in _VALUES[BOARD_ROBOTS[robot.name]](robot)]
    return (*values, *(0.0,) * (GEOMETRY_SIZE - len(values)))


def geometry_hash(values: Sequence[float]) -> int:
    """CRC-32 of the 23 values as the board holds them: little endian floats of 4 bytes."""
    return zlib.crc32(struct.pack(f"<{GEOMETRY_SIZE}f", *values))


def robot_from_geometry(kind: RobotKind, values: Sequence[float]) -> Robot | None:
    """The robot that these 23 values describe, None if ours cannot be like that (legs that differ, for example).

    The values fix the kinematics, not every dimension: what they leave open stays as in the nearest preset.
    """
    name = next(name for name, number in BOARD_ROBOTS.items() if number == kind)
    if len(values) != GEOMETRY_SIZE or not all(map(math.isfinite, values)):
        return None
    presets = list(ROBOTS[name].presets.values())
    changed = [{**preset, **_DIMENSIONS[kind](values, build_robot(name, preset).geometry)} for preset in presets]
    robots = (_built(name, dimensions) for dimensions in presets + changed)
    return next((robot for robot in robots if robot is not None and _same(geometry_values(robot), values)), None)


def _built(name: str, dimensions: dict[str, float]) -> Robot | None:
    try:
        return build_robot(name, dimensions)
    except GeometryError:
        return None


def _same(ours: Sequence[float], theirs: Sequence[float]) -> bool:
    return bool(np.allclose(ours, theirs, rtol=_SAME_M, atol=_SAME_M))


def _rotary(arm: float, rod: float, height: float, legs: Sequence[tuple[float, float, float, float]]) -> list[float]:
    """`legs`: azimuth, a_x, a_y, link of each."""
    rows = [(math.cos(a), math.sin(a), a_x, a_y, link) for a, a_x, a_y, link in legs]
    return [arm, rod, height, *(value for row in rows for value in row)]


def _par4(robot: Any) -> list[float]:
    g, platform = robot.geometry, robot.platform
    legs = [
        (a, along - g.R * math.cos(a), across - g.R * math.sin(a), link)
        for a, along, across, link in zip(robot._azimuths, platform.along, platform.across, platform.links, strict=True)
    ]
    return _rotary(g.L, g.l, g.P_z - g.B_z, legs)


def _delta3(robot: Any) -> list[float]:
    g = robot.geometry
    inward = (g.e - g.f) / (2 * math.sqrt(3))
    legs = [(a, inward * math.cos(a), inward * math.sin(a), 0.0) for a in robot._azimuths]
    return _rotary(g.rf, g.re, 0.0, legs)


def _linear(robot: Any) -> list[float]:
    g = robot.geometry
    side, near, far = (g.S_A - g.s_p) / 2, g.W_A - g.w_p, g.U_A - g.u_b
    return [g.l, -side, -near, side, -near, 0.0, far]


def _fivebar(robot: Any) -> list[float]:
    g = robot.geometry
    return [g.l_f / 2, g.l_p, g.l_d, 2 * math.pi / g.p]


def _par4_dimensions(values: Sequence[float], like: Any) -> dict[str, float]:
    arm, rod, height, c, s, a_x, a_y, link = values[:8]
    d = 2 * (a_x + like.R * c - like.d_i)
    return {"L": arm, "l": rod, "P_z": height + like.B_z, "h": link, "d": d, "h_i": a_y + like.R * s}


def _delta3_dimensions(values: Sequence[float], like: Any) -> dict[str, float]:
    inward = values[5] * values[3] + values[6] * values[4]
    return {"rf": values[0], "re": values[1], "f": like.e - 2 * math.sqrt(3) * inward}


def _linear_dimensions(values: Sequence[float], like: Any) -> dict[str, float]:
    rod, _, _, side, near, _, far = values[:7]
    return {"l": rod, "S_A": 2 * side + like.s_p, "W_A": like.w_p - near, "U_A": far + like.u_b}


def _fivebar_dimensions(values: Sequence[float], _: Any) -> dict[str, float]:
    half, arm, rod, turn = values[:4]
    return {"l_f": 2 * half, "l_p": arm, "l_d": rod, "p": 2 * math.pi / turn if turn else 0.0}


_VALUES = {
    RobotKind.PAR4: _par4,
    RobotKind.DELTA3: _delta3,
    RobotKind.LINEAR: _linear,
    RobotKind.FIVEBAR: _fivebar,
}
_DIMENSIONS = {
    RobotKind.PAR4: _par4_dimensions,
    RobotKind.DELTA3: _delta3_dimensions,
    RobotKind.LINEAR: _linear_dimensions,
    RobotKind.FIVEBAR: _fivebar_dimensions,
}
