"""Classic mistakes of control to walk into: settings that show one, and a word on what to try."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from app.control.drives import DRIVES
from app.control.tuning.methods import TABLE_2, TABLE_3
from app.ui.lab.settings import BY_HAND, ControlSettings, changed, default_settings


@dataclass(frozen=True)
class Trap:
    """One mistake."""

    text: str
    """What is seen, and what to change."""
    set_up: Callable[[ControlSettings], ControlSettings]
    """From the robot's defaults, with the motor that is in use."""
    runs: tuple[tuple[str, str], ...] = ()
    """(tuning, start) of robot runs that belong to it."""


def _windup(settings: ControlSettings) -> ControlSettings:
    """A strong integral and a weak supply."""
    pid = settings.pid
    if settings.robot == "par4":
        return changed(settings, tuning=TABLE_3, duration_s=12.0, supply_v=12.0)
    supply = 0.25 * DRIVES[settings.robot].supply_v
    return changed(settings, tuning=BY_HAND, ki=6.0 * pid.kp, duration_s=4.0, supply_v=supply)


def _kick(settings: ControlSettings) -> ControlSettings:
    """A derivative that is hardly filtered."""
    quick = {"tuning": BY_HAND, "kd": max(2.0 * settings.pid.kd, 0.01 * settings.pid.kp), "n": 1000.0}
    return changed(settings, **quick, supply_v=math.inf, duration_s=settings.duration_s / 2.0)


def _slow(settings: ControlSettings) -> ControlSettings:
    return changed(settings, period_s=0.15 if settings.robot == "par4" else 0.04, supply_v=math.inf)


def _noise(settings: ControlSettings) -> ControlSettings:
    strong = max(1.5 * settings.pid.kd, 0.02 * settings.pid.kp)
    return changed(settings, tuning=BY_HAND, noise=0.002 * settings.setpoint, kd=strong, n=400.0)


def _ranking(settings: ControlSettings) -> ControlSettings:
    return changed(settings, tuning=TABLE_2, supply_v=100.0)


TRAPS: dict[str, Trap] = {
    "Windup": Trap(
        "The motor stands at its limit for long, and meanwhile the integral keeps growing: it then overshoots until "
        "the integral has shrunk again. Keep this as baseline, then choose <b>Anti-windup: clamping</b> under Program "
        "on the board.",
        _windup,
    ),
    "Derivative kick": Trap(
        "When the set-point jumps, so does its derivative: look at the first spike of the control signal. Tick "
        "<b>Derivative on measurement</b> under Program on the board, and it is gone.",
        _kick,
    ),
    "Too slow sampling": Trap(
        "Between two looks at the sensor the controller is blind. Shorten the <b>Period</b> under Program on "
        "the board and watch the phase margin come back.",
        _slow,
    ),
    "Noise and a large kd": Trap(
        "The derivative makes every flicker of the sensor a jerk of the motor. Lower <b>N</b>, the filter's cut-off: "
        "the control signal calms down long before the response suffers.",
        _noise,
    ),
    "A ranking that reverses": Trap(
        "The paper ranks its tunings by the squared error on a circle, and the first jump from rest is 97 % of it. "
        "Four runs: both tunings from rest, then both with a smooth start. Compare the ISE in the tab Run.",
        _ranking,
        runs=((TABLE_2, "rest"), (TABLE_3, "rest"), (TABLE_2, "smooth"), (TABLE_3, "smooth")),
    ),
}


def traps_for(robot: str) -> dict[str, Trap]:
    """The paper's ranking can only be seen on the paper's robot."""
    return {name: trap for name, trap in TRAPS.items() if robot == "par4" or not trap.runs}


def entered(name: str, settings: ControlSettings) -> ControlSettings:
    """The settings of a trap."""
    fresh = replace(default_settings(settings.robot), motor=settings.motor, motor_origin=settings.motor_origin)
    return TRAPS[name].set_up(fresh)
