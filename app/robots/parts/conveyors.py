"""Two belts and what rides on them. A conveyor's frame has its origin in the middle of the belt's upper side, y along
the belt; an item's lies in the middle of its upper side, where the tool takes it, and turns with it."""

from __future__ import annotations

from app.robots.parts.solids import (
    COARSE,
    Point,
    Solid,
    Solids,
    along_y,
    at,
    both_sides,
    box,
    disc,
    polygon,
    prism,
    slot,
)
from app.robots.parts.stands import FOOT_HEIGHT, feet, profile

BELT_WIDTH = 0.040
RAIL = 0.006
"""Thickness of the side rails."""
HALF_WIDTH = 0.5 * BELT_WIDTH + RAIL + 0.001
"""Of the whole conveyor."""
DRUM = 0.011
POST = 0.016
ITEM = (0.030, 0.036, 0.026)
"""Width, length and height."""
GRIP_WIDTH = 0.0128
"""Of an item's handle, a little less than the gap between a gripper's pads."""
HOOD = 0.075
"""Length of the hood over the end where items come and go."""


def frame(length: float, height: float, hood_at: float) -> Solids:
    """Side rails, posts with feet, and the drive under the belt.

    Args:
        height: of the belt above the floor.
        hood_at: y of the middle of the hood, which stays clear of posts.
    """
    half, side = 0.5 * length, 0.5 * (BELT_WIDTH + RAIL) + 0.001
    rail = box((RAIL, length - 2.0 * DRUM, 0.020), (side, 0.0, -0.0115), 0.0012)
    low = FOOT_HEIGHT - height
    posts, ends = [], [hood_at + 0.06, half - 0.06]
    for y in ends:
        posts += at(profile(low, -0.018, POST), [(-side + 0.004, y, 0.0), (side - 0.004, y, 0.0)])
        posts.append(box((2.0 * side, 0.010, 0.012), (0.0, y, 0.6 * low), 0.001))
    stands = feet(-height, [(x, y) for x in (-side + 0.004, side - 0.004) for y in ends])
    return [*both_sides(rail), *posts, *stands]


def drive(length: float, height: float) -> Solids:
    """Motor and gearbox under the belt's far end, and the drums' axles."""
    y, room = 0.5 * length - 0.115, min(0.036, height - 0.040)
    axle = disc(0.0035, -HALF_WIDTH - 0.002, HALF_WIDTH + 0.002, 0.0006, COARSE).rotate((0.0, 90.0, 0.0))
    ends = [axle.translate((0.0, sign * (0.5 * length - DRUM), -DRUM)) for sign in (-1.0, 1.0)]
    motor = along_y(disc(0.5 * room, -0.030, 0.030, 0.002)).translate((0.0, y, -0.027 - 0.5 * room))
    return [*ends, motor, box((room, 0.022, room), (0.0, y + 0.034, -0.027 - 0.5 * room), 0.002)]


def belt(length: float) -> Solid:
    """The endless belt around its two drums."""
    half = 0.5 * length - DRUM
    # extruded along z, then laid over: (x, y) becomes (y, z)
    loop = prism(slot((-half, -DRUM), (half, -DRUM), DRUM), -0.5 * BELT_WIDTH, 0.5 * BELT_WIDTH)
    return loop.rotate((90.0, 0.0, 90.0))


def chevron() -> Solid:
    """A printed mark that points along +y."""
    wide, deep, thick = 0.42 * BELT_WIDTH, 0.010, 0.005
    outline: list[Point] = [
        (-wide, -deep),
        (-wide, -deep - thick),
        (0.0, -thick),
        (wide, -deep - thick),
        (wide, -deep),
        (0.0, 0.0),
    ]
    return prism(polygon([(x, y + 0.5 * deep) for x, y in outline]), 0.0, 0.0004)


def hood(tall: float) -> Solids:
    """A tunnel over the belt's end: items appear and vanish inside. Open at both ends."""
    side, thick = HALF_WIDTH + 0.0015, 0.002
    wall = box((thick, HOOD, tall + 0.020), (side, 0.0, 0.5 * tall - 0.010), 0.0008)
    top = box((2.0 * side + thick, HOOD, thick), (0.0, 0.0, tall), 0.0008)
    return [*both_sides(wall), top]


def item() -> Solid:
    """A small box, its upper side at height 0."""
    return box(ITEM, (0.0, 0.0, -0.5 * ITEM[2]), 0.0018)


def handle() -> Solids:
    """What the gripper takes an item by, 1 m high: to be scaled. It is longer to one side, which shows its turn."""
    half = 0.5 * GRIP_WIDTH
    bar = polygon([(-half, -0.0085), (half, -0.0085), (half, 0.0085), (0.0, 0.0165), (-half, 0.0085)])
    return [prism(bar, 0.0, 1.0)]
