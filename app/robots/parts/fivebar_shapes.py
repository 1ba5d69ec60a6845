"""Shapes of the five-bar: pedestal with its motors, hollow links with their belts, screw spline and nuts.

Heights are counted from the plane of the links. Links lie along x, joints at (0, 0) and (length, 0). Leg 1
carries its distal link on top and leg 2 below: leg 2's pieces are those of leg 1 turned over.
"""

from __future__ import annotations

import math

import numpy as np
from manifold3d import CrossSection, Mesh64

from app.robots.parts.belts import FLANGE, belt
from app.robots.parts.solids import (
    FINE,
    Point,
    Solid,
    Solids,
    bevelled,
    both_sides,
    box,
    circle,
    disc,
    grown,
    hull,
    lathe,
    polygon,
    prism,
    ring,
    slot,
)

PROXIMAL = 0.015
"""Half the height of a proximal link."""
DISTAL = (0.0165, 0.0405)
"""Heights of leg 1's distal link."""
INNER_WHEEL = (-0.0290, -0.0180)
OUTER_WHEEL = (0.0435, 0.0545)
"""Heights of leg 1's belt wheels: on the motor and on the elbow's inner end, on its outer end and on the nut."""
WHEEL_RADIUS = 0.016
SHAFT_RADIUS = 0.0075
NUT_RADIUS = 0.0125
GEARBOX_TOP = -0.032


def proximal_link(length: float, wide: float) -> Solids:
    """A hollow driven link, `wide` around the motor's axis, with thin skins that are open in the middle."""
    h, narrow = PROXIMAL, min(0.024, wide)
    outline = slot((0.0, 0.0), (length, 0.0), wide, narrow)
    cavity = slot((0.0, 0.0), (length, 0.0), wide - 0.0045, narrow - 0.0045)
    start, end = wide + 0.012, length - narrow - 0.010
    opening = slot((start, 0.0), (end, 0.0), 0.5 * wide, 0.44 * narrow)
    skin = grown(cavity, 0.0005) - opening - circle(0.0105, (length, 0.0))
    return [
        prism(outline - cavity, -h, h),
        prism(skin, h - 0.004, h),
        prism(skin, -h, 0.004 - h),
        disc(0.65 * wide, -h - 0.0015, h + 0.0015, 0.001, FINE),
        ring(0.0185, 0.0100, -h - 0.0012, h + 0.0012, 0.0008).translate((length, 0.0, 0.0)),
    ]


def distal_tube(length: float) -> Solids:
    """The hollow carbon profile of a distal link, its belt, the pin of the elbow and the nut at the tool's axis:
    all that is black."""
    z0, z1 = DISTAL
    side = 0.5 * (z1 - z0) - 0.0015
    square = polygon([(-side, -side), (side, -side), (side, side), (-side, side)])
    tube = prism(grown(square, 0.001) - grown(square, -0.0018), 0.020, length - 0.018)
    belt_z = (OUTER_WHEEL[0] + 0.0018, OUTER_WHEEL[1] - 0.0018)
    loop = belt((0.0, 0.0), WHEEL_RADIUS, (length, 0.0), WHEEL_RADIUS, *belt_z)
    nut = [piece.translate((length, 0.0, 0.0)) for piece in _nut()]
    return [tube.rotate((0.0, 90.0, 0.0)).translate((0.0, 0.0, 0.5 * (z0 + z1))), loop, *_elbow_pin(), *nut]


def _elbow_pin() -> Solids:
    """The pin through an elbow with its caps; belts and wheels of both links run on it."""
    low, high = INNER_WHEEL[0] - 0.003, OUTER_WHEEL[1] + 0.003
    return [
        disc(SHAFT_RADIUS, low, high, 0.001),
        disc(0.0105, low - 0.001, low + 0.0025, 0.0008),
        disc(0.0105, high - 0.0025, high + 0.001, 0.0008),
    ]


