"""Whether the robot in the picture is the one on the table."""

from __future__ import annotations

import numpy as np

from app.link.board_geometry import geometry_values
from app.robots import Robot

SAME_M = 1e-6
"""Of the numbers that give a board its kinematics; the board has them as floats of 4 bytes."""


def moves_alike(one: Robot, other: Robot) -> bool:
    """Two robots of one kind, whose joints mean the same pose."""
    if one.name != other.name:
        return False
    return bool(np.allclose(geometry_values(one), geometry_values(other), rtol=SAME_M, atol=SAME_M))
