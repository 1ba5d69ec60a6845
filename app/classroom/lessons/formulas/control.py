"""One drive and its controller: the motor, the loop's step response and margins, and rules for gains.

Angles in deg, carriages in mm; `motor` is a table { K, T1, T2 } and without it the robot's own.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from app.classroom.lessons.formulas.registry import Quantity, formula
from app.control import Motor, Pid
from app.control.drives import DRIVES

Table = dict[str, float]
NOTHING: Any = {}


def motor_of(robot: str, motor: Table) -> Motor:
    """The robot's motor, some of its numbers changed."""
    return replace(DRIVES[robot].motor, **motor)


def pid_of(gains: Table) -> Pid:
    """kp, ki, kd, n, b, c."""
    return Pid(**{"kp": 0.0, **gains})


@formula("motor")
def motor(robot: str = "par4", motor: Table = NOTHING, volts: float = 1.0) -> dict[str, Quantity]:
    """Of y'' + T1 y' + T2 y = K u: K, T1, T2, `fast` and `slow` (time constants, s), `gain`, `final` and `speed`.

    `speed` is where the speed settles if there is no droop (T2 = 0): K volts / T1.
    """
    chosen = motor_of(robot, motor)
    slow, fast = sorted(abs(pole.real) for pole in chosen.poles)
    unit = chosen.unit
    return {
        "K": Quantity(chosen.K, f"{unit}/(V s^2)"),
        "T1": Quantity(chosen.T1, "1/s"),
        "T2": Quantity(chosen.T2, "1/s^2"),
        "fast": Quantity(1.0 / fast, "s"),
        "slow": Quantity(1.0 / slow if slow else math.inf, "s"),
        "gain": Quantity(chosen.dc_gain, f"{unit}/V"),
        "final": Quantity(chosen.dc_gain * volts, unit),
        "speed": Quantity(chosen.K * volts / chosen.T1, f"{unit}/s"),
    }


@formula("reaction_curve")
def reaction_curve(robot: str = "par4", motor: Table = NOTHING) -> dict[str, Quantity]:
    """k (unit/V), T0 (s) and T (s) of the tangent to the motor's step response."""
    from app.control.tuning.reaction_curve import exact

    chosen = motor_of(robot, motor)
    curve = exact(chosen)
    return {"k": Quantity(curve.k, f"{chosen.unit}/V"), "T0": Quantity(curve.T0, "s"), "T": Quantity(curve.T, "s")}


@formula("tuning")
def tuning(
    method: str, robot: str = "par4", motor: Table = NOTHING, response_time: float = 0.2, transient: float = 0.8
) -> dict[str, Quantity]:
    """kp, ki, kd, n (rad/s), Ti (s) and Td (s) of a tuning method, by the name the Control tab has for it.

    `response_time` (s) and `transient` are the tuner's two sliders.
    """
    from app.control.tuning.methods import METHODS, Wish

    if method not in METHODS:
        raise ValueError(f"the methods are {', '.join(METHODS)}.")
    pid = METHODS[method].tune(motor_of(robot, motor), Wish(response_time, transient)).pid
    return {
        **{name: Quantity(getattr(pid, name)) for name in ("kp", "ki", "kd")},
        "n": Quantity(pid.n, "rad/s"),
        "Ti": Quantity(pid.Ti, "s"),
        "Td": Quantity(pid.Td, "s"),
    }


