"""What the machines hold. The frame is the tool's: tip at the origin (unless said), z up."""

from __future__ import annotations

from app.robots.parts.solids import COARSE, Solid, Solids, ball, both_sides, box, disc, lathe

SPLIT = 0.5
"""Where a gripper's fingers begin, as a part of its height."""


def gripper_body(height: float) -> Solids:
    """The gripper's housing with its flange; jaws along x, tips at the origin."""
    low = SPLIT * height
    return [
        box((0.046, 0.020, height - low), (0.0, 0.0, 0.5 * (height + low)), 0.0016),
        disc(0.0110, height - 0.001, height + 0.003, 0.0008),
    ]


def gripper_jaws(height: float) -> Solids:
    """Two stepped fingers."""
    low = SPLIT * height
    carriage = box((0.013, 0.014, 0.006), (0.0145, 0.0, low - 0.003), 0.0008)
    finger = box((0.005, 0.011, low - 0.001), (0.0115, 0.0, 0.5 * low + 0.0005), 0.0007)
    return both_sides(carriage) + both_sides(finger)


def gripper_pads(height: float) -> Solids:
    """Rubber pads on the inside of the finger tips."""
    size = min(0.010, 0.4 * height)
    pad = box((0.0030, 0.0095, size), (0.0082, 0.0, 0.5 * size), 0.0005)
    return both_sides(pad)


def gripper_mark(height: float) -> Solid:
    """A stripe on the housing's front: it shows which way the tool is turned."""
    low = SPLIT * height
    return box((0.006, 0.0006, 0.6 * (height - low)), (0.014, -0.0102, 0.5 * (height + low)))


def needle(height: float) -> Solid:
    """A plain tip from `height` (of either sign) to the origin, where there is no room for a gripper."""
    if abs(height) < 0.004:
        return ball(0.004, COARSE)
    cone = Solid.cylinder(abs(height), 0.0008, 0.0042, 14)
    return cone if height > 0.0 else cone.mirror((0.0, 0.0, 1.0))


def suction_cup(top: float, tip: float) -> Solid:
    """A bellows cup from `top` down to its lip at `tip`."""
    step = (top - tip) / 5.0
    outer = [(0.0, top), (0.006, top)]
    for k in range(2):
        z = top - (1.0 + 2.0 * k) * step
        outer += [(0.0125, z), (0.0082, z - step)]
    outer += [(0.0145, tip), (0.0120, tip), (0.0, tip + 0.8 * step)]
    return lathe(outer)


def pen_body(tip: float, length: float) -> Solids:
    """A hexagonal barrel above the cone that leads to the tip."""
    start = tip + 0.020
    barrel = disc(0.0052, start, tip + length, 0.0, 6)
    cap = disc(0.0046, tip + length - 0.001, tip + length + 0.006, 0.0012, 12)
    return [barrel, cap]


def pen_cone(tip: float) -> Solid:
    """The cone between barrel and point."""
    return lathe([(0.0, tip + 0.0045), (0.0012, tip + 0.0045), (0.0048, tip + 0.0205), (0.0, tip + 0.0205)], 12)


def pen_point(tip: float) -> Solid:
    """The point that touches the paper."""
    return lathe([(0.0, tip), (0.0012, tip + 0.0047), (0.0, tip + 0.0047)], COARSE)
