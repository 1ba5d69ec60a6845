"""The 5R paper's sections 2.3 and 3: its work cycle, and which law did better at what. Its figures are lost."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np

from app.control.laws import Tuning
from app.motion import CYCLES, plan_work_cycle
from app.simulation.controlled_run import ControlledRun
from app.simulation.reproduce.figure import Figure, Section
from app.simulation.work_cycle import ON_BELTS_S, work_cycle

LAWS = ("PD", "PID", "TSIDC", "TSIIDC")


def cycle() -> list[Figure]:
    """Section 2.3."""
    section, motion = Section("2.3 Work cycle"), plan_work_cycle(CYCLES["W1"])
    speed = float(np.linalg.norm(motion.rate[:, :2], axis=1).max())
    acceleration = float(np.linalg.norm(motion.acceleration[:, :2], axis=1).max())
    found = "Waypoints, belts and strokes are not printed; ours were chosen so that these three numbers come out."
    return [
        section.compared("duration", "s", "2.46", motion.trajectory.duration_s, found),
        section.compared("peak speed", "m/s", "1.16", speed),
        section.compared("peak acceleration", "m/s2", "11.3", acceleration),
        section.open("belts", "", "ours", "At x = -+159 mm, 0.15 m/s, one towards +y, the other towards -y."),
        section.open("stroke", "mm", "5 or 25", "5 mm respect every limit (W1); 25 mm saturate axis 3 (W2)."),
    ]


def tuning() -> list[Figure]:
    """Section 3: poles, and what follows from them."""
    section = Section("3 Tuning")
    kp, kd, _ = Tuning.default("fivebar", "TSIDC").gains()
    return [
        section.given("sampling frequency", "kHz", "4"),
        section.given("in the plane: poles, damping", "Hz", "30, 0.7"),
        section.given("z and phi: poles, damping", "Hz", "28, 0.6"),
        section.beyond("K_p in the plane", "1/s2", kp[0]),
        section.beyond("K_d in the plane", "1/s", kd[0]),
        section.beyond("K_p of z and phi", "1/s2", kp[2]),
        section.beyond("K_d of z and phi", "1/s", kd[2]),
        section.open("K_i, and its bounds", "", "ours", "25 K_p; the sum of errors stops at a bound on each axis."),
        section.open("gains of PD and PID", "", "ours", "Equal bandwidth: mean joint inertia times the same poles."),
        section.open("friction", "", "ours", "Arms 8 N m and 2 N m s, nuts 3 N m and 0.1 N m s, in the plant only."),
    ]


def errors() -> list[Figure]:
    """What Figure 13 is said to show, in our cycle with a stroke of 25 mm."""
    section = Section("3 Errors (Figure 13), as the text tells them")
    peak, rms = ({law: getattr(_run(law), kind) for law in LAWS} for kind in ("peak", "rms"))
    central = all(peak["TSIDC"][k] < peak["PD"][k] and peak["TSIIDC"][k] < peak["PID"][k] for k in (0, 1))
    integral_x = max(rms["PID"][0], rms["TSIIDC"][0]) < min(rms["PD"][0], rms["TSIDC"][0])
    centralised_y = max(rms["TSIDC"][1], rms["TSIIDC"][1]) < min(rms["PD"][1], rms["PID"][1])
    phi = rms["PD"][3] > rms["TSIDC"][3] > max(rms["PID"][3], rms["TSIIDC"][3])
    on_belt = {law: _run(law).rms_within(ON_BELTS_S)[2] for law in LAWS}
    z_note = f"RMS, mm: {1e3 * on_belt['PD']:.3f} and {1e3 * on_belt['TSIDC']:.3f}."
    y_note = (
        f"Ours, mm: {_row(rms, 1)}. On the belts dry friction makes the error, and only the integral laws take it "
        "away. The robot's friction is not printed; another one may rank them otherwise."
    )
    return [
        _claim(section, "peak x and y: less with model", central, f"Peak x, mm: {_row(peak, 0)}."),
        _claim(section, "RMS x: less with integral", integral_x, f"Ours, mm: {_row(rms, 0)}."),
        _claim(section, "RMS y: least with model", centralised_y, y_note),
        _claim(section, "RMS phi: PD, TSIDC, then the others", phi, f"Ours, mrad: {_row(rms, 3)}."),
        _claim(section, "z on the belts: PD worse than TSIDC", on_belt["PD"] > on_belt["TSIDC"], z_note),
        *_equal_bandwidth(section),
    ]


def torques() -> list[Figure]:
    """Figures 14 to 20."""
    section = Section("3 Torques (Figures 14 to 20), as the text tells them")
    shares = {law: _run(law).shares for law in LAWS}
    order = ("PD", "TSIDC", "PID", "TSIIDC")
    falling = all(shares[a]["p"][0] > shares[b]["p"][0] for a, b in pairwise(order))
    small = max(float(shares[law]["n"].max()) for law in ("TSIDC", "TSIIDC")) < 0.1
    integral = abs(float(shares["PID"]["i"][3] - shares["TSIIDC"]["i"][3])) < 0.25
    third = float(_run("TSIIDC").saturation[2])
    arms, limit = max(map(_arm_torque, map(_run, LAWS))), float(_run("PD").effort_limit[0])
    rough = _arm_torque(work_cycle("PD", "W2", friction=2.0))
    why = (
        f"The masses of Table 1, 11.3 m/s2 and our friction take {arms:.0f} of {limit:.0f} N m; twice the friction"
        f" {rough:.0f}. The paper does not print what else its robot needs them for."
    )
    first = ", ".join(f"{law} {100 * float(shares[law]['p'][0]):.0f}" for law in order)
    return [
        _claim(section, "share of p falls: PD, TSIDC, PID, TSIIDC", falling, f"Axis 1, %: {first}."),
        _claim(section, "share of n is small", small, "Below 10 %; next to 0 on axes 3 and 4."),
        _claim(section, "axis 4: integral weighs alike", integral, "In PID and TSIIDC."),
        _claim(section, "axis 3 saturates on the belts", third > 0.01, f"{100 * third:.0f} % of the time in W2."),
        _claim(section, "axes 1 and 2 saturate", arms >= limit, why),
    ]


def _arm_torque(run: ControlledRun) -> float:
    """Largest of axes 1 and 2, N m."""
    return float(run.torque_peak[:2].max())


def _equal_bandwidth(section: Section) -> list[Figure]:
    """The ranking holds at equal bandwidth only."""
    quick = work_cycle("PD", "W2", tuning=Tuning.equal("fivebar", "PD", 45.0))
    note = "Better than the TSIDC of 30 Hz: a ranking of laws means something at equal bandwidth only."
    return [
        section.beyond("RMS x of a PD at 45 Hz", "mm", 1e3 * float(quick.rms[0]), note),
        section.beyond("RMS x of the TSIDC at 30 Hz", "mm", 1e3 * float(_run("TSIDC").rms[0])),
    ]


def _row(table: dict[str, np.ndarray], axis: int) -> str:
    return ", ".join(f"{law} {1e3 * float(values[axis]):.3f}" for law, values in table.items())


def _claim(section: Section, name: str, holds: bool | np.bool_, note: str) -> Figure:
    return section.claim(name, "yes", "yes" if holds else "no", bool(holds), note)


@cache
def _run(law: str) -> ControlledRun:
    return work_cycle(law, "W2")
