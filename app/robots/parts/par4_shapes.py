"""Shapes of the Par4: base plate, platform with its two bars, links and belts, and the gripper."""

from __future__ import annotations

import math

from manifold3d import CrossSection

from app.robots.parts.rods import cross_shaft
from app.robots.parts.solids import (
    COARSE,
    FINE,
    Point,
    Solid,
    around,
    at,
    bar,
    bevelled,
    box,
    circle,
    cut,
    disc,
    polygon,
    prism,
    regular,
    ring,
    slot,
    union,
)
from app.robots.parts.stands import SIDE, beam, foot, gusset, profile

PLATE_TOP = -0.030
PLATE = 0.010
BEAM_Z = 0.105

BAR_HALF = 0.0065
LINK = (-0.0155, -0.0085)
WHEEL = (-0.0325, -0.0165)
"""Heights of the platform's layers, from the plane of the rod joints."""


def base_plate(R: float) -> Solid:
    """An octagonal plate whose flats face the arms, with windows and a ring for mounting."""
    apothem = R - 0.022
    outline = regular(8, apothem, 0.0)
    plate = bevelled(outline, PLATE_TOP - PLATE, PLATE_TOP, 0.0015)
    inner, outer = 0.46 * apothem, 0.70 * apothem
    wedge = _window(inner, outer, 52.0)
    windows = around(prism(wedge, PLATE_TOP - 2 * PLATE, PLATE_TOP + PLATE), 4)
    bore = disc(0.17 * apothem, PLATE_TOP - 2 * PLATE, PLATE_TOP + PLATE, 0.0, FINE)
    rim = ring(0.40 * apothem, 0.22 * apothem, PLATE_TOP - 0.001, PLATE_TOP + 0.006, 0.0012, FINE)
    return cut(union(plate, rim), windows, bore)


def _window(inner: float, outer: float, opening: float) -> CrossSection:
    """A rounded piece of a ring about +x, `opening` degrees wide."""
    half = math.radians(0.5 * opening)
    steps = 8
    angles = [half * (2 * k / steps - 1) for k in range(steps + 1)]
    points: list[Point] = [(outer * math.cos(a), outer * math.sin(a)) for a in angles]
    points += [(inner * math.cos(a), inner * math.sin(a)) for a in reversed(angles)]
    return polygon(points).offset(-0.006).offset(0.006, circular_segments=16)


def base_pillars(R: float) -> Solid:
    """Four pillars that carry the plate under the stand's beam, with the bolts of the ring."""
    radius = 0.31 * (R - 0.022)
    pillar = disc(0.009, PLATE_TOP, BEAM_Z - 0.5 * SIDE - 0.010, 0.0012, 16).translate((radius, 0.0, 0.0))
    screw = disc(0.0032, PLATE_TOP + 0.005, PLATE_TOP + 0.0095, 0.0006, COARSE).translate((radius, 0.0, 0.0))
    return around(pillar, 4, 45.0) + around(screw, 4, 0.0)


def hanger(R: float) -> Solid:
    """The plate between pillars and beam."""
    radius = 0.40 * (R - 0.022)
    top = BEAM_Z - 0.5 * SIDE
    return bevelled(regular(8, radius, 22.5), top - 0.010, top, 0.0012)


def stand(reach: float, floor: float) -> Solid:
    """A portal: the beam along y from which the base hangs, two posts and their feet."""
    post, top = reach + 0.5 * SIDE, BEAM_Z + 0.5 * SIDE
    feet_z, half = floor + 0.022 + 0.5 * SIDE, 0.30
    pieces = [beam((0.0, -reach), (0.0, reach), BEAM_Z)]
    for y in (-post, post):
        pieces.append(profile(feet_z + 0.5 * SIDE, top).translate((0.0, y, 0.0)))
        pieces.append(beam((-half, y), (half, y), feet_z))
    return union(*pieces)


def stand_fittings(reach: float, floor: float) -> Solid:
    """Corner brackets and feet of the portal."""
    post, feet_z, half = reach + 0.5 * SIDE, floor + 0.022 + SIDE, 0.30
    inner = gusset(0.06).rotate((0.0, 0.0, 90.0))
    under_beam = inner.mirror((0.0, 0.0, 1.0)).translate((0.0, -reach, BEAM_Z - 0.5 * SIDE))
    pieces = [under_beam, under_beam.mirror((0.0, 1.0, 0.0))]
    for y in (-post, post):
        corner = gusset(0.06).translate((0.5 * SIDE, y, feet_z))
        pieces += [corner, corner.mirror((1.0, 0.0, 0.0))]
        pieces += [foot(floor).translate((x, y, 0.0)) for x in (-half + 0.03, half - 0.03)]
    return union(*pieces)


def platform_bar(d: float, d_i: float, h_i: float) -> Solid:
    """Bar of legs 3 and 4 about the middle between its pivots; that of legs 1 and 2 is the same, turned about."""
    z0, z1 = -BAR_HALF, BAR_HALF
    pivot, joint = 0.5 * d, (0.5 * d + d_i, -h_i)
    beam_ = bar((-pivot, 0.0), (pivot, 0.0), z0, z1, 0.0085, 0.001)
    arms = [bar((s * pivot, 0.0), (s * joint[0], joint[1]), z0, z1, 0.0095, 0.001, 0.0078) for s in (-1.0, 1.0)]
    boss = disc(0.0125, z0, z1 + 0.002, 0.001)
    body = union(beam_, *arms, boss)
    span = pivot - 0.030
    if span < 0.006:
        return body
    pocket = prism(slot((pivot - 0.014, 0.0), (0.018, 0.0), 0.0045), z1 - 0.004, z1 + 0.01)
    return cut(body, pocket, pocket.mirror((1.0, 0.0, 0.0)))


