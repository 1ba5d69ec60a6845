"""The Par4 paper's section 4.5: four drives carry the tool around a circle, and Table 4 sums up their errors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.control import PAR4_MOTOR, PID_APPROX, PID_AUTO, Pid
from app.control.drives import DRIVES
from app.motion import Tour
from app.robots import make_robot
from app.robots.par4 import Par4Geometry
from app.simulation import simulink_loop
from app.simulation.circle import circle_tracking
from app.simulation.reproduce.figure import Figure, Section
from app.simulation.reproduce.par4.equations import arm_angles
from app.simulation.reproduce.par4.fit import PIDS, TABLE_4, Settings, Tuning, fit, indices
from app.simulation.tracking import Start, Task, sample_times

DRIVE_NAMES = ("I", "II", "III", "IV")
STEP_S = 0.01
SUPPLY_V = DRIVES["par4"].supply_v


def experiment() -> list[Figure]:
    """The circle, and what else the simulation needs to know."""
    section = Section("4.5 Circle")
    x, y, z = (1e3 * make_robot("par4").home[:3]).tolist()
    middle = "-h / 2: the tool point is the middle of one bar, so this puts the platform on the robot's axis."
    return [
        section.given("centre, x", "mm", "0", computed=x),
        section.compared("centre, y", "mm", "-36", y, middle),
        section.given("centre, z", "mm", "-300", computed=z),
        section.given("radius", "mm", "100"),
        section.given("theta", "deg", "0"),
        section.given("duration", "s", "100"),
        section.given("step", "s", "0.01"),
        *_found(section),
    ]


def _found(section: Section) -> list[Figure]:
    """What is not printed; each was found by Table 4."""
    lap, limit = fit("lap_s", 1.0), fit("u_max", 1.0)
    by_volts = ", ".join(f"{ise:.0f}" for ise in indices(Settings(u_max=SUPPLY_V))["auto"])
    percent = (
        f"Table 4 asks for {limit.value:.2f} +- {limit.either_way:.2f}: the pulse width in per cent, although the model"
        f" was identified in volts. With +-{SUPPLY_V:.0f} V the row of PID_auto would be {by_volts}."
    )
    derivative = "The change since the last step, 0 in the first: no kick. PID_auto has the filter of Table 2."
    solver = "Simulink's fixed step of third order; it integrates the squared error, too."
    return [
        section.open("one lap", "s", Settings().lap_s, f"Table 4 asks for {lap.value:.2f} +- {lap.either_way:.2f}."),
        section.open("sense", "", "counter-cw", "The other one exchanges drives I and IV, II and III."),
        section.open("start at x, y, z", "mm", "100 -36 -300", "Where the circle's angle is zero."),
        section.open("joints at rest, t = 0", "deg", 0.0, "So the first instant is a step of up to 26 deg."),
        section.open("control signal limited to +-", "%", Settings().u_max, percent),
        section.open("derivative of PID_approx", "", "per step", derivative),
        section.open("solver", "", "ode3", solver),
    ]


def table_4() -> list[Figure]:
    """Integrals of the squared error, and what they would be with (18) as printed."""
    section = Section("Table 4")
    figures = [
        section.compared(f"PID_{tuning}, drive {drive}", "deg2 s", printed, ise)
        for tuning, row in TABLE_4.items()
        for drive, printed, ise in zip(DRIVE_NAMES, row, circle_tracking(tuning).ise, strict=True)
    ]
    slips = [
        section.beyond(f"PID_{tuning}, drive III by (18)", "deg2 s", _with_slip(pid)) for tuning, pid in PIDS.items()
    ]
    note = "Not what is printed above: the authors' program did not have the slip in (18)."
    return [*figures, *slips[:-1], replace(slips[-1], note=note)]


def without_the_step() -> list[Figure]:
    """Table 4 is decided in its first seconds: from a proper start the ranking is the other way round."""
    section = Section("Table 4 without its initial step, sum of the drives")
    reversed_ = (
        f"Sampled at 0.01 s, +-{SUPPLY_V:.0f} V. In Table 4 PID_auto is the better one, thanks to the step at t = 0."
        f" On the circle itself PID_approx is: it has {PID_APPROX.ki / PID_AUTO.ki:.0f} times the integral gain."
    )
    starts: tuple[tuple[Start, str], ...] = (("reference", "starting on the circle"), ("smooth", "5 s from rest to it"))
    figures = [
        section.beyond(f"PID_{tuning}, {words}", "deg2 s", _sampled(tuning, start))
        for start, words in starts
        for tuning in PIDS
    ]
    return [*figures[:-1], replace(figures[-1], note=reversed_)]


def _with_slip(pid: Pid) -> float:
    """Of drive III, with q_3 by (18) as printed, deg^2 s."""
    robot, t = make_robot("par4"), sample_times(Task().duration_s, STEP_S)
    poses = [Tour().poses(robot, t + stage * STEP_S) for stage in simulink_loop.STAGES]
    references = [np.degrees(arm_angles(stage, Par4Geometry(), printed_f3=True)[:, 2]).tolist() for stage in poses]
    return simulink_loop.simulate(PAR4_MOTOR, pid, Settings().u_max, STEP_S, references).ise


def _sampled(tuning: Tuning, start: Start) -> float:
    """All drives together, deg^2 s."""
    return float(circle_tracking(tuning, "sampled", SUPPLY_V, start=start).ise.sum())
