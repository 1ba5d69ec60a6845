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
        errors = zip(before, wanted, actual, strict=True)
        after = [total + period * (goal - value) for total, goal, value in errors]
        for grown, limit in zip(after, self._limits, strict=True):
            if not -limit <= grown <= limit:
                after = self._clamped(after, before)
                break
        self._sums = after
        used = after if self._first else before
        self.trace.append(used)
        return used

    def _clamped(self, after: list[float], before: list[float]) -> list[float]:
        """The axes beyond their limit stay as they were."""
        rows = zip(after, before, self._limits, strict=True)
        return [grown if -limit <= grown <= limit else total for grown, total, limit in rows]


def integral_of(setup: Setup, ki: Sequence[float]) -> Integral:
    """One for gains ki per axis, bounded as the tuning says."""
    return Integral(setup.tuning.sum_limits(ki), setup.period_s, setup.tuning.integral_first)
