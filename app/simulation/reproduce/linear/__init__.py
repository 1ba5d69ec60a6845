"""Ashraf 2022: the linear delta, its kinematics, its dynamics, and three laws of control on a helix."""

from __future__ import annotations

from app.simulation.reproduce.linear import control, kinematics
from app.simulation.reproduce.paper import Paper

LINEAR = Paper(
    "linear: Ashraf 2022, bachelor thesis, German University in Cairo",
    (
        kinematics.mobility,
        kinematics.table_1,
        kinematics.table_2,
        kinematics.table_3,
        kinematics.table_3_with_its_slip,
        kinematics.table_4,
        control.helix,
        control.dynamics,
        control.laws,
        control.table_5,
        control.after_the_start,
    ),
)
