"""The rods of a delta as MuJoCo bodies: two a leg, each on a universal joint, pinned to the platform by a loop.

A rod's frame is the one in which it is drawn: origin in its upper joint, the lower one at (0, 0, -l), turned about
the leg's hinge (y) and then tilted sideways (x). With a universal joint in place of a ball it cannot spin about
itself; since it has no inertia about its length, its motion is the same and the model has fewer coordinates.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from app.robots.parts.quaternions import about_z, turned
from app.robots.robot import Skeleton
from app.simulation.prototype.draft import POINT, Draft
from app.simulation.prototype.frames import Frame, Vector, minus


@dataclass(frozen=True)
class Rod:
    """What is the same for every rod of a robot."""

    length: float
    """m, joint to joint."""
    mass: float
    """kg"""
    centre: float
    """Centre of mass from the upper joint, as a share of the length."""
    inertia: float
    """kg m^2 about an axis across the rod through its centre of mass."""
    half_spacing: float
    """m, half the distance between the two rods of a leg."""


def azimuths(skeleton: Skeleton) -> list[float]:
    """Directions in which the legs stand, seen from above; the hinges lie across them."""
    return [math.atan2(-hinge[0], hinge[1]) for hinge in skeleton.hinge.tolist()]


def add_rods(draft: Draft, rod: Rod, skeleton: Skeleton, uppers: Sequence[str], lowers: Sequence[str]) -> None:
    """Add the rods of every leg between the bodies `uppers` and `lowers`, one each a leg."""
    bottom = (0.0, 0.0, -rod.length)
    for leg, azimuth in enumerate(azimuths(skeleton)):
        upper, lower = skeleton.elbow[leg].tolist(), skeleton.platform[leg].tolist()
        out = minus(upper, lower)
        tilt, frame = hanging(azimuth, upper, out)
        for side, y in (("a", rod.half_spacing), ("b", -rod.half_spacing)):
            name = f"rod{leg + 1}{side}"
            beside = (upper[0] - y * math.sin(azimuth), upper[1] + y * math.cos(azimuth), upper[2])
            draft.body(
                name,
                uppers[leg],
                Frame(beside, frame.wxyz),
                mass=rod.mass,
                inertia=(rod.inertia, rod.inertia, POINT),
                centre=(0.0, 0.0, -rod.centre * rod.length),
            )
            draft.joint(name, f"{name}_swing", (0.0, math.cos(tilt), -math.sin(tilt)))
            draft.joint(name, f"{name}_tilt", (1.0, 0.0, 0.0))
            draft.connect(name, lowers[leg], bottom)


def hanging(azimuth: float, upper: Vector, up: Vector) -> tuple[float, Frame]:
    """Sideways tilt (rad) and frame of a rod that hangs from a point, given the vector from its lower end up."""
    ca, sa = math.cos(azimuth), math.sin(azimuth)
    out, side = up[0] * ca + up[1] * sa, up[1] * ca - up[0] * sa
    swing = math.atan2(out, up[2])
    tilt = -math.atan2(side, math.hypot(out, up[2]))
    cs, ss, ct, st = math.cos(0.5 * swing), math.sin(0.5 * swing), math.cos(0.5 * tilt), math.sin(0.5 * tilt)
    return tilt, Frame(upper, turned(about_z(azimuth), cs * ct, cs * st, ss * ct, -ss * st))
