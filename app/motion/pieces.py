"""Piecewise polynomials: the common form of time laws, rounded corners, belts and point-to-point moves."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.motion.trajectory import Array

END = 1e-12
"""Of the whole length: what rounding may take from the last knot."""


@dataclass(frozen=True, eq=False)
class Pieces:
    """Between knots j and j + 1 the value is sum_i coefficients[i, j] (u - knots[j])^i; beyond, it is constant."""

    knots: Array
    """(m + 1,) increasing."""
    coefficients: Array
    """(degree + 1, m) or (degree + 1, m, axes)."""

    def at(self, u: ArrayLike) -> tuple[Array, Array, Array]:
        """Value, first and second derivative at u (k,): (k,) or (k, axes) each. At a knot, of the piece after it;
        at both ends, of the piece inside."""
        asked = np.asarray(u, dtype=float)
        inside = np.clip(asked, self.knots[0], self.knots[-1])
        piece = np.clip(np.searchsorted(self.knots, inside, side="right") - 1, 0, len(self.knots) - 2)
        axes = (1,) * (self.coefficients.ndim - 2)
        step = (inside - self.knots[piece]).reshape(*asked.shape, *axes)
        value, first, second = _horner(self.coefficients[:, piece], step)
        moving = (np.abs(asked - inside) <= END * (self.knots[-1] - self.knots[0])).reshape(step.shape)
        return value, first * moving, second * moving

    def stretched(self, factor: float) -> Pieces:
        """The same values over a `factor` times longer time."""
        powers = factor ** -np.arange(len(self.coefficients), dtype=float)
        shape = (-1, *(1,) * (self.coefficients.ndim - 1))
        return Pieces(self.knots * factor, self.coefficients * powers.reshape(shape))


def _horner(coefficients: Array, step: Array) -> tuple[Array, Array, Array]:
    value = np.zeros_like(coefficients[0] * step)
    first, second = np.zeros_like(value), np.zeros_like(value)
    for coefficient in coefficients[::-1]:
        second = second * step + 2.0 * first
        first = first * step + value
        value = value * step + coefficient
    return value, first, second


def joined(pieces: Iterable[tuple[float, Sequence[float] | Sequence[Array]]], start: float = 0.0) -> Pieces:
    """Pieces one after the other, each as (length, coefficients from the constant up).

    Example: `joined([(1.0, [0.0, 1.0]), (2.0, [1.0])])` rises to 1 within 1 and stays there.
    """
    parts = [(length, np.array(coefficients, dtype=float)) for length, coefficients in pieces]
    knots = start + np.concatenate([[0.0], np.cumsum([length for length, _ in parts])])
    table = np.zeros((max(len(part) for _, part in parts), len(parts), *parts[0][1].shape[1:]))
    for column, (_, part) in enumerate(parts):
        table[: len(part), column] = part
    return Pieces(knots, table)


def quintic_between(
    start: float, end: float, duration: float, start_rate: float = 0.0, end_rate: float = 0.0
) -> list[float]:
    """Coefficients of the polynomial of degree 5 from `start` to `end` with these rates, its second derivative 0
    at both ends."""
    gap, v0, v1 = end - start - start_rate * duration, start_rate * duration, end_rate * duration
    rise = v1 - v0
    c3, c4, c5 = 10.0 * gap - 4.0 * rise, -15.0 * gap + 7.0 * rise, 6.0 * gap - 3.0 * rise
    return [start, start_rate, 0.0, c3 / duration**3, c4 / duration**4, c5 / duration**5]
