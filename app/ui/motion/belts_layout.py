"""Where the belts of a work cycle stand, and what lies on them: numbers for `BeltsView`. Nothing here imports viser."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.robots.fivebar import FiveBar
from app.robots.parts import conveyors, machine_of

NEAR_END, ROOM = -0.12, 0.17
"""y of the belts' ends beside the pedestal, and how far they go on beyond where the tool takes an item, m."""

BESIDE_MOTORS, BEFORE_MOTORS = 0.047, 0.11
"""Room around a motor's axis, and y of the near ends where the motors stand in the way, m."""

LIFTED_M = 1e-3
"""An item this much higher is in the gripper."""

MARKS = 11
"""On each belt."""
FADE_M = 0.02
"""Over which a mark comes and goes at a drum."""

MOST_ITEMS = 12
STRAIGHT = (1.0, 0.0, 0.0, 0.0)

Array = NDArray[np.floating[Any]]


class Layout(NamedTuple):
    """Where the belts are, m."""

    x: tuple[float, float]
    """Of the pick belt, which moves along +y, and of the place belt, which moves along -y."""
    y: tuple[float, float]
    """Of both belts' ends."""
    item_top: float
    """z of the upper side of items on a belt."""
    floor: float

    @property
    def length(self) -> float:
        return self.y[1] - self.y[0]

    @property
    def middle(self) -> float:
        return 0.5 * (self.y[0] + self.y[1])

    @property
    def belt_top(self) -> float:
        return self.item_top - conveyors.ITEM[2]

    @property
    def hood(self) -> float:
        """y of its middle."""
        return self.y[0] + 0.5 * conveyors.HOOD


def layout_for(items: Array, robot: FiveBar) -> Layout:
    """Belts under items (k, m, 4): x, y, z and turn at k instants, most of the time not lifted. To the millimetre,
    which the errors of a controller do not change."""
    x, y, z = items[..., 0], items[..., 1], items[..., 2]
    lowest, belts = float(z.min()), (round(float(x.min()), 3), round(float(x.max()), 3))
    lifted = y[z > lowest + LIFTED_M]
    far = float(lifted.max() if lifted.size else y.max()) + ROOM
    motors = max(map(abs, robot.linkage.motors)) + BESIDE_MOTORS + conveyors.HALF_WIDTH
    near = NEAR_END if motors < min(map(abs, belts)) else BEFORE_MOTORS
    return Layout(belts, (near, round(far, 2)), round(lowest, 3), machine_of(robot).floor)


def mark_places(layout: Layout, travelled: float) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Positions and scales (2 MARKS, 3) of the marks: those of the pick belt, then those of the place belt."""
    pitch = layout.length / MARKS
    along = np.mod(pitch * np.arange(MARKS) + travelled, layout.length)
    size = np.clip(np.minimum(along, layout.length - along) / FADE_M, 0.0, 1.0)
    positions = np.full((2, MARKS, 3), layout.belt_top, dtype=np.float32)
    positions[..., 0] = np.array(layout.x)[:, None]
    positions[0, :, 1], positions[1, :, 1] = layout.y[0] + along, layout.y[1] - along
    return positions.reshape(-1, 3), np.repeat(np.tile(size, 2)[:, None], 3, axis=1).astype(np.float32)


def item_places(layout: Layout, items: Array) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.bool_]]:
    """Positions (n, 3), quaternions (n, 4) and which (n,) are seen, of all `MOST_ITEMS` copies: an item that has not
    yet come out of the hood, or is back in it, is not."""
    positions, wxyzs = np.zeros((MOST_ITEMS, 3), np.float32), np.tile(np.array(STRAIGHT, np.float32), (MOST_ITEMS, 1))
    seen = np.zeros(MOST_ITEMS, bool)
    count, half = len(items), 0.5 * items[:, 3]
    positions[:count] = items[:, :3]
    wxyzs[:count, 0], wxyzs[:count, 3] = np.cos(half), np.sin(half)
    seen[:count] = (items[:, 1] > layout.hood) & (items[:, 1] < layout.y[1])
    return positions, wxyzs, seen
