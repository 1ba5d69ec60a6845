"""What carries a machine: extruded aluminium profiles, corner brackets and feet."""

from __future__ import annotations

import math

from app.robots.parts.solids import Point, Solid, Solids, at, lathe, polygon, prism

FOOT_HEIGHT = 0.020


def profile(z0: float, z1: float, side: float) -> Solid:
    """An extruded profile along z with a slot in each side."""
    a = 0.5 * side
    quarter: list[Point] = [(1.0, -0.9), (1.0, -0.22), (0.62, -0.22), (0.62, 0.22), (1.0, 0.22), (1.0, 0.9)]
    points = [
        (a * (c * x - s * y), a * (s * x + c * y))
        for c, s in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))
        for x, y in quarter
    ]
    return prism(polygon(points), z0, z1)


def beam(start: Point, end: Point, z: float, side: float) -> Solid:
    """A horizontal profile between two points, its middle at height z."""
    run, heading = _polar(start, end)
    return profile(0.0, run, side).rotate((0.0, 90.0, heading)).translate((*start, z))


def strut(start: Point, end: Point, side: float) -> Solid:
    """A slanted profile in the y-z plane between two points (y, z)."""
    run, slope = _polar(start, end)
    return profile(0.0, run, side).rotate((slope - 90.0, 0.0, 0.0)).translate((0.0, *start))


def _polar(start: Point, end: Point) -> Point:
    """Distance and direction (degrees)."""
    x, y = end[0] - start[0], end[1] - start[1]
    return math.hypot(x, y), math.degrees(math.atan2(y, x))


def gusset(size: float, width: float) -> Solids:
    """A corner bracket in the x-z plane, its right angle at the origin, legs along +x and +z."""
    thin, half = 0.11 * size, 0.5 * width
    legs = polygon([(0.0, 0.0), (size, 0.0), (size, thin), (thin, thin), (thin, size), (0.0, size)])
    web = polygon([(0.0, 0.0), (size, thin), (thin, size)])
    pieces = [prism(legs, -half, half), prism(web, -half, -0.6 * half), prism(web, 0.6 * half, half)]
    return [piece.rotate((90.0, 0.0, 0.0)) for piece in pieces]


def feet(floor: float, places: list[Point]) -> Solids:
    """Levelling feet that stand on the floor and end `FOOT_HEIGHT` above it."""
    profile = [
        (0.0, 0.0),
        (0.020, 0.0),
        (0.020, 0.004),
        (0.016, 0.008),
        (0.006, 0.008),
        (0.006, FOOT_HEIGHT),
        (0.0, FOOT_HEIGHT),
    ]
    foot = lathe(profile, 12)
    return at(foot, [(x, y, floor) for x, y in places])
