"""What the tool takes along: a point mass of the analytic plant, bodies of MuJoCo's."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Protocol

import numpy as np

from app.motion.cycle_items import ItemFlow
from app.robots.robot import Array
from app.simulation.plant import Plant

if TYPE_CHECKING:
    from app.simulation.prototype import Item, MujocoPlant

Events = list[tuple[float, Callable[[], None]]]
"""When (s), and what happens then."""


LIGHTEST = 1e-3
"""kg; MuJoCo has no bodies without mass."""


class Load(Protocol):
    """Something that is taken and left."""

    @property
    def events(self) -> Events: ...

    def watch(self) -> None:
        """Called once a period."""

    def seen_items(self) -> Array | None:
        """(k, m, 4) where items were at each period; None where they are no bodies."""
        ...


class PointMass:
    """At the tool point."""

    def __init__(self, plant: Plant, kg: float, carried_s: tuple[float, float] | None) -> None:
        taken, left = carried_s or (0.0, 0.0)
        switches = [(taken, lambda: plant.set_payload(kg)), (left, lambda: plant.set_payload(0.0))]
        self.events: Events = switches if kg and carried_s else []

    def watch(self) -> None:
        pass

    def seen_items(self) -> Array | None:
        return None


class Bodies:
    """Rigid bodies on belts, one of which is welded to the tool and left again."""

    def __init__(self, plant: MujocoPlant, flow: ItemFlow) -> None:
        self._plant = plant
        self._trace: list[list[tuple[float, float, float, float]]] = []
        away = (0.0, -flow.belt_speed_m_s)
        self.events: Events = [
            (flow.grasp_s, lambda: plant.grasp(flow.handled)),
            (flow.release_s, lambda: plant.release(flow.handled, away)),
        ]

    def watch(self) -> None:
        self._trace.append(self._plant.items)

    def seen_items(self) -> Array | None:
        return np.array(self._trace)


def bodies_at_start(flow: ItemFlow, tool: Sequence[float], kg: float) -> list[Item]:
    """The items as they lie at t = 0, the tool being at a pose (4,); rows as in `flow.at`."""
    from app.simulation.prototype import Item

    speed = flow.belt_speed_m_s
    rows = flow.at(0.0, tool).tolist()
    belts = [(0.0, -speed if row < flow.handled else speed) for row in range(flow.count)]
    return [Item((x, y, z, turn), belt, max(kg, LIGHTEST)) for (x, y, z, turn), belt in zip(rows, belts, strict=True)]
