"""The Par4 paper's experiment: four drives carry the tool around a circle (its section 4.5 and Table 4)."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal, get_args

from app.control import PAR4_MOTOR, PID_APPROX, PID_AUTO, Pid
from app.control.sampled_pid import Sampling
from app.motion import Tour
from app.simulation.hardware import Hardware
from app.simulation.run import Run
from app.simulation.tracking import Start, Task, TrackingError, follow_sampled, follow_simulink

Mode = Literal["paper", "sampled"]

APPROX_FILTER_RAD_S = 100.0
"""A sampled derivative needs a filter; the paper's second tuning names none."""


def circle_tracking(
    controller: Literal["auto", "approx"] | Pid = "auto",
    mode: Mode = "paper",
    u_max: float = 100.0,
    lap_s: float = 100.0,
    clockwise: bool = False,
    duration_s: float = 100.0,
    start: Start = "rest",
) -> Run:
    """The Par4's tool on a circle of radius 100 mm around (0, -36, -300) mm.

    Args:
        controller: `auto` (Table 2), `approx` (Table 3), or any controller.
        mode: `paper` as in the paper's Simulink model, step 0.01 s; `sampled` as a microcontroller does it, every
            0.01 s by backward Euler.
        u_max: limit of the control signal. The paper feeds percent of the pulse width, +-100, to a motor that was
            identified in volts; a real drive has 12 V or 24 V.
        start: see `Task`; other than `rest` for `sampled` only.
    Returns:
        `.ise` are Table 4's indices of the four drives, deg^2 s.

    Raises:
        TrackingError: for a controller that does not exist, or a duration or lap that cannot be computed.
    """
    named = {"auto": PID_AUTO, "approx": PID_APPROX if mode == "paper" else replace(PID_APPROX, n=APPROX_FILTER_RAD_S)}
    if isinstance(controller, str) and controller not in named:
        raise TrackingError(f"There is no controller {controller!r}; choose auto, approx, or a Pid of your own.")
    if mode not in get_args(Mode):
        raise TrackingError(f"There is no mode {mode!r}; choose paper or sampled.")
    pid = named[controller] if isinstance(controller, str) else controller
    name = controller if isinstance(controller, str) else "own PID"
    task = Task(tour=Tour(lap_s=lap_s, clockwise=clockwise), duration_s=duration_s, start=start)
    if mode == "paper":
        return follow_simulink(task, pid, u_max, title=f"Circle, {name}, as in the paper")
    return follow_sampled(task, PAR4_MOTOR, pid, Sampling(), Hardware(supply_v=u_max), title=f"Circle, {name}, sampled")
