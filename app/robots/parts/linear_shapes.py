"""Shapes of the linear delta: three belt axes between two plates, carriages, platform.

An axis stands in the frame of its carriage at displacement 0: origin in the middle of the rod joints, x outward,
y along the hinge. Plates and platform stand in the base frame and in that of the platform's joints.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from manifold3d import CrossSection

from app.robots.parts.belts import belt, wheel
from app.robots.parts.rods import cross_shaft
from app.robots.parts.solids import (
    COARSE,
    Point,
    Solid,
    Solids,
    at,
    bar,
    bevelled,
    box,
    circle,
    cut,
    disc,
    grown,
    lathe,
    moved,
    prism,
    ring,
)
from app.robots.parts.stands import feet, profile

RAIL = 0.034
"""Distance of the guide rail's face from the rod joints."""
SIDE = 0.032
"""Side of the column behind it."""
COLUMN = RAIL + 0.010 + 0.5 * SIDE
CARRIAGE_HALF = 0.032
PULLEY = 0.009
BELT_Y = -0.029
PLATE = 0.012


def column(top: float, low: float) -> Solid:
    """The upright profile."""
    return profile(low, top, SIDE).translate((COLUMN, 0.0, 0.0))


def guide_rail(top: float, low: float) -> Solids:
    """The steel rail on the column's inner face, and the wheels of the belt."""
    rail = box((0.010, 0.015, top - low - 0.06), (RAIL + 0.005, 0.0, 0.5 * (top + low)), 0.001)
    pulley = wheel(PULLEY, BELT_Y - 0.006, BELT_Y + 0.006, segments=18).rotate((-90.0, 0.0, 0.0))
    return [rail, *at(pulley, [(RAIL + 0.006, 0.0, z) for z in _pulley_heights(top, low)])]


def drive_belt(top: float, low: float) -> Solid:
    """The toothed belt beside the rail."""
    high_z, low_z = _pulley_heights(top, low)
    loop = belt((-high_z, 0.0), PULLEY, (-low_z, 0.0), PULLEY, -0.0045, 0.0045)
    return loop.rotate((0.0, 90.0, 0.0)).rotate((0.0, 0.0, 90.0)).translate((RAIL + 0.006, BELT_Y, 0.0))


def _pulley_heights(top: float, low: float) -> Point:
    return top - 0.030, low + 0.030


def axis_ends(top: float, low: float) -> Solids:
    """Bearing brackets at both ends of the belt: a cheek beside the wheel, fixed to the column's side."""
    cheek = box((0.046, 0.007, 0.042), (RAIL + 0.014, BELT_Y - 0.0105, 0.0), 0.001)
    web = box((0.014, 0.030, 0.042), (RAIL + 0.030, BELT_Y + 0.0010, 0.0), 0.001)
    return at(cheek, [(0.0, 0.0, z) for z in _pulley_heights(top, low)]) + at(
        web, [(0.0, 0.0, z) for z in _pulley_heights(top, low)]
    )


def axis_motor(top: float, low: float) -> Solids:
    """The geared motor beside the upper end of the belt."""
    z, start = _pulley_heights(top, low)[0], -(BELT_Y - 0.016)
    half = 0.020
    square = CrossSection.square((2.0 * half, 2.0 * half), True)
    flange = bevelled(square, start, start + 0.020, 0.0015)
    r, end = 0.0185, start + 0.070
    can = lathe(
        [
            (0.0, start),
            (r, start),
            (r, end - 0.013),
            (r - 0.0014, end - 0.0125),
            (r - 0.0014, end - 0.0112),
            (r - 0.0003, end - 0.0106),
            (r - 0.0003, end - 0.002),
            (r - 0.0025, end),
            (0.0, end),
        ]
    )
    plug = box((0.010, 0.010, 0.012), (r + 0.001, 0.0, end - 0.007), 0.001)
    return [piece.rotate((90.0, 0.0, 0.0)).translate((RAIL + 0.006, 0.0, z)) for piece in (flange, can, plug)]


