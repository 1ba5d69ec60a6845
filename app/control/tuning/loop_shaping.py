"""A PID that crosses unity gain where it is asked to, with the phase margin it is asked for, like MATLAB's PID Tuner.

At the crossover w the controller must be C(jw) = e^(j lead) / |G(jw)|, lead = margin - 180 deg - arg G(jw) + w delay.
With the integral's share r = ki / (kp w) and the filter's rho = n / w chosen, C(jw) is the sum of two arrows,

    kp (1 - j r), turned by -atan r,  and  kd j w rho / (rho + j), turned by atan rho,

so that kp and kd follow from the law of sines. A lead below -atan r would need a negative kd: the loop then gets a
PI with as much integral as brings the phase down to what was asked.

MATLAB does not publish how it chooses r and rho. The defaults are those of Table 2 of Laski & Smykowski 2021: at the
crossover the integral costs 0.5 deg of phase and the filter 15.3 deg.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

from app.control.motor import Motor
from app.control.pid import Pid
from app.control.tuning.phase_margin import plant_at, smallest_margin
from app.control.tuning.reaction_curve import TuningError

INTEGRAL_RATIO = 0.0085706
FILTER_RATIO = 3.646829

DEFAULT_MARGIN_DEG = 60.0
"""MATLAB's."""
LEAST_MARGIN_DEG = 10.0
"""Asked for less, the loop would hardly stop swinging: it is given this."""
USABLE_MARGIN_DEG = 30.0
"""Where not even this can be had (or what was asked, if that is less), the loop is slowed down instead."""
KEPT_LEAD_DEG = 10.0
"""The derivative alone leads by atan rho; the last degrees of that would cost all of the proportional part."""
AS_ASKED_DEG = 0.01

SLOWER = 0.8
MAX_SLOWINGS = 60


@dataclass(frozen=True)
class LoopDesign:
    """A controller and what it achieves."""

    pid: Pid
    crossover_rad_s: float
    """Where the gain is one; of several such places the one with the smallest margin."""
    phase_margin_deg: float
    """There, delay included."""
    note: str
    """Empty if all is as asked and every part is in use, otherwise one sentence for the student."""


def tune(
    motor: Motor, response_time_s: float, transient: float = DEFAULT_MARGIN_DEG / 90.0, delay_s: float = 0.0
) -> LoopDesign:
    """The two sliders of PID Tuner: response time = 2 / bandwidth, and 0 (aggressive) .. 1 (robust) = 0 .. 90 deg.

    Raises as `tune_loop`.
    """
    if not response_time_s > 0.0:
        raise ValueError("the response time must be above zero")
    return tune_loop(motor, 2.0 / response_time_s, 90.0 * transient, delay_s)


def tune_loop(
    motor: Motor,
    bandwidth_rad_s: float,
    phase_margin_deg: float = DEFAULT_MARGIN_DEG,
    delay_s: float = 0.0,
    *,
    integral_ratio: float = INTEGRAL_RATIO,
    filter_ratio: float = FILTER_RATIO,
) -> LoopDesign:
    """The gain crossover at `bandwidth_rad_s` with that phase margin (0 .. 90), the exact delay e^(-jw delay) included.

    `integral_ratio` is ki / (kp w), `filter_ratio` n / w (inf for an ideal derivative). What cannot be had is
    approached: the largest margin there is, or a lower bandwidth, and `note` says which.
    Raises ValueError for values out of range, `TuningError` for a motor that no PID of this shape holds.
    """
    if not (bandwidth_rad_s > 0.0 and 0.0 <= phase_margin_deg <= 90.0 and delay_s >= 0.0):
        raise ValueError("the bandwidth must be above zero, the phase margin 0 to 90 degrees, the delay not negative")
    if not (integral_ratio > 0.0 and filter_ratio > 1.0):
        raise ValueError("the integral ratio must be above zero and the filter ratio above one")
    asked = max(phase_margin_deg, LEAST_MARGIN_DEG)
    usable = min(asked, USABLE_MARGIN_DEG) - AS_ASKED_DEG
    w = bandwidth_rad_s
    for _ in range(MAX_SLOWINGS):
        pid, margin = _place(motor, w, asked, delay_s, integral_ratio, filter_ratio)
        crossover, margin = smallest_margin(pid, motor, delay_s) if margin >= usable else (w, margin)
        if margin >= usable:
            note = f"A margin under {asked:.0f}° leaves the arm swinging: the least here is {asked:.0f}°."
            if w < bandwidth_rad_s:
                note = f"{bandwidth_rad_s:.3g} rad/s is too close to unstable here: slowed down to {w:.3g} rad/s."
            elif phase_margin_deg >= asked:
                note = _note(pid, asked, margin, w, crossover)
            return LoopDesign(pid, crossover, margin, note)
        w *= SLOWER
    raise TuningError("No PID of this shape holds this motor steadily: check its K, T1 and T2.")


def _place(
    motor: Motor, w: float, margin_deg: float, delay_s: float, integral_ratio: float, filter_ratio: float
) -> tuple[Pid, float]:
    """The controller for a crossover at w, and the margin in degrees that it has there: other than asked at a limit."""
    plant = plant_at(w, motor)
    plant_phase = cmath.phase(plant) - w * delay_s
    derivative_lead = math.atan(filter_ratio)
    most_lead = derivative_lead - math.radians(KEPT_LEAD_DEG)
    lead = max(min(math.radians(margin_deg - 180.0) - plant_phase, most_lead), -math.pi / 2.0)
    integral_lag = max(math.atan(integral_ratio), -lead)
    whole = abs(plant) * math.sin(derivative_lead + integral_lag)
    p_part = math.sin(derivative_lead - lead) / whole
    d_part = math.sin(lead + integral_lag) / whole
    pid = Pid(
        kp=p_part * math.cos(integral_lag) if lead > -math.pi / 2.0 else 0.0,
        ki=p_part * math.sin(integral_lag) * w,
        kd=d_part / (w * math.sin(derivative_lead)),
        n=filter_ratio * w,
    )
    return pid, 180.0 + math.degrees(lead + plant_phase)


def _note(pid: Pid, asked: float, margin: float, w: float, crossover: float) -> str:
    """What a student should know of a design at the bandwidth asked for, from the gravest on."""
    if margin < asked - AS_ASKED_DEG and not math.isclose(crossover, w, rel_tol=1e-6):
        return f"The gain is one at several frequencies: at {crossover:.3g} rad/s the margin is only {margin:.0f}°."
    if margin < asked - AS_ASKED_DEG:
        return f"{margin:.0f}° is the most that the derivative can give here: a slower response can have more."
    if margin > asked + AS_ASKED_DEG:
        return f"So slow a loop needs the integral only and keeps {margin:.0f}°: it can be faster."
    return "" if pid.kd > 0.0 else "No derivative is needed at this speed: this is a PI controller."
