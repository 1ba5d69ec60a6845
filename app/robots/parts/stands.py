"""What carries a machine: extruded aluminium profiles, feet and corner brackets."""

from __future__ import annotations

from app.robots.parts.solids import COARSE, Point, Solid, box, cut, disc, polygon, prism, union

SIDE = 0.040
"""Width of the heavy profile."""


def profile(z0: float, z1: float, side: float = SIDE) -> Solid:
    """An extruded profile along z with a T slot in each side."""
    a, lip, mouth, depth, inside = 0.5 * side, 0.045 * 2, 0.2, 0.58, 0.42
    quarter: list[Point] = [(1.0, -0.94), (1.0, -mouth), (1.0 - lip * 1.6, -mouth), (1.0 - lip * 1.6, -inside),
                            (1.0 - depth + 0.1, -mouth), (1.0 - depth + 0.1, mouth), (1.0 - lip * 1.6, inside),
                            (1.0 - lip * 1.6, mouth), (1.0, mouth), (1.0, 0.94)]
    points: list[Point] = []
    for c, s in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)):
        points += [(a * (c * x - s * y), a * (s * x + c * y)) for x, y in quarter]
    return prism(polygon(points), z0, z1)


def beam(start: Point, end: Point, z: float, side: float = SIDE) -> Solid:
    """A horizontal profile between two points, its middle at height z."""
    import math

    run = math.hypot(end[0] - start[0], end[1] - start[1])
    heading = math.degrees(math.atan2(end[1] - start[1], end[0] - start[0]))
    return profile(0.0, run, side).rotate((0.0, 90.0, heading)).translate((*start, z))


def gusset(size: float, width: float = 0.6 * SIDE) -> Solid:
    """A corner bracket in the x-z plane, its right angle at the origin, legs along +x and +z."""
    outline = polygon([(0.0, 0.0), (size, 0.0), (size, 0.12 * size), (0.12 * size, size), (0.0, size)])
    plate = prism(outline, -0.5 * width, 0.5 * width)
    window = prism(polygon([(0.13 * size, 0.13 * size), (0.75 * size, 0.13 * size), (0.13 * size, 0.75 * size)]),
                   -0.5 * width + 0.003, width)
    return cut(plate, window).rotate((90.0, 0.0, 0.0))


def foot(z: float) -> Solid:
    """A levelling foot with its pad's lower side at height z."""
    return union(
        disc(0.022, z, z + 0.008, 0.003),
        disc(0.006, z + 0.006, z + 0.022, 0.0, COARSE),
    )


__all__ = ["SIDE", "beam", "box", "foot", "gusset", "profile"]
