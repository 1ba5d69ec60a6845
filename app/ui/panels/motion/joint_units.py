"""In which units people read the joints of a robot, and what drives them."""

from __future__ import annotations

import math
from typing import NamedTuple

from app.robots import ROBOTS


class JointUnits(NamedTuple):
    """Of one robot."""

    position: str
    factor: float
    """From rad or m."""
    effort_name: str
    effort: str


def joint_units(robot: str) -> JointUnits:
    """Degrees and torques, or millimetres and forces."""
    if ROBOTS[robot].build.joint_unit == "rad":
        return JointUnits("deg", math.degrees(1.0), "torque", "N m")
    return JointUnits("mm", 1e3, "force", "N")
