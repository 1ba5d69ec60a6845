"""Shapes of the drawing delta: a three-cornered base on a tripod, and the platform with its pen.

The base stands in the frame of the motor axes' plane, the platform in that of the rod joints' plane.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.parts.rods import cross_shaft
from app.robots.parts.solids import (
    COARSE,
    Solid,
    Solids,
    around,
    bar,
    bevelled,
    box,
    circle,
    cut,
    disc,
    moved,
    prism,
    regular,
    ring,
    slot,
)
from app.robots.parts.stands import FOOT_HEIGHT, beam, feet

PLATE_TOP, PLATE = -0.030, 0.008
SIDE = 0.030
"""Side of the tripod's profiles."""
POSTS = (90.0, 210.0, 330.0)
"""Directions of the posts, between the arms."""
STAR_HALF = 0.0055
HOLDER_TOP = 0.050


def base_plate(rb: float) -> Solid:
    """A triangle whose sides face the arms, its corners cut off where the spokes leave."""
    apothem = rb - 0.022
    outline = regular(3, apothem, -90.0) ^ regular(3, 1.45 * apothem, 90.0)
    plate = bevelled(outline, PLATE_TOP - PLATE, PLATE_TOP, 0.0012)
    low, high = PLATE_TOP - 2 * PLATE, PLATE_TOP + PLATE
    window = prism(slot((0.55 * apothem, 0.0), (0.82 * apothem, 0.0), 0.16 * apothem, 0.11 * apothem), low, high)
    return cut(plate, prism(circle(0.24 * apothem), low, high), *around(window, 3, POSTS[0]))


def base_box(rb: float) -> Solids:
    """The controller's box on the base plate, with its plug and lamp ring."""
    size = 0.62 * (rb - 0.022)
    top = PLATE_TOP + 0.032
    return [
        bevelled(regular(6, 0.75 * size), PLATE_TOP + 0.002, top, 0.003),
        ring(0.42 * size, 0.30 * size, top - 0.001, top + 0.003, 0.0008),
    ]


def spokes(radius: float) -> Solids:
    """Three profiles under the base plate that lead to the posts.

    Args:
        radius: of the circle on which the posts stand.
    """
    return around(beam((0.014, 0.0), (radius + 0.016, 0.0), PLATE_TOP - PLATE - 0.5 * SIDE, SIDE), 3, POSTS[0])


def posts(radius: float, floor: float) -> Solids:
    """Three slim round posts: they hide little of the robot.

    Args:
        radius: of the circle on which they stand.
        floor: height.
    """
    top = PLATE_TOP - PLATE
    post = disc(0.009, floor + FOOT_HEIGHT - 0.002, top - SIDE + 0.001, 0.0).translate((radius, 0.0, 0.0))
    return around(post, 3, POSTS[0])


def stand_fittings(radius: float, floor: float) -> Solids:
    """Clamps between posts and spokes, end caps and feet."""
    top = PLATE_TOP - PLATE
    clamp = disc(0.0145, -SIDE - 0.030, -SIDE, 0.0015)
    cap = box((0.004, SIDE, SIDE), (radius + 0.018, 0.0, top - 0.5 * SIDE), 0.001)
    pieces = [clamp.translate((radius, 0.0, top)), cap, *feet(floor, [(radius, 0.0)])]
    return [piece for turn in POSTS for piece in moved(pieces, turn=turn)]


def platform_star(rp: float, half_spacing: float, ball_radius: float, azimuths: Sequence[float]) -> Solids:
    """A star with one point a leg, and the ball studs of the rods."""
    z0, z1 = -STAR_HALF, STAR_HALF
    hub = ring(0.0165, 0.0090, z0, z1 + 0.003, 0.001)
    shaft = cross_shaft(half_spacing, ball_radius).translate((rp, 0.0, 0.0))
    point = bar((0.0135, 0.0), (max(rp, 0.0136), 0.0), z0, z1, 0.0088, 0.001, 0.0068)
    return [hub, *(piece for a in azimuths for piece in moved([point, shaft], turn=math.degrees(a)))]


def pen_clamp() -> Solids:
    """The sleeve that holds the pen above the star, with a split and two screws."""
    sleeve = ring(0.0105, 0.0050, -0.006, HOLDER_TOP, 0.0008)
    ears = box((0.016, 0.010, 0.014), (0.014, 0.0, HOLDER_TOP - 0.012), 0.001)
    screw = disc(0.0028, -0.0085, 0.0085, 0.0006, COARSE).rotate((90.0, 0.0, 0.0))
    return [sleeve, ears, screw.translate((0.0165, 0.0, HOLDER_TOP - 0.012))]
