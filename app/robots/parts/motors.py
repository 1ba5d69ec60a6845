"""Geared motors. The frame is that of the arm at its motor axis: y along the shaft, the arm at y = 0."""

from __future__ import annotations

from app.robots.parts.solids import (
    COARSE,
    FINE,
    Solid,
    around,
    along_y,
    box,
    cut,
    disc,
    hull,
    lathe,
    ring,
    union,
)

FACE = -0.0165
"""y of the bracket's face behind the arm."""
BRACKET = 0.008
"""Thickness of the bracket."""


def bracket(plate_top: float) -> Solid:
    """A milled bearing block that carries the motor; its foot stands at height `plate_top`, inside the axis."""
    y0, y1 = FACE - BRACKET, FACE
    head = disc(0.0235, -y1, -y0, 0.001, FINE).rotate((90.0, 0.0, 0.0))
    foot_height = 0.008
    foot = box((0.050, BRACKET, foot_height), (-0.045, 0.5 * (y0 + y1), plate_top + 0.5 * foot_height), 0.0008)
    web = cut(hull(head, foot), disc(0.006, 0.0, 0.1).rotate((90.0, 0.0, 0.0)))
    flange = box((0.046, 0.026, 0.006), (-0.045, y0 - 0.009, plate_top + 0.003), 0.0008)
    screw = disc(0.003, plate_top + 0.004, plate_top + 0.0085, 0.0005, COARSE)
    socket = disc(0.0015, plate_top + 0.006, plate_top + 0.02, 0.0, 6)
    screws = [
        cut(screw, socket).translate((x, y0 - 0.013, 0.0)) for x in (-0.061, -0.029)
    ]
    return union(web, flange, *screws)


def gearbox(length: float) -> Solid:
    """The planetary gearbox between bracket and motor."""
    r = 0.0185
    y = -(FACE - BRACKET)
    body = lathe(
        [(0.0, y), (r, y), (r, y + 0.003), (r - 0.0012, y + 0.0036), (r - 0.0012, y + length - 0.004),
         (r + 0.0005, y + length - 0.0034), (r + 0.0005, y + length), (0.0, y + length)], FINE,
    )
    return body.rotate((90.0, 0.0, 0.0))


def motor(start: float, length: float) -> Solid:
    """The motor's can behind the gearbox, `start` from the bracket, with its encoder cap and plug."""
    y = -(FACE - BRACKET) + start
    r, end = 0.0178, y + length
    cap = 0.014
    can = lathe(
        [(0.0, y), (r, y), (r, end - cap), (r - 0.0012, end - cap + 0.0006), (r - 0.0012, end - cap + 0.0016),
         (r - 0.0002, end - cap + 0.002), (r - 0.0002, end - 0.002), (r - 0.0022, end), (0.0, end)], FINE,
    ).rotate((90.0, 0.0, 0.0))
    plug = box((0.012, 0.009, 0.010), (-0.003, -(end - 0.0065), r + 0.001), 0.001)
    return can + plug


def label(start: float, length: float) -> Solid:
    """A band around the motor's can."""
    y = -(FACE - BRACKET) + start
    return ring(0.0181, 0.017, y + 0.3 * length, y + 0.5 * length, 0.0, FINE).rotate((90.0, 0.0, 0.0))
