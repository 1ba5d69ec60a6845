"""Which machine belongs to which robot."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from app.robots.parts.delta3 import Delta3Machine
from app.robots.parts.fivebar import FiveBarMachine
from app.robots.parts.linear import LinearMachine
from app.robots.parts.machine import Machine
from app.robots.parts.par4 import Par4Machine
from app.robots.robot import Robot

MACHINES: dict[str, Callable[[Any], Machine]] = {
    "par4": Par4Machine,
    "delta3": Delta3Machine,
    "linear": LinearMachine,
    "fivebar": FiveBarMachine,
}


def machine_of(robot: Robot) -> Machine:
    """The machine of a robot, with that robot's dimensions. It costs less than a millisecond: shapes are built
    when they are first asked for."""
    return MACHINES[robot.name](robot)
