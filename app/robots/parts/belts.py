"""Belts and the wheels they run on."""

from __future__ import annotations

from app.robots.parts.solids import FINE, Point, Solid, lathe, prism, slot

BELT = 0.0014
"""Thickness of a belt."""
FLANGE = 0.0022
"""How far a wheel's flange stands out."""


def wheel(radius: float, z0: float, z1: float, tracks: int = 1, segments: int = FINE) -> Solid:
    """A wheel about z with flanges beside each track."""
    thin = 0.0013
    step = (z1 - z0 - thin) / tracks
    profile: list[Point] = [(0.0, z0)]
    for k in range(tracks + 1):
        z = z0 + k * step
        rim = [(radius + FLANGE, z), (radius + FLANGE, z + thin)]
        profile += [*([(radius, z)] if k else []), *rim, *([(radius, z + thin)] if k < tracks else [])]
    return lathe([*profile, (0.0, z1)], segments)


def belt(start: Point, start_radius: float, end: Point, end_radius: float, z0: float, z1: float) -> Solid:
    """A belt around two wheels."""
    outer = slot(start, end, start_radius + BELT, end_radius + BELT)
    return prism(outer - slot(start, end, start_radius, end_radius), z0, z1)
