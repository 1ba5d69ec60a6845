"""The open loop L = C G at a frequency: as continuous controllers see it, and as sampled ones do."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.control.motor import Motor
from app.control.pid import Pid
from app.control.sampled_pid import Sampling

Complex = NDArray[np.complex128]
Array = NDArray[np.floating[Any]]


@dataclass(frozen=True)
class OpenLoop:
    """A motor, its controller and a delay between them."""

    motor: Motor
    pid: Pid
    delay_s: float = 0.0
    sampling: Sampling | None = None
    """None for a continuous controller."""

    @property
    def highest_rad_s(self) -> float:
        """Up to which frequency the loop has a meaning."""
        return math.inf if self.sampling is None else math.pi / self.sampling.period_s

    def response(self, omega: Array) -> Complex:
        """(...,) L at frequencies (...) in rad/s."""
        s = 1j * np.asarray(omega, dtype=float)
        loop = _continuous(self.motor, self.pid, s) if self.sampling is None else self._sampled(s)
        return np.asarray(loop * np.exp(-s * self.delay_s), dtype=complex)

    def poles(self) -> Complex:
        """(k,) closed-loop poles in rad/s; those of a sampled loop are mapped by ln(z) / h. The delay is left out:
        with it there are infinitely many."""
        return self._poles

    @cached_property
    def _poles(self) -> Complex:
        if self.sampling is None:
            return np.roots(np.polyadd(*open_loop_polynomials(self.motor, self.pid))).astype(complex)
        roots = np.roots(np.polyadd(*_sampled_characteristic(self.pid, self.sampling, *self._plant))).astype(complex)
        roots = roots[np.abs(roots) > 1e-12]
        return np.asarray(np.log(roots) / self.sampling.period_s, dtype=complex)

    @cached_property
    def _plant(self) -> tuple[list[float], list[float]]:
        """Numerator and denominator in z of the motor behind its hold."""
        assert self.sampling is not None
        return self.motor.zoh(self.sampling.period_s).polynomials

    def _sampled(self, s: Complex) -> Complex:
        assert self.sampling is not None
        z = np.exp(s * self.sampling.period_s)
        numerator, denominator = self._plant
        return np.polyval(numerator, z) / np.polyval(denominator, z) * _sampled_pid(self.pid, self.sampling, z)


def _continuous(motor: Motor, pid: Pid, s: Complex) -> Complex:
    derivative = s if math.isinf(pid.n) else s * pid.n / (s + pid.n)
    return (pid.kp + pid.ki / s + pid.kd * derivative) * motor.K / (s * s + motor.T1 * s + motor.T2)


def _sampled_pid(pid: Pid, sampling: Sampling, z: Complex) -> Complex:
    """kp + ki / s + kd N s / (s + N), with the method's difference in the place of s."""
    s = (1.0 - 1.0 / z) / sampling.period_s
    if sampling.method == "Tustin":
        s = 2.0 * s / (1.0 + 1.0 / z)
    derivative = s if math.isinf(pid.n) else s * pid.n / (s + pid.n)
    return pid.kp + pid.ki / s + pid.kd * derivative


def open_loop_polynomials(motor: Motor, pid: Pid) -> tuple[Array, Array]:
    """Denominator and numerator in s of C G, highest power first; set-point weights do not matter."""
    denominator, numerator = _controller(pid, np.array([1.0, 0.0]), np.array([1.0]))
    return np.convolve([1.0, motor.T1, motor.T2], denominator), motor.K * numerator


def _sampled_characteristic(
    pid: Pid, sampling: Sampling, plant_numerator: list[float], plant_denominator: list[float]
) -> tuple[Array, Array]:
    """The same in z."""
    if sampling.method == "Tustin":
        difference, total = np.array([2.0, -2.0]) / sampling.period_s, np.array([1.0, 1.0])
    else:
        difference, total = np.array([1.0, -1.0]) / sampling.period_s, np.array([1.0, 0.0])
    denominator, numerator = _controller(pid, difference, total)
    return np.convolve(plant_denominator, denominator), np.convolve(plant_numerator, numerator)


def _controller(pid: Pid, top: Array, bottom: Array) -> tuple[Array, Array]:
    """Denominator and numerator of the controller as polynomials, with top / bottom in the place of s. Parts
    with no gain add no pole."""
    denominator, numerator = np.array([1.0]), np.array([pid.kp])
    parts = []
    if pid.ki:
        parts.append((top, pid.ki * bottom))
    if pid.kd:
        ideal = math.isinf(pid.n)
        parts.append((bottom if ideal else np.polyadd(bottom, top / pid.n), pid.kd * top))
    for pole, zero in parts:
        numerator = np.polyadd(np.convolve(numerator, pole), np.convolve(denominator, zero))
        denominator = np.convolve(denominator, pole)
    return denominator, numerator
