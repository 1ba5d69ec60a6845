"""Righettini et al. 2024: the 5R pick-and-place robot, its model, its work cycle, and four laws of control."""

from __future__ import annotations

from app.simulation.reproduce.fivebar import control, machine
from app.simulation.reproduce.paper import Paper

FIVEBAR = Paper(
    "fivebar: Righettini et al. 2024, Robotics 13, 54 (doi 10.3390/robotics13030054)",
    (
        machine.equations,
        machine.table_1,
        machine.table_2,
        control.cycle,
        control.tuning,
        control.errors,
        control.torques,
    ),
)
