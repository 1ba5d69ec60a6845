"""What lies between a controller's number and the joint, and back: each imperfection can be switched on.

Out: the supply's limit, the steps of the pulse width, a delay, Coulomb and viscous friction, more inertia, play in
the gear. Back: noise, and the steps of a potentiometer read by an analogue-digital converter.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.control import Motor

FINE_STEP_S = 1e-3
"""Friction, delay and play are computed at least this finely."""

MAX_DELAY_S = 1.0


@dataclass(frozen=True)
class Hardware:
    """Imperfections of one drive. The defaults are a perfect one."""

    supply_v: float = math.inf
    """Largest voltage to either side."""
    pwm_steps: int = 0
    """Steps of the pulse width from 0 to the supply's voltage; 0 for none, and none without a limited supply."""
    adc_bits: int = 0
    """Resolution of the position reading; 0 for a perfect one. The STM32F4 has 12, the Arduino Uno 10."""
    sensor_range: float = 340.0
    """Travel over which those bits are spread, in the drive's unit. A single-turn potentiometer has 340 deg."""
    noise: float = 0.0
    """Standard deviation of the reading, in the drive's unit."""
    delay_s: float = 0.0
    """From the controller's decision to the motor."""
    coulomb_v: float = 0.0
    """Voltage at which the motor begins to turn: dry friction."""
    viscous: float = 0.0
    """Additional damping, 1/s."""
    inertia_factor: float = 1.0
    """Inertia, relative to that with which the motor was identified."""
    backlash: float = 0.0
    """Play between motor and joint, in the drive's unit."""

    @property
    def needs_fine_steps(self) -> bool:
        return bool(self.delay_s or self.coulomb_v or self.backlash)


Shaft = Callable[[float], float]
"""Voltage wanted, for one step -> where the joint is after it; it remembers."""

Sensor = Callable[[float], float]
"""Where the joint is -> what the controller reads."""


def shaft(motor: Motor, hardware: Hardware, step_s: float, y: float = 0.0) -> Shaft:
    """A motor with its gear, from rest at `y`, moved on by `step_s` a call."""
    turn = _rotor(motor.loaded(hardware.inertia_factor, hardware.viscous), hardware.coulomb_v, step_s, y)
    if hardware.delay_s:
        turn = _delayed(turn, round(min(hardware.delay_s, MAX_DELAY_S) / step_s))
    if hardware.pwm_steps and math.isfinite(hardware.supply_v):
        turn = _in_steps(turn, hardware.supply_v / hardware.pwm_steps)
    return _with_play(turn, hardware.backlash / 2, y) if hardware.backlash else turn


def sensor(hardware: Hardware, seed: int, readings: int) -> Sensor:
    """The position reading; its noise repeats with the seed."""
    resolution = hardware.sensor_range / 2**hardware.adc_bits if hardware.adc_bits else 0.0
    if not hardware.noise:
        return (lambda y: _in_whole(y, resolution)) if resolution else (lambda y: y)
    noise = iter((hardware.noise * np.random.default_rng(seed).standard_normal(readings)).tolist())
    if resolution:
        return lambda y: _in_whole(y + next(noise), resolution)
    return lambda y: y + next(noise)


def _rotor(motor: Motor, coulomb_v: float, step_s: float, y: float) -> Shaft:
    """Exact under a held voltage. Dry friction opposes the motion, and holds the rotor where it comes to rest."""
    a11, a12, a21, a22, b1, b2 = motor.zoh(step_s)
    v = 0.0
    droop_v = motor.T2 / motor.K

    def smooth(u: float) -> float:
        nonlocal y, v
        y, v = a11 * y + a12 * v + b1 * u, a21 * y + a22 * v + b2 * u
        return y

    def rough(u: float) -> float:
        nonlocal y, v
        drive = u - droop_v * y
        if v == 0.0 and abs(drive) <= coulomb_v:
            return y
        direction = math.copysign(1.0, v or drive)
        u -= direction * coulomb_v
        y, v = a11 * y + a12 * v + b1 * u, a21 * y + a22 * v + b2 * u
        if v * direction < 0.0:
            v = 0.0
        return y

    return rough if coulomb_v else smooth


def _delayed(turn: Shaft, steps: int) -> Shaft:
    waiting = deque([0.0] * steps)

    def late(u: float) -> float:
        waiting.append(u)
        return turn(waiting.popleft())

    return late


def _in_steps(turn: Shaft, step_v: float) -> Shaft:
    return lambda u: turn(_in_whole(u, step_v))


def _in_whole(value: float, step: float) -> float:
    """The nearest multiple; what a diverging loop has made infinite stays so."""
    return round(value / step) * step if math.isfinite(value) else value


def _with_play(turn: Shaft, half: float, y: float) -> Shaft:
    """The joint moves when one flank of the gear or the other touches it."""

    def loose(u: float) -> float:
        nonlocal y
        gear = turn(u)
        y = min(max(y, gear - half), gear + half)
        return y

    return loose
