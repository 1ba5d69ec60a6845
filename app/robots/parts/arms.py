"""Driven arms of the rotary deltas: motor axis at the origin, elbow at (length, 0, 0), hinge axis y."""

from __future__ import annotations

from app.robots.parts.rods import cross_shaft
from app.robots.parts.solids import (
    COARSE,
    FINE,
    Solid,
    along_y,
    at,
    circle,
    cut,
    disc,
    hull,
    prism,
    slot,
    union,
)

HUB_RADIUS = 0.0195
HUB_HALF_WIDTH = 0.0115
ELBOW_RADIUS = 0.0105


def arm(length: float, half_spacing: float, ball_radius: float) -> Solid:
    """A milled arm: hub, tapered beam with pockets on both sides, elbow boss, all from one piece."""
    elbow_half = half_spacing - 1.15 * ball_radius
    hub = disc(HUB_RADIUS, -HUB_HALF_WIDTH, HUB_HALF_WIDTH, 0.0012, FINE)
    elbow = disc(ELBOW_RADIUS, -elbow_half, elbow_half, 0.001).translate((length, 0.0, 0.0))
    half = 0.0068
    beam = hull(
        disc(HUB_RADIUS - 0.002, -half, half, 0.001, FINE),
        disc(ELBOW_RADIUS - 0.0015, -half, half, 0.001).translate((length, 0.0, 0.0)),
    )
    start, end = HUB_RADIUS + 0.010, length - ELBOW_RADIUS - 0.009
    pocket_outline = slot((start, 0.0), (end, 0.0), 0.0105, 0.0052)
    pocket = prism(pocket_outline, half - 0.0042, half + 0.001)
    count = max(1, round((end - start) / 0.035))
    step = (end - start) / count
    windows = [
        prism(circle(0.0066 - 0.0032 * (k + 0.5) / count, (start + (k + 0.5) * step, 0.0)), -half, half)
        for k in range(count)
    ]
    body = cut(union(beam, hub, elbow), pocket, pocket.mirror((0.0, 0.0, 1.0)), *windows)
    return along_y(body)


def arm_hardware(length: float, half_spacing: float, ball_radius: float) -> Solid:
    """Steel on the arm: the motor shaft's end and clamp screws in the hub, the cross shaft at the elbow."""
    shaft = disc(0.0065, -HUB_HALF_WIDTH - 0.004, HUB_HALF_WIDTH + 0.0022, 0.0008)
    screw = cut(
        disc(0.0021, HUB_HALF_WIDTH - 0.001, HUB_HALF_WIDTH + 0.0018, 0.0004, COARSE),
        disc(0.0011, HUB_HALF_WIDTH + 0.0006, HUB_HALF_WIDTH + 0.003, 0.0, 6),
    )
    places = [(0.0125 * c, 0.0125 * s, 0.0) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    screws = at(screw.rotate((0.0, 0.0, 45.0)), places).rotate((0.0, 0.0, 45.0))
    hub = along_y(union(shaft, screws))
    return hub + cross_shaft(half_spacing, ball_radius).translate((length, 0.0, 0.0))
