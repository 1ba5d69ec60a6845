"""The 5R paper's section 2.1 and its two tables: the model, its data, and where they do not fit together."""

from __future__ import annotations

import math

from app.robots.dynamics.inertia import FiveBarInertia
from app.robots.fivebar import FiveBarGeometry
from app.simulation.reproduce.figure import Figure, Section

GEOMETRY = FiveBarGeometry()
INERTIA = FiveBarInertia()

RATIOS = (64.0, 40.0)
"""i_t of the arms' and of the nuts' axes."""
PEAK_MOTOR_TORQUE = (1.4, 0.72)
MOTOR_SPEED = 500.0


def equations() -> list[Figure]:
    """(1) to (12)."""
    section = Section("2.1 Model")
    twice = "Axis 3 has a ratio of its own. It is the same number, so nothing changes."
    return [
        section.wrong("(3): ratio of the third axis", "", "i_t2", "i_t3", twice),
        section.open("l_f", "", "full", "The frame length is taken as the distance of the two motor axes."),
        section.open("centres of mass", "", "mid-link", "At 0.4 of the link the peak torque is 5 % lower."),
        section.beyond("(3): M_act of the arms", "kg m2", INERTIA.arm_drive),
        section.beyond("(3): M_act of the nuts", "kg m2", INERTIA.nut_drive),
    ]


def table_1() -> list[Figure]:
    """Dimensions and masses."""
    section, g, m = Section("Table 1"), GEOMETRY, INERTIA
    gyration = math.sqrt(m.distal_inertia / m.distal_mass)
    odd = (
        f"About the centre this makes a radius of gyration of {1e3 * gyration:.0f} mm, more than half of the link; "
        f"a uniform bar of {1e3 * g.l_d:.0f} mm has {m.distal_mass * g.l_d**2 / 12:.4f} kg m2. Taken as printed."
    )
    return [
        section.given("l_p", "mm", "250", computed=1e3 * g.l_p),
        section.given("l_d", "mm", "250", computed=1e3 * g.l_d),
        section.given("l_f", "mm", "180", computed=1e3 * g.l_f),
        section.given("m_p", "kg", "2.9", computed=m.proximal_mass),
        section.given("m_d", "kg", "2.9", computed=m.distal_mass),
        section.given("J_p", "kg m2", "5.22e-2", odd, m.proximal_inertia),
        section.given("J_d", "kg m2", "5.22e-2", computed=m.distal_inertia),
        section.given("m_ee", "kg", "0.36", computed=m.tool_mass),
        section.given("p_bss", "mm", "20", computed=1e3 * g.p),
        section.given("J_ee", "kg m2", "6.40e-6", computed=m.tool_inertia),
        section.given("J_3, J_4", "kg m2", "1.20e-6", computed=m.nut_inertia),
    ]


def table_2() -> list[Figure]:
    """The servo axes, and what they give at the joints."""
    section = Section("Table 2")
    speeds = [MOTOR_SPEED / ratio for ratio in RATIOS]
    lift = GEOMETRY.p / math.tau * speeds[1]
    needed = 1.875 * 0.025 / 0.26  # peak speed of a quintic
    slow = (
        f"With phi at rest this lifts the screw at {1e3 * lift:.0f} mm/s at most; a stroke of 25 mm in 0.26 s needs"
        f" {needed / lift:.1f} times that."
    )
    torques = [ratio * torque for ratio, torque in zip(RATIOS, PEAK_MOTOR_TORQUE, strict=True)]
    return [
        section.given("rated torque, motors", "N m", "0.7, 0.36"),
        section.given("peak torque, motors", "N m", "1.4, 0.72"),
        section.given("peak speed, motors", "rad/s", "500"),
        section.given("J_m", "kg mm2", "17, 2.4"),
        section.given("J_t", "kg mm2", "24.85, 20.5"),
        section.given("i_t", "", "64, 40"),
        section.beyond("peak torque of an arm", "N m", torques[0]),
        section.beyond("peak torque of a nut", "N m", torques[1]),
        section.beyond("peak speed of an arm", "rad/s", speeds[0]),
        section.beyond("peak speed of a nut", "rad/s", speeds[1], slow),
    ]
