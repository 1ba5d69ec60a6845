"""Shapes of the Par4: its base on a stand, and the articulated platform.

The base stands in the frame of the motor axes' plane, the platform's pieces in that of the rod joints' plane.
"""

from __future__ import annotations

import math

from app.robots.parts.belts import belt, wheel
from app.robots.parts.rods import cross_shaft
from app.robots.parts.solids import (
    COARSE,
    FINE,
    Point,
    Solid,
    Solids,
    around,
    at,
    bar,
    bevelled,
    cut,
    disc,
    grown,
    moved,
    polygon,
    prism,
    regular,
    ring,
    slot,
)
from app.robots.parts.stands import FOOT_HEIGHT, beam, feet, gusset, profile, strut

PLATE_TOP, PLATE = -0.030, 0.010
BEAM_Z = 0.100
HEAVY, LIGHT = 0.040, 0.030
"""Sides of the stand's profiles."""

BAR_HALF = 0.0065
LINK = (-0.0155, -0.0085)
WHEEL = (-0.0325, -0.0165)
"""Heights of the platform's layers."""


def base_plate(R: float) -> Solids:
    """An octagonal plate whose flats face the arms, with windows and a raised ring for mounting."""
    apothem = R - 0.022
    plate = bevelled(regular(8, apothem), PLATE_TOP - PLATE, PLATE_TOP, 0.0015)
    window = _window(0.47 * apothem, 0.72 * apothem, 50.0)
    rim = ring(0.40 * apothem, 0.22 * apothem, PLATE_TOP - 0.001, PLATE_TOP + 0.006, 0.0012, FINE)
    bore = disc(0.17 * apothem, PLATE_TOP - 2 * PLATE, PLATE_TOP + PLATE, 0.0)
    return [cut(plate, *around(window, 4), bore), rim]


def _window(inner: float, outer: float, opening: float) -> Solid:
    """A rounded piece of a ring about +x, `opening` degrees wide, to be cut through the plate."""
    half, steps = math.radians(0.5 * opening), 6
    angles = [half * (2 * k / steps - 1) for k in range(steps + 1)]
    points: list[Point] = [(outer * math.cos(a), outer * math.sin(a)) for a in angles]
    points += [(inner * math.cos(a), inner * math.sin(a)) for a in reversed(angles)]
    radius = 0.2 * (outer - inner)
    outline = grown(grown(polygon(points), -radius), radius)
    return prism(outline, PLATE_TOP - 2 * PLATE, PLATE_TOP + PLATE)


def base_pillars(R: float) -> Solids:
    """Four pillars between the plate's ring and the hanger, and the bolts of the ring."""
    radius = 0.31 * (R - 0.022)
    pillar = disc(min(0.009, 0.25 * radius), PLATE_TOP, BEAM_Z - 0.5 * HEAVY - 0.008, 0.0, 14)
    screw = disc(0.0034, PLATE_TOP + 0.005, PLATE_TOP + 0.0098, 0.0008, COARSE)
    return [
        *around(pillar.translate((radius, 0.0, 0.0)), 4, 45.0),
        *around(screw.translate((radius, 0.0, 0.0)), 4),
    ]


def base_hanger(R: float) -> Solid:
    """The plate between pillars and beam."""
    top = BEAM_Z - 0.5 * HEAVY
    return bevelled(regular(8, 0.42 * (R - 0.022), 22.5), top - 0.010, top, 0.0012)


def stand(distance: float, floor: float) -> Solids:
    """A gallows behind the robot: post, beam over the base, brace and a T of feet.

    Args:
        distance: of the post from the axis, along +y.
        floor: height.
    """
    feet_z, half, front = floor + FOOT_HEIGHT + 0.5 * HEAVY, 0.28, -0.24
    under = BEAM_Z - 0.5 * HEAVY
    return [
        beam((0.0, -0.07), (0.0, distance - 0.5 * HEAVY), BEAM_Z, HEAVY),
        profile(feet_z + 0.5 * HEAVY, BEAM_Z + 0.5 * HEAVY, HEAVY).translate((0.0, distance, 0.0)),
        strut((distance - 0.4 * HEAVY, under - 0.16), (distance - 0.5 * HEAVY - 0.16, under + 0.005), LIGHT),
        beam((-half, distance), (half, distance), feet_z, HEAVY),
        beam((0.0, front), (0.0, distance - 0.5 * HEAVY), feet_z, HEAVY),
        beam((-0.6 * half, front - 0.5 * HEAVY), (0.6 * half, front - 0.5 * HEAVY), feet_z, HEAVY),
    ]


