"""What the paper tells of machines: other makers' and its own. Mostly data."""

from __future__ import annotations

import math

import numpy as np

from app.robots.par4 import ARM_AZIMUTHS, Par4, Par4Geometry
from app.simulation.reproduce.figure import Figure, Section


def introduction() -> list[Figure]:
    """Section 1."""
    section, turn = Section("1 Introduction"), math.degrees(Par4Geometry().theta_max)
    return [
        section.given("platform turns by +-", "deg", "45"),
        section.compared("tool turns by +-, 1:4 belt", "deg", "180", 4.0 * turn),
        section.given("Quattro: tool turns by +-", "deg", "46.25, 92.5, 185"),
        section.given("Quattro: diameter x height", "mm", "1300x500, 1600x500"),
        section.given("Quattro: repeatability +-", "mm", "0.10, 0.15"),
        section.given("Quattro: largest load", "kg", "4, 6"),
    ]


def solid_model() -> list[Figure]:
    """Section 2."""
    section, robot = Section("2 Solid model"), Par4(Par4Geometry())
    rank = np.linalg.matrix_rank(robot.jacobian(robot.home))
    return [
        section.compared("degrees of freedom", "", "4", float(rank), "Rank of the Jacobian at home."),
        section.compared("angle between the arms", "deg", "90", math.degrees(np.ptp(ARM_AZIMUTHS)) / 3.0),
        section.compared("tool turns by +-, 1:2 belt", "deg", "90", 2.0 * math.degrees(robot.rotation_limit)),
        section.given("gear ratio", "", "264"),
    ]


def control_system() -> list[Figure]:
    """Section 4.1."""
    section = Section("4.1 Control system")
    return [
        section.given("motor: torque", "N m", "4.9"),
        section.given("motor: at a voltage of", "V", "24", "The model of 4.3 was identified on half of that."),
        section.given("amplifier: voltage", "V", "5.5 .. 24"),
        section.given("amplifier: current, short peaks", "A", "12, 30"),
        section.given("potentiometer", "kohm", "10"),
        section.given("potentiometer: linearity", "%", "1"),
    ]


def programs() -> list[Figure]:
    """Section 4.6."""
    section = Section("4.6 Programs")
    return [
        section.given("sample time", "s", "0.01"),
        section.given("pulse width +-", "%", "100", "Also the limit that Table 4 was simulated with: see 4.5."),
    ]
