"""Shapes that are ready to draw, shared by all rooms."""

from __future__ import annotations

from collections import OrderedDict

from app.robots import Robot
from app.robots.parts import Part, machine_of
from app.robots.parts.shading import Arrays

CAPACITY = 512


class ShapeCache:
    """Vertices and faces by part; the least recently used are forgotten first."""

    def __init__(self) -> None:
        self._shapes: OrderedDict[Part, Arrays] = OrderedDict()

    def find(self, part: Part) -> Arrays | None:
        if part in self._shapes:
            self._shapes.move_to_end(part)
        return self._shapes.get(part)

    def learn(self, robot: Robot) -> None:
        """Build what is missing of a robot, here and now: some 20 ms."""
        for part in machine_of(robot).parts:
            if part not in self._shapes:
                self.keep(part, part.arrays())

    def keep(self, part: Part, arrays: Arrays) -> None:
        self._shapes[part] = arrays
        while len(self._shapes) > CAPACITY:
            self._shapes.popitem(last=False)
