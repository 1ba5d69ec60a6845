"""Laski & Smykowski 2021: the Par4 delta, its motor, two tunings of its controllers, and a circle."""

from __future__ import annotations

from app.simulation.reproduce.paper import Paper
from app.simulation.reproduce.par4 import circle, control, kinematics, machine

PAR4 = Paper(
    "Par4: Laski & Smykowski 2021, Sensors 21, 7962 (doi 10.3390/s21237962)",
    (
        machine.introduction,
        machine.solid_model,
        kinematics.equations,
        kinematics.table_1,
        kinematics.operating_space,
        machine.control_system,
        control.identification,
        control.table_2,
        control.table_3,
        circle.experiment,
        circle.table_4,
        machine.programs,
        circle.without_the_step,
    ),
)
