"""Rods with their ball joints. The frame is that of `RodPairs`: upper ball at the origin, lower one at -l."""

from __future__ import annotations

from app.robots.parts.solids import COARSE, Solid, along_y, ball, cut, disc, lathe, ring, union

FERRULE = 6.5
"""Length of an end fitting, in ball radii."""


def rod_tube(length: float, ball_radius: float) -> Solid:
    """The tube between the two end fittings."""
    inset = 0.75 * FERRULE * ball_radius
    return disc(0.72 * ball_radius, inset - length, -inset, segments=16)


def rod_fittings(length: float, ball_radius: float) -> Solid:
    """Both end fittings: a ring around each ball and a ferrule glued onto the tube."""
    upper = _fitting(ball_radius)
    return union(upper, upper.rotate((180.0, 0.0, 0.0)).translate((0.0, 0.0, -length)))


def _fitting(r: float) -> Solid:
    """The fitting at the upper end; the rod hangs down from it."""
    eye = along_y(ring(1.55 * r, 0.97 * r, -0.6 * r, 0.6 * r, 0.12 * r, segments=24))
    ferrule = lathe(
        [
            (0.0, -1.2 * r),
            (0.62 * r, -1.2 * r),
            (0.62 * r, -2.6 * r),
            (1.05 * r, -3.1 * r),
            (1.05 * r, -(FERRULE - 0.3) * r),
            (0.8 * r, -FERRULE * r),
            (0.0, -FERRULE * r),
        ],
        16,
    )
    return eye + cut(ferrule, ball(1.2 * r, COARSE))


def cross_shaft(half_spacing: float, ball_radius: float) -> Solid:
    """A shaft along y with a ball at either end, on which the two rods of a leg ride."""
    r = ball_radius
    neck = 0.5 * r
    end = half_spacing + 1.25 * r
    shaft = along_y(disc(neck, -end, end, 0.15 * r, COARSE))
    collar = along_y(disc(0.75 * r, -(half_spacing - 1.2 * r), half_spacing - 1.2 * r, 0.0, COARSE))
    bead = along_y(ball(r, 20))
    return union(
        shaft, collar, bead.translate((0.0, half_spacing, 0.0)), bead.translate((0.0, -half_spacing, 0.0))
    )
