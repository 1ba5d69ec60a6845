"""The built-in settings of every firmware, as C initialisers: `python -m app.link.firmware.generate`.

They come from `app.robots` and `app.control.DRIVES`, so that a board and the page mean the same robot.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.control import PID_AUTO, Pid
from app.control.drives import DRIVES
from app.link.board_geometry import BOARD_ROBOTS, geometry_values
from app.link.protocol.codes import DriveKind
from app.link.protocol.settings import GEOMETRY_ID, SETTING_COUNT, setting_id
from app.robots import Robot, make_robot

ROBOTS_H = Path(__file__).parent / "deltalab/src/core/robots.h"

BUILDS: tuple[tuple[str, DriveKind], ...] = (
    ("par4", DriveKind.DC),
    ("par4", DriveKind.SERVO),
    ("delta3", DriveKind.SERVO),
    ("delta3", DriveKind.DC),
    ("linear", DriveKind.STEPPER),
    ("linear", DriveKind.DC),
    ("fivebar", DriveKind.DC),
)
"""Every robot with each drive that it is built with, the usual one first."""

ON_UNO = BUILDS[2:5]
"""What an Arduino Uno is used for; its memory does not hold the others."""

SPEED_SHARE = 0.8
"""Of the speed that a DC motor reaches on its full supply: the rest is for the controller."""

SERVO_SPEED = 4.0
"""rad/s; hobby servos are sold as 60 degrees in 0.12 to 0.2 s."""

STEPS_A_METRE = 40_000.0
"""A belt of 40 mm a turn, 1600 micro-steps."""

STEPPER_SPEED = 0.18
"""m/s, 7200 steps a second: what a small board can step."""

RAW_USED = 0.9
"""Of a potentiometer's range by a joint's: both ends mean a broken wire."""

TEN_TURNS = 20 * math.pi
"""Travel of the potentiometers of the 5R robot's screw and spline, rad."""


@dataclass(frozen=True)
class Axis:
    """The settings of one joint."""

    pid: Pid
    speed: float
    middle: float
    """Joint value at which the raw value is `raw_middle`."""
    raw_middle: float
    scale: float


GAINS: dict[str, Pid] = {
    "par4": Pid(*map(math.degrees, (PID_AUTO.kp, PID_AUTO.ki, PID_AUTO.kd)), n=PID_AUTO.n),
    "delta3": Pid(46.0, 60.0, 1.0, 200.0),
    "linear": Pid(1200.0, 1500.0, 20.0, 200.0),
    "fivebar": Pid(250.0, 500.0, 2.0, 300.0),
}
"""Of the DC drives, in V per rad or m: the paper's own for the Par4, the others so that the loop's crossover lies
near 25 rad/s (fivebar: 38) with more than 50 degrees of phase margin at the board's period."""


def settings(robot_name: str, drive: DriveKind) -> list[float]:
    """The 76 numbers that a board begins with, by id."""
    robot = make_robot(robot_name)
    values = [0.0] * SETTING_COUNT
    joints = zip(robot.joint_limits.tolist(), robot.inverse(robot.home).tolist(), strict=True)
    for joint, ((low, high), home) in enumerate(joints):
        for name, value in _joint(robot, drive, joint, low, high, home).items():
            values[setting_id(name, joint)] = value
    for name, value in _board(robot_name, drive).items():
        values[setting_id(name)] = value
    values[GEOMETRY_ID:] = geometry_values(robot)
    return values


def _joint(robot: Robot, drive: DriveKind, joint: int, low: float, high: float, home: float) -> dict[str, float]:
    axis = _axis(robot, drive, joint, low, high)
    return {
        "kp": axis.pid.kp,
        "ki": axis.pid.ki,
        "kd": axis.pid.kd,
        "n": axis.pid.n if math.isfinite(axis.pid.n) else 0.0,
        "min": low,
        "max": high,
        "speed": axis.speed,
        "offset": axis.middle - axis.scale * axis.raw_middle,
        "scale": axis.scale,
        "home": home,
    }


def _axis(robot: Robot, drive: DriveKind, joint: int, low: float, high: float) -> Axis:
    if drive == DriveKind.SERVO:
        return Axis(Pid(0.0, n=0.0), SERVO_SPEED, 0.0, 1500.0, math.pi / 2 / 1000.0)
    if drive == DriveKind.STEPPER:
        return Axis(Pid(0.0, n=0.0), STEPPER_SPEED, 0.0, 0.0, 1.0 / STEPS_A_METRE)
    unit = 1e-3 if robot.joint_unit == "m" else math.pi / 180
    bought = DRIVES[robot.name]
    travel = TEN_TURNS if robot.name == "fivebar" and joint >= 2 else bought.sensor_range * unit
    speed = SPEED_SHARE * bought.supply_v * bought.motor.K / bought.motor.T1 * unit
    return Axis(GAINS[robot.name], speed, (low + high) / 2, 0.5, max(travel, (high - low) / RAW_USED))


def _board(robot_name: str, drive: DriveKind) -> dict[str, float]:
    linear = robot_name == "linear"
    return {
        "tool_speed": 0.25,
        "hold_after": 100.0,
        "off_after": 500.0,
        "jump": 0.2,
        "following": 0.05 if linear else 0.3 if robot_name == "fivebar" else 0.2,
        "following_time": 300.0,
        "home_speed": 0.3,
        "supply": DRIVES[robot_name].supply_v if drive == DriveKind.DC else 6.0 if drive == DriveKind.SERVO else 24.0,
        "pen_up": 1300.0,
        "pen_down": 1700.0,
        "stop_time": 50.0,
        "duty_max": 1.0,
    }


def robots_h() -> str:
    """The text of `robots.h`."""
    lines = [
        "/* Built-in settings, by id. Generated by app/link/firmware/generate.py: change that, not this. */",
        "#ifndef DL_ROBOTS_H",
        "#define DL_ROBOTS_H",
        "",
        '#include "codes.h"',
        '#include "settings.h"',
        "",
        "#ifdef __AVR__",
        "#include <avr/pgmspace.h>",
        "#else",
        "#define PROGMEM",
        "#endif",
        "",
        "static const struct {",
        "    uint8_t key[2]; /* robot and drive */",
        "    float settings[DL_SETTINGS];",
        "} DL_BUILT_IN[] PROGMEM = {",
        *(line for build in ON_UNO for line in _entry(*build)),
        "#ifndef __AVR__",
        *(line for build in BUILDS if build not in ON_UNO for line in _entry(*build)),
        "#endif",
        "};",
        "",
        "#endif",
    ]
    return "\n".join(lines) + "\n"


def _entry(robot_name: str, drive: DriveKind) -> Iterator[str]:
    yield f"    {{{{DL_ROBOT_{BOARD_ROBOTS[robot_name].name}, DL_DRIVE_{drive.name}}}, {{"
    numbers = [_float(value) for value in settings(robot_name, drive)]
    for first in range(0, len(numbers), 6):
        yield "        " + ", ".join(numbers[first : first + 6]) + ","
    yield "    }},"


def _float(value: float) -> str:
    """Nine digits give back every float of 4 bytes; rounding twice would not."""
    text = f"{float(np.float32(value)):.9g}"
    return f"{text}f" if "." in text or "e" in text else f"{text}.0f"


if __name__ == "__main__":
    ROBOTS_H.write_text(robots_h())
