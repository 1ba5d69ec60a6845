"""What the drives make of the efforts they are asked for: limits, and a delay."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

from app.robots.limits import DriveLimits


class Drives:
    """One per run."""

    def __init__(self, limits: DriveLimits, *, limit_effort: bool, limit_speed: bool, delay_samples: int) -> None:
        n = len(limits.effort)
        self._most: list[float] = limits.effort.tolist() if limit_effort else [math.inf] * n
        self._fastest: list[float] | None = limits.speed.tolist() if limit_speed else None
        self._waiting: deque[Sequence[float]] = deque([[0.0] * n for _ in range(delay_samples)])

    def limited(self, wanted: Sequence[float], joint_rates: Sequence[float]) -> Sequence[float]:
        """Efforts (n,) that the drives can give."""
        effort = wanted
        for f, most in zip(wanted, self._most, strict=True):
            if not -most <= f <= most:
                pairs = zip(wanted, self._most, strict=True)
                effort = [most if f > most else -most if f < -most else f for f, most in pairs]
                break
        if self._fastest is None:
            return effort
        # beyond its largest speed a drive may brake, but not push on
        rows = zip(effort, joint_rates, self._fastest, strict=True)
        return [0.0 if abs(qd) >= most and f * qd > 0.0 else f for f, qd, most in rows]

    def delayed(self, effort: Sequence[float]) -> Sequence[float]:
        """What acts now, having been asked for some periods ago."""
        if not self._waiting:
            return effort
        self._waiting.append(effort)
        return self._waiting.popleft()
