"""Solid modelling in metres: turned, extruded and hulled bodies, closed also where they are cut.

A `Solid` is a Manifold; `.translate`, `.rotate` (degrees) and `.mirror` move it. Shapes are lists of solids that
may overlap: to unite them costs milliseconds and shows nothing new. Edges that a hand could touch are
bevelled: the bright line along an edge is what makes metal look like metal.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from manifold3d import CrossSection, JoinType, Manifold, OpType

Solid = Manifold
Solids = list[Manifold]
Point = tuple[float, float]

FINE, ROUND, COARSE = 24, 16, 8
"""Segments around large, medium and small turned bodies."""


def cut(body: Solid, *tools: Solid) -> Solid:
    """The body without what the tools take away."""
    return Manifold.batch_boolean([body, *tools], OpType.Subtract)


def hull(*solids: Solid) -> Solid:
    """The tightest convex body around all of them."""
    return Manifold.batch_hull(list(solids))


def around(solid: Solid, count: int, first: float = 0.0) -> Solids:
    """Copies turned about z in equal steps, the first one by `first` degrees."""
    return [solid.rotate((0.0, 0.0, first + 360.0 * k / count)) for k in range(count)]


def at(solid: Solid, places: Iterable[Sequence[float]]) -> Solids:
    """Copies at several places (x, y, z)."""
    return [solid.translate((float(x), float(y), float(z))) for x, y, z in places]


def both_sides(solid: Solid, axis: int = 0) -> Solids:
    """A solid and its mirror image across x = 0 (or y, or z)."""
    normal = (1.0 * (axis == 0), 1.0 * (axis == 1), 1.0 * (axis == 2))
    return [solid, solid.mirror(normal)]


def moved(solids: Solids, offset: Sequence[float] = (0.0, 0.0, 0.0), turn: float = 0.0) -> Solids:
    """All of them turned about z (degrees), then shifted."""
    x, y, z = offset
    return [solid.rotate((0.0, 0.0, turn)).translate((float(x), float(y), float(z))) for solid in solids]


def lathe(profile: Sequence[Point], segments: int = ROUND) -> Solid:
    """A body turned about z from its half section, points (radius, z)."""
    points = np.array(profile, dtype=float)
    x, y = points.T
    if np.dot(x, np.roll(y, -1)) < np.dot(y, np.roll(x, -1)):
        points = points[::-1]
    return Manifold.revolve(CrossSection([points]), segments)


def disc(radius: float, z0: float, z1: float, bevel: float = 0.0, segments: int = ROUND) -> Solid:
    """A cylinder along z from z0 to z1."""
    if not bevel:
        return lathe([(0.0, z0), (radius, z0), (radius, z1), (0.0, z1)], segments)
    r, b = radius - bevel, bevel
    return lathe([(0.0, z0), (r, z0), (radius, z0 + b), (radius, z1 - b), (r, z1), (0.0, z1)], segments)


def ring(outer: float, inner: float, z0: float, z1: float, bevel: float = 0.0, segments: int = ROUND) -> Solid:
    """A disc with a hole."""
    b = bevel
    if not b:
        return lathe([(inner, z0), (outer, z0), (outer, z1), (inner, z1)], segments)
    profile = [(inner, z0), (outer - b, z0), (outer, z0 + b), (outer, z1 - b), (outer - b, z1), (inner, z1)]
    return lathe(profile, segments)


def ball(radius: float, segments: int = ROUND) -> Solid:
    """A sphere turned about z."""
    angles = np.linspace(-math.pi / 2, math.pi / 2, segments // 2 + 1)
    return lathe([(radius * max(math.cos(a), 0.0), radius * math.sin(a)) for a in angles], segments)


def box(size: Sequence[float], centre: Sequence[float] = (0.0, 0.0, 0.0), bevel: float = 0.0) -> Solid:
    """A cuboid, its twelve edges bevelled."""
    x, y, z = size
    if bevel:
        inner = 2.0 * bevel
        slabs = [(x - inner, y - inner, z), (x - inner, y, z - inner), (x, y - inner, z - inner)]
        body = hull(*(Manifold.cube(slab, True) for slab in slabs))
    else:
        body = Manifold.cube((x, y, z), True)
    return body.translate((float(centre[0]), float(centre[1]), float(centre[2])))


def along_y(solid: Solid) -> Solid:
    """Turns a body's z axis into y (its y axis points down)."""
    return solid.rotate((-90.0, 0.0, 0.0))


def prism(outline: CrossSection, z0: float, z1: float) -> Solid:
    """A plate of any outline between two heights."""
    return Manifold.extrude(outline, z1 - z0).translate((0.0, 0.0, z0))


def bevelled(outline: CrossSection, z0: float, z1: float, bevel: float) -> Solid:
    """A plate of a convex outline with bevelled rims."""
    inner = grown(outline, -bevel)
    return hull(prism(inner, z0, z1), prism(outline, z0 + bevel, z1 - bevel))


def grown(outline: CrossSection, by: float) -> CrossSection:
    """An outline moved outwards (or inwards, where negative), with round corners."""
    return outline.offset(by, JoinType.Round, 2.0, COARSE)


def circle(radius: float, centre: Point = (0.0, 0.0), segments: int = ROUND) -> CrossSection:
    """A round outline."""
    return CrossSection.circle(radius, segments).translate(centre)


def polygon(points: Sequence[Point]) -> CrossSection:
    """An outline through points in counter-clockwise order."""
    return CrossSection([np.array(points, dtype=float)])


def regular(sides: int, apothem: float, first: float = 0.0) -> CrossSection:
    """A regular outline; the middle of its first side lies in direction `first` (degrees)."""
    radius = apothem / math.cos(math.pi / sides)
    angles = np.radians(first) + (np.arange(sides) + 0.5) * 2.0 * math.pi / sides
    return CrossSection([radius * np.column_stack([np.cos(angles), np.sin(angles)])])


def slot(start: Point, end: Point, radius: float, end_radius: float | None = None) -> CrossSection:
    """The outline of a straight link: two round ends and their tangents."""
    other = radius if end_radius is None else end_radius
    return CrossSection.batch_hull([circle(radius, start), circle(other, end)])


def bar(
    start: Point, end: Point, z0: float, z1: float, radius: float, bevel: float = 0.0, end_radius: float | None = None
) -> Solid:
    """A straight link between two vertical axes, round at both ends, bevelled all round."""
    other = radius if end_radius is None else end_radius
    return hull(
        disc(radius, z0, z1, bevel).translate((*start, 0.0)),
        disc(other, z0, z1, bevel).translate((*end, 0.0)),
    )
