"""Driven arms of the rotary deltas: motor axis at the origin, elbow at (length, 0, 0), hinge axis y."""

from __future__ import annotations

from app.robots.parts.rods import cross_shaft
from app.robots.parts.solids import FINE, Solid, Solids, along_y, circle, disc, grown, lathe, prism, slot

HUB_RADIUS = 0.0205
HUB_HALF_WIDTH = 0.0115
ELBOW_RADIUS = 0.0105
BEAM_HALF_WIDTH = 0.0068


def arm(length: float, half_spacing: float, ball_radius: float) -> Solids:
    """A milled arm: hub, tapered beam with a pocket and windows, elbow and the cross shaft for the rods."""
    elbow_half = half_spacing - 1.15 * ball_radius
    half = min(BEAM_HALF_WIDTH, elbow_half - 0.001)
    hub = disc(HUB_RADIUS, -HUB_HALF_WIDTH, HUB_HALF_WIDTH, 0.0012, FINE)
    elbow = disc(ELBOW_RADIUS, -elbow_half, elbow_half, 0.001).translate((length, 0.0, 0.0))
    body = [along_y(piece) for piece in (*_beam(length, half), hub, elbow)]
    return [*body, cross_shaft(half_spacing, ball_radius).translate((length, 0.0, 0.0))]


def _beam(length: float, half: float) -> Solids:
    """A frame around a thin web with a row of windows."""
    wide, narrow, rim = HUB_RADIUS - 0.002, ELBOW_RADIUS - 0.0015, 0.0042
    start, end = HUB_RADIUS + 0.011, length - ELBOW_RADIUS - 0.010
    slope = (wide - narrow) / length
    pocket = slot((start, 0.0), (end, 0.0), wide - slope * start - rim, narrow + slope * (length - end) - rim)
    outline = slot((0.0, 0.0), (length, 0.0), wide, narrow)
    count = max(1, round((end - start) / 0.035))
    step = (end - start) / count
    web = grown(pocket, 0.0005)
    for k in range(count):
        web -= circle(0.0068 - 0.0034 * (k + 0.5) / count, (start + (k + 0.5) * step, 0.0))
    return [prism(outline - pocket, -half, half), prism(web, 0.0042 - half, half - 0.0042)]


def hub_shaft() -> Solid:
    """The motor's shaft with its clamp washer, as far as it shows beside the hub; it looks the same turned."""
    w = HUB_HALF_WIDTH
    profile = [
        (0.0, -w - 0.005),
        (0.0065, -w - 0.005),
        (0.0065, w),
        (0.0125, w),
        (0.0125, w + 0.0012),
        (0.0118, w + 0.002),
        (0.0068, w + 0.002),
        (0.0060, w + 0.0042),
        (0.0025, w + 0.0042),
        (0.0, w + 0.0022),
    ]
    return along_y(lathe(profile))
