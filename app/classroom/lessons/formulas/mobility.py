"""Grübler's count of a mechanism's freedoms."""

from __future__ import annotations

from app.classroom.lessons.formulas.registry import formula


@formula("mobility")
def mobility(bodies: int, joints: list[float], space: int = 6, idle: int = 0) -> int:
    """Grübler: space (bodies - 1 - number of joints) + sum of the joints' freedoms - idle ones.

    Args:
        bodies: with the base.
        joints: freedoms of each joint.
        space: 6, or 3 in a plane.
        idle: freedoms that move nothing, such as a rod's turn about its own axis.
    """
    return int(space * (bodies - 1 - len(joints)) + sum(joints) - idle)
