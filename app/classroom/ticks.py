"""Round numbers for an axis."""

from __future__ import annotations

import itertools
import math

Range = tuple[float, float]


def ticks(low: float, high: float, wished: int = 5) -> list[float]:
    """Multiples of 1, 2, 2.5 or 5 times a power of ten that lie in the range, about `wished` of them."""
    step = _step((high - low) / wished)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [number * step for number in range(first, last + 1)]


def tick_words(values: list[float]) -> list[str]:
    """As many digits as tell them apart, and no more; a true minus sign."""
    step = min((b - a for a, b in itertools.pairwise(values)), default=abs(values[0]) if values else 1.0)
    digits = next((d for d in range(8) if abs(round(step, d) - step) < 1e-3 * abs(step)), 8)
    largest = max(map(abs, values), default=0.0)
    if largest >= 1e6 or (0.0 < largest < 1e-4):
        return [f"{value:.3g}".replace("-", "−") for value in values]
    return [f"{value + 0.0:.{digits}f}".replace("-", "−") for value in values]


def widened(values: list[float], margin: float = 0.04) -> Range:
    """The range of the values with some air; never empty."""
    low, high = min(values, default=0.0), max(values, default=1.0)
    if high - low <= 1e-12 * max(abs(low), abs(high), 1e-300):
        half = 0.5 * abs(low) or 0.5
        return low - half, high + half
    air = margin * (high - low)
    return low - air, high + air


def _step(rough: float) -> float:
    power = 10.0 ** math.floor(math.log10(rough))
    return next((nice * power for nice in (1.0, 2.0, 2.5, 5.0) if nice * power >= rough * 0.999), 10.0 * power)
