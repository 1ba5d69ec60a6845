"""The sum of errors, with clamping against windup."""

from __future__ import annotations

from collections.abc import Sequence

from app.control.laws.law import Setup


class Integral:
    """Per axis E += T e, but only while |E| stays within its limit (spec: clamping)."""

    def __init__(self, limits: Sequence[float], period_s: float, first: bool) -> None:
        """`first`: an error counts at once (backward Euler); else from the next period on (forward Euler)."""
        self._limits = tuple(limits)
        self._period_s = period_s
        self._first = first
        self._sums: list[float] = [0.0] * len(self._limits)
        self.trace: list[list[float]] = []
        """What was handed out at each instant."""

    def after(self, wanted: Sequence[float], actual: Sequence[float]) -> list[float]:
        """The sums to use now, having met the errors wanted - actual."""
        period, before = self._period_s, self._sums
        after = []
        for total, goal, value, limit in zip(before, wanted, actual, self._limits, strict=True):
            grown = total + period * (goal - value)
            after.append(grown if -limit <= grown <= limit else total)
        self._sums = after
        used = after if self._first else before
        self.trace.append(used)
        return used


def integral_of(setup: Setup, ki: Sequence[float]) -> Integral:
    """One for gains ki per axis, bounded as the tuning says."""
    return Integral(setup.tuning.sum_limits(ki), setup.period_s, setup.tuning.integral_first)
