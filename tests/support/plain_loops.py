"""Closed loops written down a second time, the obvious way: what the fast ones are tested and timed against.

Nothing here is shared with `app.simulation`: one loop in NumPy over all drives, one in objects for one drive.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from app.control import Motor, Pid
from tests.support.oracles import signal

Array = NDArray[np.float64]


def discrete_plant(motor: Motor, period_s: float) -> tuple[Array, Array]:
    """A (2, 2) and B (2,) of the state (position, speed) behind a hold, by scipy."""
    A, B = np.array([[0.0, 1.0], [-motor.T2, -motor.T1]]), np.array([[0.0], [motor.K]])
    A, B, *_ = signal.cont2discrete((A, B, np.eye(2), np.zeros((2, 1))), period_s, method="zoh")
    return A, B[:, 0]


def numpy_sampled(motor: Motor, pid: Pid, u_max: float, h: float, references: Array) -> tuple[Array, Array, Array]:
    """Backward Euler without anti-windup; references (k, n) -> outputs (k, n), controls (k, n), ISE (n,)."""
    A, B = discrete_plant(motor, h)
    count, drives = references.shape
    state, integral, filtered = np.zeros((2, drives)), np.zeros(drives), np.zeros(drives)
    ise, last = np.zeros(drives), np.zeros(drives)
    outputs, controls = np.empty((count, drives)), np.empty((count, drives))
    for k in range(count):
        error = references[k] - state[0]
        ise += error**2 * h
        integral = integral + pid.ki * h * error
        if math.isinf(pid.n):
            derivative = pid.kd * (error - last) / h
        else:
            filtered = (filtered + h * pid.n * pid.kd * error) / (1 + h * pid.n)
            derivative = pid.n * (pid.kd * error - filtered)
        u = np.clip(pid.kp * error + integral + derivative, -u_max, u_max)
        outputs[k], controls[k], last = state[0], u, error
        state = A @ state + np.outer(B, u)
    return outputs, controls, ise


def numpy_ode3(
    motor: Motor, pid: Pid, u_max: float, h: float, reference: Callable[[float], Array], count: int
) -> tuple[Array, Array, Array]:
    """Bogacki-Shampine with a fixed step, all drives at once, Simulink's Derivative block for an ideal derivative."""
    drives = len(reference(0.0))
    x = np.zeros((5, drives))  # position, speed, integral, filter, ISE
    last_time, last_error = None, np.zeros(drives)

    def output(t: float, state: Array) -> tuple[Array, Array, Array]:
        error = reference(t) - state[0]
        if math.isfinite(pid.n):
            slope = pid.n * (pid.kd * error - state[3])
            derivative = slope
        elif last_time is None or t == last_time:
            slope = derivative = np.zeros(drives)
        else:
            slope, derivative = np.zeros(drives), pid.kd * (error - last_error) / (t - last_time)
        return np.clip(pid.kp * error + state[2] + derivative, -u_max, u_max), error, slope

    def rate(t: float, state: Array) -> Array:
        u, error, slope = output(t, state)
        acceleration = motor.K * u - motor.T1 * state[1] - motor.T2 * state[0]
        return np.array([state[1], acceleration, pid.ki * error, slope, error**2])

    outputs, controls = np.empty((count, drives)), np.empty((count, drives))
    for k in range(count):
        t = k * h
        outputs[k], (controls[k], error, _) = x[0], output(t, x)
        k1 = rate(t, x)
        last_time, last_error = t, error
        k2 = rate(t + h / 2, x + h / 2 * k1)
        k3 = rate(t + 3 * h / 4, x + 3 * h / 4 * k2)
        x = x + h * (2 / 9 * k1 + 1 / 3 * k2 + 4 / 9 * k3)
    return outputs, controls, x[4]


class PlainMotor:
    """A motor behind its hold."""

    def __init__(self, motor: Motor, period_s: float) -> None:
        A, B = discrete_plant(motor, period_s)
        self.A, self.B = A.tolist(), B.tolist()
        self.position = self.speed = 0.0

    def step(self, u: float) -> None:
        position, speed = self.position, self.speed
        self.position = self.A[0][0] * position + self.A[0][1] * speed + self.B[0] * u
        self.speed = self.A[1][0] * position + self.A[1][1] * speed + self.B[1] * u


class PlainPid:
    """Backward Euler, filtered derivative of the error, no anti-windup."""

    def __init__(self, pid: Pid, period_s: float, u_max: float) -> None:
        self.pid, self.h, self.u_max = pid, period_s, u_max
        self.integral = self.filtered = 0.0

    def update(self, error: float) -> float:
        self.integral += self.pid.ki * self.h * error
        gain = self.h * self.pid.n
        self.filtered = (self.filtered + gain * self.pid.kd * error) / (1.0 + gain)
        derivative = self.pid.n * (self.pid.kd * error - self.filtered)
        u = self.pid.kp * error + self.integral + derivative
        return max(-self.u_max, min(self.u_max, u))


def object_sampled(
    motor: Motor, pid: Pid, u_max: float, h: float, references: Sequence[float]
) -> tuple[list[float], list[float], float]:
    """One drive as objects; the controller's filter must be finite."""
    plant, controller, ise = PlainMotor(motor, h), PlainPid(pid, h, u_max), 0.0
    outputs, controls = [], []
    for reference in references:
        error = reference - plant.position
        ise += error**2 * h
        u = controller.update(error)
        outputs.append(plant.position)
        controls.append(u)
        plant.step(u)
    return outputs, controls, ise


class PlainSimulinkLoop:
    """One drive with its controller as a continuous system, to be integrated by `ode3`."""

    def __init__(self, motor: Motor, pid: Pid, u_max: float, reference: Callable[[float], float]) -> None:
        self.motor, self.pid, self.u_max, self.reference = motor, pid, u_max, reference
        self.state = [0.0] * 5
        self.last: tuple[float, float] | None = None

    def control(self, t: float, state: Sequence[float]) -> tuple[float, float, float]:
        error = self.reference(t) - state[0]
        if math.isfinite(self.pid.n):
            slope = self.pid.n * (self.pid.kd * error - state[3])
            derivative = slope
        elif self.last is None or self.last[0] == t:
            slope = derivative = 0.0
        else:
            slope, derivative = 0.0, self.pid.kd * (error - self.last[1]) / (t - self.last[0])
        u = self.pid.kp * error + state[2] + derivative
        return max(-self.u_max, min(self.u_max, u)), error, slope

    def rate(self, t: float, state: Sequence[float]) -> list[float]:
        u, error, slope = self.control(t, state)
        acceleration = self.motor.K * u - self.motor.T1 * state[1] - self.motor.T2 * state[0]
        return [state[1], acceleration, self.pid.ki * error, slope, error**2]

    def ode3(self, t: float, h: float) -> tuple[float, float]:
        """One full step; the output and the control signal at its start."""
        x, (u, error, _) = self.state, self.control(t, self.state)
        k1 = self.rate(t, x)
        self.last = (t, error)
        k2 = self.rate(t + h / 2, [a + h / 2 * b for a, b in zip(x, k1, strict=True)])
        k3 = self.rate(t + 3 * h / 4, [a + 3 * h / 4 * b for a, b in zip(x, k2, strict=True)])
        self.state = [a + h * (2 * p + 3 * q + 4 * r) / 9 for a, p, q, r in zip(x, k1, k2, k3, strict=True)]
        return x[0], u