def stand_fittings(distance: float, floor: float) -> Solids:
    """Corner brackets, end caps and feet of the stand."""
    low, half, front = floor + FOOT_HEIGHT + HEAVY, 0.28, -0.24 - 0.5 * HEAVY
    corner = gusset(0.060, 0.026)
    ends = [(-half + 0.03, distance), (half - 0.03, distance), (-0.6 * half + 0.03, front), (0.6 * half - 0.03, front)]
    cap = bevelled(regular(4, 0.5 * HEAVY), 0.0, 0.004, 0.001)
    corners = [
        moved(corner, (0.5 * HEAVY * c, distance + 0.5 * HEAVY * s, low), turn)
        for turn, c, s in ((0.0, 1.0, 0.0), (180.0, -1.0, 0.0), (-90.0, 0.0, -1.0))
    ]
    return [
        *(piece for corner in corners for piece in corner),
        cap.translate((0.0, distance, BEAM_Z + 0.5 * HEAVY)),
        cap.rotate((90.0, 0.0, 0.0)).translate((0.0, -0.07, BEAM_Z)),
        *feet(floor, ends),
    ]


def platform_bar(
    d: float, d_i: float, h_i: float, half_spacing: float, ball_radius: float, azimuths: tuple[float, float]
) -> Solids:
    """Bar of legs 3 and 4 about the middle between its pivots; that of legs 1 and 2 is the same, turned about.

    Args:
        azimuths: of the legs at -x and +x; their ball studs lie across.
    """
    z0, z1 = -BAR_HALF, BAR_HALF
    pivot, x = 0.5 * d, 0.5 * d + d_i
    straight = bar((-pivot, 0.0), (pivot, 0.0), z0, z1, 0.0085, 0.001)
    ends = [bar((s * pivot, 0.0), (s * x, -h_i), z0, z1, 0.0095, 0.001, 0.0078) for s in (-1.0, 1.0)]
    if pivot > 0.038:
        pocket = prism(slot((pivot - 0.014, 0.0), (0.018, 0.0), 0.0045), z1 - 0.004, z1 + 0.01)
        straight = cut(straight, pocket, pocket.mirror((1.0, 0.0, 0.0)))
    shaft = cross_shaft(half_spacing, ball_radius)
    pin = disc(0.0036, LINK[0] - 0.0015, BAR_HALF + 0.0024, 0.0008, COARSE)
    return [
        straight,
        *ends,
        disc(0.0125, z0, z1 + 0.002, 0.001),
        shaft.rotate((0.0, 0.0, math.degrees(azimuths[0]))).translate((-x, -h_i, 0.0)),
        shaft.rotate((0.0, 0.0, math.degrees(azimuths[1]))).translate((x, -h_i, 0.0)),
        *at(pin, [(-pivot, 0.0, 0.0), (pivot, 0.0, 0.0)]),
    ]


def platform_link(h: float, wheel_radius: float) -> Solids:
    """A link from its pivot in the bar of legs 3 and 4 (the origin) to the other bar, h away along +y, with
    the belt wheel that is fixed to it: one track for either belt."""
    z0, z1 = LINK
    body = bar((0.0, 0.0), (0.0, h), z0, z1, 0.0085, 0.0008, 0.0078)
    if h > 0.045:
        body = cut(body, prism(slot((0.0, 0.019), (0.0, h - 0.015), 0.0042), z0 - 0.01, z1 + 0.01))
    hub = disc(0.006, WHEEL[1] - 0.001, z0 + 0.001, 0.0, 14)
    return [body, hub, wheel(wheel_radius, *WHEEL, tracks=2)]


def belts(d: float, wheel_radius: float) -> Solids:
    """The belts from the wheels of both links to the spindle at the origin, each on its own track."""
    z0, z1 = WHEEL
    quarter, small = 0.25 * (z1 - z0), 0.5 * wheel_radius
    tracks = ((1.0, z1 - quarter), (-1.0, z0 + quarter))
    return [belt((s * 0.5 * d, 0.0), wheel_radius, (0.0, 0.0), small, z - 0.0027, z + 0.0027) for s, z in tracks]


def spindle(wheel_radius: float, P_z: float, low: float) -> Solids:
    """The tool's shaft from `low` up through the bar, in the tool's frame, with a belt wheel half as large as
    those of the links."""
    top = P_z + BAR_HALF
    return [
        disc(0.0042, min(low, P_z + WHEEL[0]), top + 0.0075, 0.0008, 14),
        disc(0.0078, top + 0.002, top + 0.005, 0.0008, 14),
        wheel(0.5 * wheel_radius, P_z + WHEEL[0], P_z + WHEEL[1], tracks=2, segments=18),
    ]
