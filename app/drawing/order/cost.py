"""What a hop, the way with the pen up from one stroke to the next, costs the robot."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
HOME = (0.0, 0.0)


@dataclass(frozen=True)
class HopCost:
    """Seconds of a hop: lifting and lowering the pen, and the way.

    The defaults fit the measured hops with a lift of 4 mm: 0.15 s for the usual few millimetres.
    """

    lift_s: float = 0.15
    """For up and down together, however short the hop."""
    speed_mm_s: float = 300.0
    """Along the sheet."""
    touch_mm: float = 0.05
    """Ends this close cost nothing: `join_touching` makes one stroke of such strokes. Negative if that is not done."""

    def seconds(self, mm: Any) -> Array:
        """Of hops of `mm`, any shape. Infinitely far means: not to be reached at all, at no cost."""
        mm = np.asarray(mm, dtype=float)
        lifts = (mm > self.touch_mm) & (mm < math.inf)
        return np.where(lifts, self.lift_s + mm / self.speed_mm_s, 0.0)


DEFAULT_COST = HopCost()


def hop_lengths(strokes: Sequence[Array], home: tuple[float, float] = HOME) -> Array:
    """(n,) mm: from `home` to the first stroke, then from each stroke to the next. The last one ends the drawing."""
    if not strokes:
        return np.zeros(0)
    starts = np.array([stroke[0] for stroke in strokes])
    leaves = np.array([home, *(stroke[-1] for stroke in strokes[:-1])])
    return np.hypot(*(starts - leaves).T)


def ink_mm(strokes: Sequence[Array]) -> float:
    """Length of all strokes, (n, 2) mm each."""
    return sum(float(np.linalg.norm(np.diff(stroke, axis=0), axis=1).sum()) for stroke in strokes)


def between_mm(strokes: Sequence[Array]) -> float:
    """Length of the ways between the strokes, from the first one's beginning on."""
    return pen_up_mm(strokes, tuple(strokes[0][0].tolist()))


def pen_up_mm(strokes: Sequence[Array], home: tuple[float, float] = HOME) -> float:
    """The way with the pen up, beginning at `home`."""
    return float(hop_lengths(strokes, home).sum())


def pen_up_s(strokes: Sequence[Array], home: tuple[float, float] = HOME, hop_cost: HopCost = DEFAULT_COST) -> float:
    """The time with the pen up, lifts included."""
    return float(hop_cost.seconds(hop_lengths(strokes, home)).sum())
