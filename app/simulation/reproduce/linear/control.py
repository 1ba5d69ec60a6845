"""The thesis' sections 7 to 12: its model, its laws, and the table of their errors."""

from __future__ import annotations

import math
from functools import cache

from app.control.laws import Tuning
from app.robots.dynamics.inertia import LinearInertia
from app.simulation.closed_loop import simulate
from app.simulation.controlled_run import ControlledRun
from app.simulation.helix import Helix, HelixStart, helix_experiment, helix_tracking
from app.simulation.reproduce.figure import Figure, Section

LAWS = ("PD", "PID", "CTC")
TABLE_5 = {
    "PD": ("1.1061e-05", "0.0022", "0.0111"),
    "PID": ("6.6435e-06", "0.0015", "0.0111"),
    "CTC": ("4.6210e-06", "0.0014", "0.0105"),
}

LIKE_THE_THESIS = Helix(
    "Helix like the thesis'", radius_m=0.01, omega_rad_s=0.5, z0_m=-0.39, rise_m_s=-0.01, duration_s=2.5
)
BANDWIDTH_RAD_S = 25.0
"""With these, CTC comes near its row of Table 5."""


def dynamics() -> list[Figure]:
    """Section 7."""
    section, m = Section("7 Dynamics"), LinearInertia()
    masses = "The thesis prints none. Declared: what such a machine weighs."
    half = "Right for gravity and vertical motion; 1/4 suits lateral motion. Rods with inertia are our default."
    return [
        section.wrong("(28): which mass is which", "", "m_p slider", "platform", "The words swap m_p and m_s."),
        section.wrong("(30), (33): forces", "", "f", "f^T", "A force is a column; work is f^T times a displacement."),
        section.open("m_p, platform", "kg", m.platform_mass, masses),
        section.open("m_s, carriage", "kg", m.carriage_mass, "Declared."),
        section.open("m_l, one rod", "kg", m.rod_mass, "Declared."),
        section.open("w, share of the rods at the platform", "", 0.5, half),
    ]


def laws() -> list[Figure]:
    """Sections 9 to 11."""
    section = Section("9 to 11 Laws of control")
    plant = "What the plant does is M qdd + H; with it (47) follows."
    return [
        section.wrong("(46): plant", "", "M qdd_d + H", "M qdd + H", plant),
        section.wrong("(51): what remains", "", "qdd_d, qd, q", "edd, ed, e", "From (48) and (49)."),
        section.wrong("CTC: M is taken at", "", "q_d - q", "q", "At where the robot is, not at its error."),
        section.open("gains K_p, K_v, K_i, k_p, k_d", "", "ours", "The thesis prints none: see Table 5."),
    ]


def helix() -> list[Figure]:
    """(27) and what the figures show."""
    section = Section("6.7 and 12 Helix")
    swapped = (
        "Section 12 says that y starts at 1 since cos(0) = 1, and its error along x is far smaller: the simulation had "
        "x = r sin, y = r cos."
    )
    start = (
        "The robot starts at its upper stops, z = -0.3164 m, the helix elsewhere: this first offset makes e_y and e_z, "
        "and hides what the laws do."
    )
    return [
        section.wrong("(27): x, y", "", "cos, sin", "sin, cos", swapped),
        section.open("start", "", "home", start),
        section.open(
            "r, omega, z_0, v", "", "ours", "10 mm, 0.5 rad/s, -0.39 m, -10 mm/s for 2.5 s come near Table 5."
        ),
    ]


def table_5() -> list[Figure]:
    """Its rows beside ours for a bandwidth of 25 rad/s, and what of its ranking holds."""
    section = Section("Table 5")
    figures = []
    for law, row in TABLE_5.items():
        for axis, printed, ours in zip("xyz", row, _from_home(law).rms, strict=True):
            figures.append(section.unsettled(f"{law}, e_{axis}", "m", printed, float(ours)))
    figures[0] = section.unsettled(
        "PD, e_x", "m", TABLE_5["PD"][0], float(_from_home("PD").rms[0]),
        "Masses, gains and helix are not printed. Ours: the helix above, all laws with 25 rad/s.",
    )  # fmt: skip
    return [*figures, *_claims(section)]


def after_the_start() -> list[Figure]:
    """Once the first offset has died away: what the laws themselves do (from 1 s on)."""
    section = Section("Table 5 without its start: RMSE from 1 s on, helix of 80 mm at 1 Hz")
    figures = []
    for law in ("PD", "PID", "PD+", "PDff", "CTC", "CTC+DOB", "MPC"):
        ideal, rough = (helix_tracking(law, "T2", friction).rmse_after_1s_mm for friction in (False, True))
        figures.append(section.beyond(f"{law}, x", "mm", float(ideal[0])))
        figures.append(section.beyond(f"{law}, x, with friction", "mm", float(rough[0])))
    return figures


def _claims(section: Section) -> list[Figure]:
    """What the text concludes."""
    late = {law: _helix(law, "reference").rmse_after_1s_mm for law in LAWS}
    ranked = all(late["CTC"][k] < late["PID"][k] < late["PD"][k] for k in (0, 1))
    sag = 1e-3 * float(late["PD"][2])
    whole = {law: float(_helix(law, "axis").rms[1]) for law in LAWS}
    by_start = " < ".join(sorted(whole, key=whole.__getitem__))
    home = [1e3 * float(_helix(law, "home").rms[2]) for law in LAWS]
    return [
        section.claim(
            "after the start, x and y", "CTC<PID<PD", "CTC<PID<PD" if ranked else "otherwise", ranked,
            "At equal bandwidth (60 rad/s) on a helix of 10 mm; with friction, too.",
        ),
        section.claim(
            "PD leaves a steady error", "yes", "yes" if sag > 1e-3 else "no", sag > 1e-3,
            f"{1e3 * sag:.1f} mm down: weight over K_p. PID and CTC have none.",
        ),
        section.beyond("e_y over the whole run", "", by_start, "Started on the axis, the first offset decides."),
        section.beyond(
            "e_z from home, PD, PID, CTC", "mm", ", ".join(f"{error:.1f}" for error in home),
            "Nearly equal, as in Table 5: this column says nothing about the laws.",
        ),
    ]  # fmt: skip


@cache
def _helix(law: str, start: HelixStart) -> ControlledRun:
    return helix_tracking(law, "T1", start=start)


@cache
def _from_home(law: str) -> ControlledRun:
    tuning = Tuning.equal("linear", law, BANDWIDTH_RAD_S / math.tau)
    return simulate(helix_experiment(law, LIKE_THE_THESIS, start="home", tuning=tuning).changed(model={}))
