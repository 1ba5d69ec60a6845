"""The three-dimensional machine of a robot: its bodies, and where each of them is in a pose."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from app.robots.parts.part import Body, Part, Placement
from app.robots.parts.quaternions import IDENTITY, Quaternion, turned


class Machine(ABC):
    """What a robot looks like. Bodies are listed in drawing order, fixed ones first."""

    bodies: tuple[Body, ...]
    floor: float
    """Height of the floor under the machine, metres."""
    seen_from: tuple[float, float, float] = (0.55, -0.80, 0.28)
    """Direction towards an eye that sees the tool and its arms unhidden."""
    tool_tip: float = 0.0
    """Height of the drawn tool's tip above the pose's point; 0 where the tip is that point."""
    lift: float = 0.0
    """How far the drawn joints lie above those of `Robot.skeleton`."""

    @property
    def parts(self) -> tuple[Part, ...]:
        """Every part of every body."""
        return tuple(part for body in self.bodies for part in body.parts)

    @abstractmethod
    def place(self, pose: Sequence[float], joints: Sequence[float]) -> dict[str, Placement]:
        """Where every moving body is, by name, in its own frame.

        Args:
            pose: (dof,) metres and radians.
            joints: (n,) of that pose; the loops close where they belong together.
        """

    def tool_frame(self, pose: Sequence[float]) -> tuple[tuple[float, float, float], Quaternion]:
        """Position and rotation of the frame that bodies with `frame="tool"` ride on."""
        return (pose[0], pose[1], pose[2]), IDENTITY


class RodPairs:
    """Places the two rods of each leg: parallel, side by side along the leg's hinge axis.

    A rod's frame has its origin in the upper ball joint, the lower one at (0, 0, -l). It is turned about the
    leg's hinge axis (y) and then tilted sideways (x), like the rod itself; this is singular only where the rod
    lies along its hinge.
    """

    def __init__(self, azimuths: Sequence[float], half_spacing: float) -> None:
        self._legs = [(math.cos(a), math.sin(a), (math.cos(0.5 * a), 0.0, 0.0, math.sin(0.5 * a))) for a in azimuths]
        self._half_spacing = half_spacing

    def place(self, upper: Sequence[Sequence[float]], lower: Sequence[Sequence[float]]) -> Placement:
        """Placement of the rods, two a leg, between the legs' joint centres (n, 3) at both ends."""
        positions: list[float] = []
        wxyzs: list[float] = []
        w = self._half_spacing
        for (ca, sa, azimuth), (ex, ey, ez), (px, py, pz) in zip(self._legs, upper, lower, strict=True):
            ux, uy, uz = ex - px, ey - py, ez - pz
            out, side = ux * ca + uy * sa, uy * ca - ux * sa
            swing = 0.5 * math.atan2(out, uz)
            tilt = -0.5 * math.atan2(side, math.sqrt(out * out + uz * uz))
            cs, ss, ct, st = math.cos(swing), math.sin(swing), math.cos(tilt), math.sin(tilt)
            rotation = turned(azimuth, cs * ct, cs * st, ss * ct, -ss * st)
            wxyzs += rotation
            wxyzs += rotation
            positions += (ex - sa * w, ey + ca * w, ez, ex + sa * w, ey - ca * w, ez)
        return rows(positions, wxyzs)


def rows(positions: Sequence[float], wxyzs: Sequence[float]) -> Placement:
    """A placement from flat lists of coordinates."""
    return Placement(vectors(positions), quaternions(wxyzs))


def vectors(values: Sequence[float]) -> NDArray[np.float32]:
    """(n, 3) from a flat list."""
    return np.array(values, dtype=np.float32).reshape(-1, 3)


def quaternions(values: Sequence[float]) -> NDArray[np.float32]:
    """(n, 4) from a flat list."""
    return np.array(values, dtype=np.float32).reshape(-1, 4)


def standing(*positions: Sequence[float]) -> Placement:
    """Fixed copies, none of them turned."""
    return rows(
        [float(v) for p in positions for v in p],
        IDENTITY * len(positions),
    )


ORIGIN = standing((0.0, 0.0, 0.0))
"""One copy in the origin of its frame."""