def _nut() -> Solids:
    """One of the two nuts around the shaft, with its flange outside the wheel. It looks the same turned."""
    bore = SHAFT_RADIUS + 0.0003
    return [
        ring(NUT_RADIUS, bore, 0.0003, OUTER_WHEEL[0] + 0.001, 0.0),
        ring(0.0118, bore, OUTER_WHEEL[1] - 0.001, OUTER_WHEEL[1] + 0.008, 0.001),
    ]


def distal_ends(length: float) -> Solids:
    """The bearing housings at the elbow and at the tool's axis, with sockets for the tube."""
    z0, z1 = DISTAL
    middle, high = 0.5 * (z0 + z1), z1 - z0
    elbow = disc(0.0235, z0, z1, 0.0015, FINE)
    carrier = ring(0.0230, NUT_RADIUS + 0.0005, z0, z1, 0.0015, FINE).translate((length, 0.0, 0.0))
    socket = box((0.030, high + 0.001, high - 0.0005), (0.034, 0.0, middle), 0.0015)
    return [elbow, carrier, socket, socket.translate((length - 0.068, 0.0, 0.0))]


def proximal_belt(length: float) -> Solid:
    """The belt along a proximal link, from the motor's axis to the elbow."""
    z0, z1 = INNER_WHEEL
    return belt((0.0, 0.0), WHEEL_RADIUS, (length, 0.0), WHEEL_RADIUS, z0 + 0.0018, z1 - 0.0018)


def belt_wheel() -> Solids:
    """A wheel with spokes, its lower side at height 0; the three holes show how it turns."""
    height = INNER_WHEEL[1] - INNER_WHEEL[0]
    r, bore = WHEEL_RADIUS, SHAFT_RADIUS + 0.0004
    web = circle(r - 0.0015, segments=FINE) - circle(bore)
    for k in range(3):
        a = 2.0 * math.pi * k / 3
        web -= circle(0.0024, (0.0112 * math.cos(a), 0.0112 * math.sin(a)), 10)
    thin, inside, outside = 0.0013, r - 0.0022, r + FLANGE
    half = [(inside, 0.0), (outside, 0.0), (outside, thin), (r, thin)]
    rim = lathe([*half, *((x, height - z) for x, z in reversed(half))], FINE)
    return [rim, prism(web, 0.001, height - 0.001)]


def shaft(low: float, high: float) -> Solid:
    """The shaft of screw and spline."""
    return disc(SHAFT_RADIUS, low, high, 0.0008)


def screw_groove(low: float, high: float, lead: float) -> Solid:
    """The ball screw's groove as a dark band on the shaft: right-handed, one turn each `lead`.

    A band of three edges, two a little outside of the shaft and one inside, so that it is closed.
    """
    band = min(0.2 * lead, 0.004)
    turns = (high - low - band) / lead
    steps = max(8, min(320, round(12 * turns)))
    angle = np.linspace(0.0, 2.0 * math.pi * turns, steps + 1)
    middle = low + 0.5 * band + lead * angle / (2.0 * math.pi)
    edges = []
    for radius, shift in ((SHAFT_RADIUS + 0.0004, -0.5), (SHAFT_RADIUS + 0.0004, 0.5), (0.8 * SHAFT_RADIUS, 0.0)):
        edges.append(np.column_stack([radius * np.cos(angle), radius * np.sin(angle), middle + shift * band]))
    vertices = np.stack(edges, axis=1).reshape(-1, 3)
    first = 3 * np.arange(steps)[:, None]
    sides = [(a, b, b + 3, a, b + 3, a + 3) for a, b in ((1, 0), (2, 1), (0, 2))]
    faces = np.concatenate([first + np.array(side) for side in sides]).reshape(-1, 3)
    caps = [(0, 1, 2), (3 * steps + 2, 3 * steps + 1, 3 * steps)]
    return Solid(Mesh64(vertices, np.vstack([faces, caps]).astype(np.uint64)))


def shaft_stops(low: float, high: float) -> Solids:
    """The collar on the shaft's upper end and the flange above the gripper."""
    return [
        disc(0.0105, high - 0.006, high + 0.002, 0.0012),
        disc(0.0120, low, low + 0.008, 0.0012),
    ]


