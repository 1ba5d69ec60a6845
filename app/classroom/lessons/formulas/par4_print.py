"""What the Par4's paper would compute with its equation (18) as printed: one sign of F_3 is wrong."""

from __future__ import annotations

import math

from app.classroom.lessons.formulas.legs import SQUARE_DECIMETRES
from app.classroom.lessons.formulas.quantities import pose_of, robot_of, shown
from app.classroom.lessons.formulas.registry import Quantity, formula
from app.robots.par4 import ARM_AZIMUTHS, Par4
from app.robots.rotary_arm import outer_angle_scalar


@formula("par4_printed")
def par4_printed(pose: dict[str, float]) -> dict[str, Quantity]:
    """With F_3 as printed: `F` and `F_right` (dm^2), `q3` and `q3_right` (deg), their difference `error` (deg), and the
    distance `rod` (mm) that rod 3 would have to span at the wrong angle."""
    machine = robot_of("par4")
    assert isinstance(machine, Par4)
    E, F, G = machine.leg_equations(math, *pose_of(machine, pose))[2]
    L, rod = machine.arm_m, machine.rod_m
    printed = F - 4.0 * L * machine.geometry.d_i * math.cos(ARM_AZIMUTHS[2])
    wrong, right = outer_angle_scalar(E, printed, G), outer_angle_scalar(E, F, G)
    squared = E * math.sin(wrong) + F * math.cos(wrong) + G + rod * rod
    return {
        "F": Quantity(printed * SQUARE_DECIMETRES, "dm^2"),
        "F_right": Quantity(F * SQUARE_DECIMETRES, "dm^2"),
        "q3": shown(wrong, "rad"),
        "q3_right": shown(right, "rad"),
        "error": shown(wrong - right, "rad"),
        "rod": shown(math.sqrt(squared), "m"),
    }
