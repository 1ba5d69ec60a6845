"""A rigid rod as seen from its two ends."""

from __future__ import annotations

from typing import NamedTuple


class RodForm(NamedTuple):
    """Kinetic energy 1/2 (a |v_a|^2 + 2 b v_a . v_b + c |v_b|^2) of end velocities v_a and v_b (spec of the
    linear delta, A5). Exact for a rod that does not spin about its own axis, and constant."""

    a: float
    b: float
    c: float
    near: float
    """kg that weigh on end a."""
    far: float
    """kg that weigh on end b."""


def rigid_rod(mass: float, com: float, inertia: float, length: float) -> RodForm:
    """The form of a rigid rod.

    Args:
        mass: kg.
        com: its centre's distance from end a, as a share of the length.
        inertia: about the centre, across the rod, kg m^2.
        length: m.
    """
    spin = inertia / (length * length)
    near, far = mass * (1.0 - com), mass * com
    return RodForm(near * (1.0 - com) + spin, near * com - spin, far * com + spin, near, far)


def two_points(mass: float, share: float) -> RodForm:
    """The thesis' lumped rod: a `share` of its mass at end b, the rest at end a (A4)."""
    near, far = mass * (1.0 - share), mass * share
    return RodForm(near, 0.0, far, near, far)