def carriage(half_spacing: float, ball_radius: float) -> Solids:
    """A block on the rail, its arm to the rod joints with their cross shaft, and the belt's clamp."""
    half = CARRIAGE_HALF
    block = box((0.016, 0.046, 2.0 * half), (RAIL - 0.004, 0.0, 0.0), 0.0018)
    cheek = half_spacing - 1.15 * ball_radius
    knuckle = bar((0.0, 0.0), (RAIL - 0.008, 0.0), -cheek, cheek, 0.0095, 0.001, 0.019).rotate((-90.0, 0.0, 0.0))
    clamp = box((0.012, 0.016, 0.026), (RAIL - 0.0035, BELT_Y + 0.001, 0.0), 0.001)
    return [block, knuckle, clamp, cross_shaft(half_spacing, ball_radius)]


def carriage_shoes() -> Solids:
    """The two recirculating shoes between block and rail, with their end seals."""
    shoe = box((0.013, 0.030, 0.024), (RAIL + 0.0055, 0.0, 0.0), 0.001)
    screw = disc(0.0024, 0.0, 0.0025, 0.0006, COARSE).rotate((0.0, -90.0, 0.0)).translate((RAIL - 0.0115, 0.0, 0.0))
    corners = [(0.0, s * 0.017, z) for s in (-1.0, 1.0) for z in (-0.026, 0.026)]
    return [*at(shoe, [(0.0, 0.0, -0.0175), (0.0, 0.0, 0.0175)]), *at(screw, corners)]


def end_plate(columns: Sequence[Point], z0: float, z1: float, opened: bool) -> Solid:
    """A plate around all columns, with a large opening or without."""
    outline = CrossSection.batch_hull([circle(0.046, c) for c in columns])
    inner = grown(outline, -0.100)
    plate = bevelled(outline, z0, z1, 0.0015)
    return cut(plate, prism(inner, z0 - 0.01, z1 + 0.01)) if opened and not inner.is_empty() else plate


def stand_feet(columns: Sequence[Point], floor: float) -> Solids:
    """Levelling feet outside the columns."""
    spread = [(x * 1.06, y * 1.06) for x, y in columns]
    return feet(floor, spread)


def platform_plate(
    corners: Sequence[Point], hinges: Sequence[float], half_spacing: float, ball_radius: float
) -> Solids:
    """A hub with one point a leg, and the ball studs of the rods.

    Args:
        corners: (x, y) of the rod joints.
        hinges: azimuth of each leg.
    """
    z0, z1 = -0.0055, 0.0055
    pieces: Solids = [ring(0.030, 0.0125, z0, z1 + 0.002, 0.0012)]
    shaft = cross_shaft(half_spacing, ball_radius)
    for (x, y), azimuth in zip(corners, hinges, strict=True):
        reach = math.hypot(x, y)
        start = (x * 0.024 / reach, y * 0.024 / reach)
        point = bar(start, (x, y), z0, z1, 0.0135, 0.001, 0.0075)
        hole = prism(_slot_between(start, (x, y)), z0 - 0.01, z1 + 0.01)
        pieces += [cut(point, hole) if reach > 0.06 else point]
        pieces += moved([shaft], (x, y, 0.0), math.degrees(azimuth))
    return pieces


def _slot_between(start: Point, end: Point) -> CrossSection:
    """A tapered opening along the middle of a point of the platform."""

    def along(t: float) -> Point:
        return start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])

    return CrossSection.batch_hull([circle(0.0068, along(0.34), 12), circle(0.0040, along(0.72), 12)])


def tool_flange() -> Solids:
    """The tool's socket in the hub."""
    return [disc(0.0135, -0.010, 0.012, 0.0012), disc(0.0065, 0.011, 0.030, 0.001, 14)]