def platform_studs(d: float, d_i: float, h_i: float, half_spacing: float, ball_radius: float,
                   azimuth_left: float, azimuth_right: float) -> Solid:
    """Ball studs of one bar for the rods of its two legs, and the pins of its pivots."""
    x = 0.5 * d + d_i
    shaft = cross_shaft(half_spacing, ball_radius)
    pin = disc(0.0034, LINK[0] - 0.0015, BAR_HALF + 0.0022, 0.0006, COARSE)
    return union(
        shaft.rotate((0.0, 0.0, math.degrees(azimuth_left))).translate((-x, -h_i, 0.0)),
        shaft.rotate((0.0, 0.0, math.degrees(azimuth_right))).translate((x, -h_i, 0.0)),
        at(pin, [(-0.5 * d, 0.0, 0.0), (0.5 * d, 0.0, 0.0)]),
    )


def platform_link(h: float) -> Solid:
    """A link from its pivot in the bar of legs 3 and 4 (the origin) to the other bar, h away along +y."""
    z0, z1 = LINK
    body = bar((0.0, 0.0), (0.0, h), z0, z1, 0.0085, 0.0008, 0.0078)
    if h < 0.04:
        return body
    return cut(body, prism(slot((0.0, 0.018), (0.0, h - 0.014), 0.0042), z0 - 0.01, z1 + 0.01))


def belt_wheel(radius: float) -> Solid:
    """The double wheel fixed to a link: one track for each belt."""
    z0, z1 = WHEEL
    middle = 0.5 * (z0 + z1)
    r, rim = radius, radius + 0.0022
    return union(
        disc(r, z0, z1, 0.0, FINE),
        *(disc(rim, z, z + 0.0014, 0.0004, FINE) for z in (z0, middle - 0.0007, z1 - 0.0014)),
        disc(0.006, z1 - 0.001, LINK[0], 0.0, COARSE),
    )


def belts(d: float, radius: float) -> Solid:
    """The two belts from the wheels of the links to the spindle at the origin."""
    z0, z1 = WHEEL
    quarter = 0.25 * (z1 - z0)
    pieces = []
    for side, z in ((1.0, z1 - quarter), (-1.0, z0 + quarter)):
        outer = slot((side * 0.5 * d, 0.0), (0.0, 0.0), radius + 0.0014, 0.5 * radius + 0.0014)
        inner = slot((side * 0.5 * d, 0.0), (0.0, 0.0), radius, 0.5 * radius)
        pieces.append(prism(outer - inner, z - 0.0026, z + 0.0026))
    return union(*pieces)


def spindle(radius: float, P_z: float, grip: float) -> Solid:
    """The tool's shaft through the bar with its double belt wheel, half as large as those of the links."""
    low, high = P_z + WHEEL[0], P_z + WHEEL[1]
    middle, r = 0.5 * (low + high), 0.5 * radius
    return union(
        disc(0.0042, min(low, grip), P_z + BAR_HALF + 0.006, 0.0006, 16),
        disc(0.0075, P_z + BAR_HALF + 0.002, P_z + BAR_HALF + 0.0045, 0.0005),
        disc(r, low, high),
        *(disc(r + 0.0022, z, z + 0.0014, 0.0004) for z in (low, middle - 0.0007, high - 0.0014)),
    )


def gripper_body(height: float) -> Solid:
    """The gripper's housing, its jaws along x, tips at the origin."""
    top, low = height, 0.55 * height
    return union(
        box((0.046, 0.018, top - low), (0.0, 0.0, 0.5 * (top + low)), 0.0016),
        disc(0.0105, top - 0.001, top + 0.003, 0.0008),
    )


def gripper_jaws(height: float) -> Solid:
    """Two fingers with a step, closing along x."""
    low = 0.55 * height
    carriage = box((0.010, 0.013, 0.006), (0.014, 0.0, low - 0.003), 0.0008)
    finger = box((0.0045, 0.010, low - 0.001), (0.0115, 0.0, 0.5 * low + 0.0005), 0.0007)
    jaw = union(carriage, finger)
    return jaw + jaw.mirror((1.0, 0.0, 0.0))


def gripper_pads(height: float) -> Solid:
    """Rubber pads inside the fingers' tips, and a bead that shows which way the tool is turned."""
    pad = box((0.0022, 0.009, 0.009), (0.0085, 0.0, 0.0045), 0.0004)
    return pad + pad.mirror((1.0, 0.0, 0.0))


def gripper_mark(height: float) -> Solid:
    """A mark on one side of the gripper: it shows the tool's turn."""
    low = 0.55 * height
    return box((0.010, 0.0008, 0.4 * (height - low)), (0.014, 0.0091, 0.5 * (height + low)), 0.0)


def needle(P_z: float) -> Solid:
    """A plain tip from the wheels to the tool point, where there is no room for a gripper."""
    start = P_z + WHEEL[0]
    if abs(start) < 0.004:
        return disc(0.003, start - 0.001, start + 0.003)
    cone = Solid.cylinder(abs(start), 0.0008, 0.004, 16)
    return cone if start > 0.0 else cone.mirror((0.0, 0.0, 1.0))


__all__ = [name for name in dir() if not name.startswith("_")]
