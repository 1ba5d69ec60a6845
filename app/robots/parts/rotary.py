"""Driven arms of the rotary deltas: where they are, and where their elbows."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from app.robots.parts.machine import quaternions, vectors
from app.robots.parts.part import Placement
from app.robots.parts.quaternions import about_z, turned

Coordinates = tuple[float, float, float]


class RotaryArms:
    """Arms of length L on a circle of radius R. An arm's frame has its origin on the motor axis, x towards the
    elbow and y along the hinge; q turns it about y, downwards."""

    def __init__(self, azimuths: Sequence[float], R: float, L: float, B_z: float) -> None:
        self._arms = [(math.cos(a), math.sin(a), about_z(a)) for a in azimuths]
        self._R, self._L, self._B_z = R, L, B_z
        self._positions = vectors([v for ca, sa, _ in self._arms for v in (R * ca, R * sa, B_z)])

    @property
    def level(self) -> Placement:
        """The arms held level: the frame of what stands still beside them."""
        return Placement(self._positions, quaternions([v for _, _, azimuth in self._arms for v in azimuth]))

    def place(self, joints: Sequence[float]) -> tuple[NDArray[np.float32], NDArray[np.float32], list[Coordinates]]:
        """Positions (always the same array) and rotations of the arms, and the elbows."""
        wxyzs: list[float] = []
        elbows = []
        for (ca, sa, azimuth), q in zip(self._arms, joints, strict=True):
            reach = self._R + self._L * math.cos(q)
            elbows.append((reach * ca, reach * sa, self._B_z - self._L * math.sin(q)))
            wxyzs += turned(azimuth, math.cos(0.5 * q), 0.0, math.sin(0.5 * q), 0.0)
        return self._positions, quaternions(wxyzs), elbows
