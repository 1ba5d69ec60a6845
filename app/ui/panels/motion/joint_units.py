"""In which units people read the joints of a robot, and what drives them."""

from __future__ import annotations

from typing import NamedTuple

from app.robots import ROBOTS
from app.robots.robot import EFFORT_UNITS
from app.simulation.run import SHOWN


class JointUnits(NamedTuple):
    """Of one robot."""

    position: str
    factor: float
    """From rad or m."""
    effort_name: str
    effort: str


def joint_units(robot: str) -> JointUnits:
    """Degrees and torques, or millimetres and forces."""
    unit = ROBOTS[robot].build.joint_unit
    return JointUnits(*SHOWN[unit], "torque" if unit == "rad" else "force", EFFORT_UNITS[unit])
