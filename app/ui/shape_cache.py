"""Shapes that are ready to draw, shared by all rooms."""

from __future__ import annotations

from app.recent import Recent
from app.robots import Robot
from app.robots.parts import Part, machine_of
from app.robots.parts.shading import Arrays

CAPACITY = 512


class ShapeCache(Recent[Part, Arrays]):
    """Vertices and faces by part."""

    def __init__(self) -> None:
        super().__init__(CAPACITY)

    def learn(self, robot: Robot) -> None:
        """Build what is missing of a robot, here and now: some 20 ms."""
        for part in machine_of(robot).parts:
            if self.get(part) is None:
                self.put(part, part.arrays())
