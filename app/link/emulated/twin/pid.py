"""The PID of one joint: `app.control.sampled_pid` (backward Euler, clamping), with gains that change under way."""

from __future__ import annotations

from collections.abc import Sequence


class JointPid:
    """At rest, with nothing remembered."""

    def __init__(self) -> None:
        self._integral = self._derivative = self._last_error = 0.0

    def step(self, gains: Sequence[float], h: float, error: float, limit: float) -> float:
        """One period of `h` seconds; `gains` are kp, ki, kd, n, with n = 0 for an ideal derivative."""
        kp, ki, kd, n = gains
        growth = ki * h * error
        change, self._last_error = error - self._last_error, error
        if not kd:
            self._derivative = 0.0
        elif n:
            self._derivative = (self._derivative + kd * n * change) / (1.0 + n * h)
        else:
            self._derivative = kd * change / h
        wanted = kp * error + self._integral + growth + self._derivative
        if -limit <= wanted <= limit:
            self._integral += growth
            return wanted
        if not growth * wanted > 0.0:
            self._integral += growth
        return limit if wanted > 0.0 else -limit
