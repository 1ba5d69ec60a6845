"""Geared motors of the rotary deltas, in the frame of their arm: y along the shaft, the arm at y = 0.

Everything stands behind the arm: a bearing bracket on the base plate, the gearbox, the motor.
"""

from __future__ import annotations

from app.robots.parts.solids import (
    COARSE,
    FINE,
    Point,
    Solid,
    Solids,
    bevelled,
    box,
    disc,
    hull,
    lathe,
    polygon,
    ring,
)

FACE = -0.0165
"""y of the bracket's face behind the arm."""
BACK = FACE - 0.008
"""y of the bracket's rear face, where the gearbox begins."""
RADIUS = 0.020
"""Of the motor's can."""


def bracket(plate_top: float, foot: float) -> Solids:
    """A milled bearing block that carries the motor.

    Args:
        plate_top: height of the plate it stands on.
        foot: length of its foot, inside the axis.
    """
    thickness, middle, x = FACE - BACK, 0.5 * (FACE + BACK), -0.021 - 0.5 * foot
    head = _backwards(disc(0.0245, -FACE, -BACK, 0.001, FINE))
    sole = box((foot, thickness, 0.008), (x, middle, plate_top + 0.004), 0.0008)
    flange = box((foot - 0.004, 0.020, 0.006), (x, BACK - 0.009, plate_top + 0.003), 0.0008)
    screw = disc(0.003, plate_top + 0.004, plate_top + 0.0088, 0.0006, COARSE)
    screws = [screw.translate((x + s * 0.3 * foot, BACK - 0.012, 0.0)) for s in (-1.0, 1.0)]
    bearing = _backwards(ring(0.0150, 0.0085, -FACE - 0.0012, -FACE + 0.001, 0.0004))
    return [hull(head, sole), bearing, flange, *screws]


def round_gearbox(length: float) -> Solid:
    """A planetary gearbox whose ring gear shows."""
    r = RADIUS + 0.001
    steps = [(0.0, 0.0), (r, 0.0), (r, 0.16), (r - 0.0014, 0.2), (r - 0.0014, 0.62), (r, 0.66), (r, 1.0), (0.0, 1.0)]
    return _turned([(x, length * y) for x, y in steps])


def square_gearbox(length: float) -> Solid:
    """A gearbox with a square flange, as on small servo drives."""
    half = RADIUS + 0.0005
    c = 0.8 * half
    outline = polygon([(half, -c), (half, c), (c, half), (-c, half), (-half, c), (-half, -c), (-c, -half), (c, -half)])
    return _backwards(bevelled(outline, -BACK, -BACK + length, 0.001))


def motor(start: float, length: float) -> Solids:
    """The motor behind a gearbox of length `start`: can, encoder cap and plug."""
    r, end, cap = RADIUS, length, min(0.016, 0.35 * length)
    can = _turned(
        [
            (0.0, 0.0),
            (r, 0.0),
            (r, end - cap),
            (r - 0.0014, end - cap + 0.0006),
            (r - 0.0014, end - cap + 0.0018),
            (r - 0.0004, end - cap + 0.0024),
            (r - 0.0004, end - 0.0022),
            (r - 0.0026, end),
            (0.0, end),
        ],
        start,
    )
    plug = box((0.013, 0.6 * cap, 0.010), (-0.003, BACK - start - end + 0.5 * cap, r + 0.001), 0.001)
    return [can, plug]


def motor_band(start: float, length: float) -> Solid:
    """A band around the motor's can."""
    y = -BACK + start
    return _backwards(ring(RADIUS + 0.0004, RADIUS - 0.001, y + 0.28 * length, y + 0.44 * length, 0.0, FINE))


def _turned(profile: list[Point], start: float = 0.0) -> Solid:
    """A body turned about the motor's axis; heights are distances behind the bracket."""
    return _backwards(lathe([(x, y - BACK + start) for x, y in profile], FINE))


def _backwards(solid: Solid) -> Solid:
    """Turns a body's z axis into -y, its y axis up."""
    return solid.rotate((90.0, 0.0, 0.0))