@formula("step_metric")
def step_metric(
    gains: Table,
    robot: str = "par4",
    motor: Table = NOTHING,
    setpoint: float = math.nan,
    duration: float = math.nan,
    period: float = math.nan,
    supply: float = math.nan,
    anti_windup: str = "none",
    hardware: Table = NOTHING,
) -> dict[str, Quantity]:
    """Of a drive's step response as its board runs it: overshoot (%), rise (s), settling (s), peak, steady_error, ise,
    saturation (%), peak_control (V). gains: { kp, ki, kd, n, b, c }; period in ms, supply in V, duration in s; hardware
    with the names of app.simulation.hardware.Hardware.
    """
    from app.simulation.step_study import Question, board_response

    drive = DRIVES[robot]
    loop = _loop(robot, motor, gains, period, supply, anti_windup, hardware)
    height = _or(setpoint, drive.setpoint)
    response = board_response(Question(loop, height, _or(duration, 3.0 if robot == "par4" else 1.0)))
    found, unit = response.metrics, loop.motor.unit
    return {
        "overshoot": Quantity(found.overshoot_pct, "%"),
        "rise": Quantity(found.rise_s, "s"),
        "settling": Quantity(found.settling_s, "s"),
        "peak": Quantity(found.peak, unit),
        "steady_error": Quantity(100.0 * found.steady_state_error / height, "%"),
        "ise": Quantity(found.ise, f"{unit}^2 s"),
        "saturation": Quantity(found.saturation_pct, "%"),
        "peak_control": Quantity(float(abs(response.u).max()), "V"),
    }


@formula("margin")
def margin(
    gains: Table,
    robot: str = "par4",
    motor: Table = NOTHING,
    period: float = math.nan,
    ideal: bool = False,
    method: str = "backward Euler",
) -> dict[str, Quantity]:
    """phase (deg), gain (dB), crossover and bandwidth (rad/s), dead_time (ms) and Ms of a loop, sampled or ideal."""
    from app.control.frequency import OpenLoop
    from app.control.margins import margins

    loop = _loop(robot, motor, gains, period, math.nan, "none", {})
    sampling = None if ideal else replace(loop.sampling, method=method)
    found = margins(OpenLoop(loop.motor, loop.pid, 0.0, sampling))
    return {
        "phase": Quantity(found.phase_margin_deg, "deg"),
        "gain": Quantity(20.0 * math.log10(found.gain_margin), "dB"),
        "crossover": Quantity(found.crossover_rad_s, "rad/s"),
        "bandwidth": Quantity(found.bandwidth_rad_s, "rad/s"),
        "dead_time": Quantity(1e3 * found.delay_margin_s, "ms"),
        "Ms": Quantity(found.Ms),
    }


@formula("noise_voltage", "V")
def noise_voltage(gains: Table, noise: float, robot: str = "par4", period: float = math.nan) -> float:
    """Standard deviation of what kp and the filtered kd make of a sensor's white noise, by backward Euler; the
    drive's answer to it is left out. `noise` in deg or mm, period in ms.
    """
    pid, h = pid_of(gains), _or(1e-3 * period, DRIVES[robot].period_s)
    if math.isinf(pid.n):
        return noise * math.hypot(pid.kp + pid.kd / h, pid.kd / h)
    keep, jump = 1.0 / (1.0 + pid.n * h), pid.kd * pid.n / (1.0 + pid.n * h)
    return noise * math.sqrt((pid.kp + jump) ** 2 + jump * jump * (1.0 - keep) / (1.0 + keep))


def _loop(robot: str, motor: Table, gains: Table, period: float, supply: float, anti_windup: str, hardware: Table):
    """A drive's loop; NaN stands for what the robot's drive has."""
    from app.control.sampled_pid import Sampling
    from app.simulation.hardware import Hardware
    from app.simulation.sampled_loop import DriveLoop

    drive = DRIVES[robot]
    if anti_windup not in ("none", "clamping", "back-calculation"):
        raise ValueError("anti_windup is none, clamping or back-calculation.")
    sampling = Sampling(_or(1e-3 * period, drive.period_s), anti_windup=anti_windup)
    real = Hardware(supply_v=_or(supply, drive.supply_v), sensor_range=drive.sensor_range)
    return DriveLoop(motor_of(robot, motor), pid_of(gains), sampling, replace(real, **hardware))


def _or(value: float, otherwise: float) -> float:
    return otherwise if math.isnan(value) else value
