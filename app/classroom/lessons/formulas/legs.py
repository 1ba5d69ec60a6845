"""One leg of a rotary delta: its equation E sin q + F cos q + G = 0, term by term, and both of its solutions."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from app.classroom.lessons.formulas.quantities import pose_of, robot_of, shown
from app.classroom.lessons.formulas.registry import Quantity, formula
from app.robots.rotary_arm import gap, inner_angle, outer_angle_scalar
from app.robots.rotary_delta import RotaryDelta

Table = dict[str, float]
NOTHING: Any = {}

SQUARE_DECIMETRES = 100.0
"""In a square metre."""


@formula("leg_equation")
def leg_equation(robot: str, pose: Table, leg: int, preset: str = "", geometry: Table = NOTHING) -> dict[str, Quantity]:
    """`E`, `F`, `G` (dm^2) of a leg of par4 or delta3, `D` = E^2 + F^2 - G^2 (dm^4), `outer` and `inner` (deg), how far
    the platform joint is from the motor outward `u_r` (mm) and in all `reach` (mm), and by how much the leg is too
    `short` (mm, negative where it is too long)."""
    machine = robot_of(robot, preset, geometry)
    if not isinstance(machine, RotaryDelta):
        raise ValueError("only par4 and delta3 have such legs.")
    if not 1 <= leg <= machine.legs:
        raise ValueError(f"{robot} has legs 1 to {machine.legs}.")
    terms = machine.leg_equations(math, *pose_of(machine, pose))[leg - 1]
    L, rod = machine.arm_m, machine.rod_m
    E, F, G = terms
    lengths = {"u_r": -F / (2 * L), "reach": math.sqrt(max(G + rod * rod - L * L, 0.0)), "short": gap(*terms, rod)}
    angles = {"outer": outer_angle_scalar(*terms), "inner": float(inner_angle(*(np.array(term) for term in terms)))}
    areas = {"E": E, "F": F, "G": G}
    return {
        **{name: Quantity(value * SQUARE_DECIMETRES, "dm^2") for name, value in areas.items()},
        "D": Quantity((E * E + F * F - G * G) * SQUARE_DECIMETRES**2, "dm^4"),
        **{name: shown(value, "m") for name, value in lengths.items()},
        **{name: shown(value, "rad") for name, value in angles.items()},
    }