def pedestal(half: float, radius: float, floor: float) -> Solids:
    """The cast body: a column behind the motors and the head that holds both gearboxes.

    Args:
        half: half the distance between the motors.
        radius: of the gearboxes.
        floor: height.
    """
    z1, z0, back = GEARBOX_TOP - 0.010, GEARBOX_TOP - 0.052, _behind(radius)
    column = bevelled(_rounded(half + 0.2 * radius, 0.036, (0.0, back)), floor + 0.010, z1 - 0.004, 0.002)
    collar = ring(radius + 0.007, radius - 0.001, z0, z1, 0.0, FINE)
    rear = disc(0.6 * radius, z0 + 0.006, z1 - 0.006).translate((0.4 * radius, back + 0.012, 0.0))
    front = box((0.9 * radius, 0.006, z1 - z0 - 0.006), (0.0, -radius - 0.002, 0.5 * (z0 + z1)))
    side = [piece.translate((half, 0.0, 0.0)) for piece in (collar, hull(rear, front))]
    bridge = box((2.0 * half, 0.022, 0.026), (0.0, -0.45 * radius, 0.5 * (z0 + z1)), 0.002)
    return [column, bridge, *(piece for solid in side for piece in both_sides(solid))]


def foot_plate(half: float, radius: float, floor: float) -> Solid:
    """The pedestal's wide foot."""
    outline = _rounded(half + 0.2 * radius + 0.045, 0.090, (0.0, _behind(radius) + 0.010))
    return bevelled(outline, floor, floor + 0.014, 0.003)


def _behind(radius: float) -> float:
    """y of the column's middle."""
    return -radius - 0.060


def _rounded(half_width: float, half_depth: float, centre: Point) -> CrossSection:
    """A rectangle with large round corners."""
    r = 0.8 * min(half_width, half_depth)
    x, y = half_width - r, half_depth - r
    corners = [(centre[0] + sx * x, centre[1] + sy * y) for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    return CrossSection.batch_hull([circle(r, c, FINE) for c in corners])


def gearboxes(half: float, radius: float) -> Solids:
    """Both gearboxes with the output flanges under the links."""
    low, top = GEARBOX_TOP - 0.058, GEARBOX_TOP
    body = lathe(
        [
            (0.0, low),
            (radius - 0.003, low),
            (radius, low + 0.003),
            (radius, top - 0.006),
            (0.86 * radius, top - 0.004),
            (0.86 * radius, top),
            (0.0, top),
        ],
        FINE,
    )
    left, right = (disc(0.0095, top - 0.001, high, 0.001) for high in (PROXIMAL + 0.004, 0.003 - INNER_WHEEL[0]))
    pieces = [(-half, body), (-half, left), (half, body), (half, right)]
    return [piece.translate((x, 0.0, 0.0)) for x, piece in pieces]


def motor(radius: float, low: float) -> Solids:
    """Under a gearbox the arm's motor with its cooling ribs, and under that the nut's motor, down to `low`."""
    top = GEARBOX_TOP - 0.058
    height = top - low
    split, r, small = top - 0.60 * height, 0.86 * radius, 0.60 * radius
    profile: list[Point] = [
        (0.0, low),
        (small - 0.002, low),
        (small, low + 0.002),
        (small, split - 0.004),
        (r - 0.003, split - 0.004),
        (r, split),
    ]
    ribs = 3
    pitch = (top - 0.006 - split) / ribs
    for k in range(ribs):
        z = split + 0.003 + k * pitch
        profile += [(r, z), (0.92 * r, z + 0.001), (0.92 * r, z + 0.45 * pitch), (r, z + 0.45 * pitch + 0.001)]
    return [
        lathe([*profile, (r, top), (0.0, top)], FINE),
        box((0.022, 0.014, 0.018), (0.0, -0.94 * r, split + 0.5 * (top - split)), 0.0015),
        box((0.016, 0.012, 0.014), (0.0, -small, low + 0.5 * (split - low)), 0.0015),
    ]
