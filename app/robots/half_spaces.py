"""Projection onto an intersection of half-spaces in space, exact: the dual method of Goldfarb and Idnani (1983).

Plain floats; three coordinates and a dozen half-spaces, of which at most three are active at a time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

Vector = Sequence[float]

OUTSIDE = -1e-12
"""Slack below which a half-space counts as violated (metres for unit normals)."""


class HalfSpace(NamedTuple):
    """All x with  normal . x + offset >= 0."""

    normal: tuple[float, ...]
    offset: float

    def slack(self, x: Vector) -> float:
        return _dot(self.normal, x) + self.offset


def project(wish: Vector, spaces: Sequence[HalfSpace]) -> tuple[list[float], list[float]]:
    """The common point of all half-spaces closest to `wish`, and the multiplier of each.

    Where they have no common point, the answer satisfies those that could be satisfied on the way.
    """
    x, multipliers, active = list(wish), [0.0] * len(spaces), list[int]()
    for _ in range(4 * len(spaces) + 8):
        inactive = (k for k in range(len(spaces)) if k not in active)
        worst = min(inactive, key=lambda k: spaces[k].slack(x), default=None)
        if worst is None or spaces[worst].slack(x) >= OUTSIDE:
            break
        if not _enter(worst, x, multipliers, active, spaces):
            break
    return x, multipliers


def _enter(
    entering: int, x: list[float], multipliers: list[float], active: list[int], spaces: Sequence[HalfSpace]
) -> bool:
    """Move `x` onto the plane of a violated half-space, along the planes that are active; those whose
    multiplier would turn negative on the way leave. False where that is impossible."""
    normal = spaces[entering].normal
    while True:
        shares = _combination([spaces[k].normal for k in active], normal)
        free = [
            n - sum(s * spaces[k].normal[i] for s, k in zip(shares, active, strict=True)) for i, n in enumerate(normal)
        ]
        rise = _dot(free, normal)
        full = -spaces[entering].slack(x) / rise if rise > 1e-10 else math.inf
        ratios = {k: multipliers[k] / s for s, k in zip(shares, active, strict=True) if s > 1e-12}
        leaving = min(ratios, key=ratios.__getitem__, default=None)
        step = full if leaving is None else min(full, ratios[leaving])
        if step == math.inf:
            return False
        if rise > 1e-10:
            x[:] = [a + step * f for a, f in zip(x, free, strict=True)]
        for s, k in zip(shares, active, strict=True):
            multipliers[k] -= step * s
        multipliers[entering] += step
        if step == full:
            active.append(entering)
            return True
        assert leaving is not None
        multipliers[leaving] = 0.0
        active.remove(leaving)


def _combination(normals: list[tuple[float, ...]], target: Vector) -> list[float]:
    """Shares of the normals whose sum comes closest to `target`: the normal equations by elimination."""
    size = len(normals)
    rows = [[_dot(a, b) for b in normals] + [_dot(a, target)] for a in normals]
    for i in range(size):
        for j in range(i + 1, size):
            factor = rows[j][i] / rows[i][i]
            rows[j] = [b - factor * a for a, b in zip(rows[i], rows[j], strict=True)]
    shares = [0.0] * size
    for i in reversed(range(size)):
        known = sum(rows[i][j] * shares[j] for j in range(i + 1, size))
        shares[i] = (rows[i][size] - known) / rows[i][i]
    return shares


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
