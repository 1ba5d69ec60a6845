"""Rods with their ball joints. The frame is that of `RodPairs`: upper ball at the origin, lower one at -l."""

from __future__ import annotations

from app.robots.parts.solids import COARSE, Solid, Solids, along_y, ball, disc, lathe, ring

FERRULE = 6.5
"""Length of an end fitting, in ball radii."""


def rod(length: float, ball_radius: float) -> Solids:
    """The tube between the end fittings, and the two balls inside them."""
    inset = 0.75 * FERRULE * ball_radius
    bead = along_y(ball(ball_radius, 12))
    tube = disc(0.74 * ball_radius, inset - length, -inset, segments=14)
    return [tube, bead, bead.translate((0.0, 0.0, -length))]


def rod_fittings(length: float, ball_radius: float) -> Solids:
    """Both end fittings: an eye around each ball and a ferrule glued onto the tube."""
    upper = _fitting(ball_radius)
    return upper + [piece.rotate((180.0, 0.0, 0.0)).translate((0.0, 0.0, -length)) for piece in upper]


def _fitting(r: float) -> Solids:
    """The fitting at the upper end; the rod hangs down from it."""
    eye = along_y(ring(1.55 * r, 0.88 * r, -0.6 * r, 0.6 * r, 0.15 * r, segments=18))
    ferrule = lathe(
        [
            (0.0, -1.2 * r),
            (0.55 * r, -1.2 * r),
            (0.55 * r, -2.6 * r),
            (1.05 * r, -3.1 * r),
            (1.05 * r, -(FERRULE - 0.3) * r),
            (0.8 * r, -FERRULE * r),
            (0.0, -FERRULE * r),
        ],
        12,
    )
    return [eye, ferrule]


def cross_shaft(half_spacing: float, ball_radius: float) -> Solid:
    """The shaft along y on whose ends the two rods of a leg ride; it passes through their balls."""
    r = ball_radius
    tip, shoulder = half_spacing + 1.3 * r, half_spacing - 0.75 * r
    side = [(0.0, tip), (0.55 * r, tip), (0.55 * r, shoulder), (0.85 * r, shoulder - 0.5 * r)]
    return along_y(lathe([*side, *((x, -y) for x, y in reversed(side))], COARSE))
