"""What the host can be asked to move the robot along."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from app.drawing.toolpath import PenSettings, Toolpath, laser_power, sample
from app.link.errors import LinkError

Array = NDArray[np.float64]

STEP_S = 0.005
"""Between the samples of a program made from a drawing: half of the time between two set-points."""


@dataclass(frozen=True)
class Jog:
    """Motion along one joint or one axis of the pose."""

    space: Literal["joint", "pose"]
    axis: int
    """From 0."""
    direction: int
    """+1 or -1."""
    speed: float
    """rad/s or m/s, above 0."""


@dataclass(frozen=True, eq=False)
class Program:
    """A timed motion of the joints, k samples of n joints. The way to its first point belongs to whoever runs it."""

    title: str
    robot: str
    """Its name in `ROBOTS`."""
    t: Array
    """(k,) s, from 0, increasing"""
    q: Array
    """(k, n) rad or m"""
    pen_down: NDArray[np.bool_]
    """(k,)"""
    laser: Array
    """(k,) share of the power, 0 to 1"""
    starts_manual: bool = False
    """Run with the manual flag: the board limits the tool to its manual speed, and takes it before homing."""

    def __post_init__(self) -> None:
        k = len(self.t)
        if k < 2 or not len(self.q) == len(self.pen_down) == len(self.laser) == k:
            raise LinkError("A program needs at least two moments, with joints, pen and laser for each of them.")
        if not (np.isfinite(self.t).all() and np.isfinite(self.q).all() and np.isfinite(self.laser).all()):
            raise LinkError("A program holds a number that is not finite; make it again.")
        if not (np.diff(self.t) > 0.0).all() or self.t[0] != 0.0:
            raise LinkError("The times of a program must begin at 0 and increase; make it again.")

    @property
    def duration_s(self) -> float:
        return float(self.t[-1])

    @classmethod
    def from_toolpath(
        cls, toolpath: Toolpath, robot: str, title: str = "Drawing", pen: PenSettings | None = None
    ) -> Program:
        """A drawing. With the settings of a laser as its pen, the laser follows the tool's speed."""
        t = np.append(np.arange(0.0, toolpath.duration_s - 1e-6, STEP_S), toolpath.duration_s)
        at = sample(toolpath, t)
        power = np.zeros(len(t)) if pen is None else np.interp(t, toolpath.t, laser_power(toolpath, pen))
        return cls(title, robot, t, at.q, at.pen & (pen is None or not pen.laser), np.where(at.pen, power, 0.0))
