"""Where the items of a work cycle are: on the belt they come on, in the gripper, on the belt they leave on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.motion.trajectory import Array

COMING, GONE = 2, 2
"""Items shown on the belts beside the one that is handled."""


@dataclass(frozen=True)
class ItemFlow:
    """Items a belt's period apart, one taken and one put down each cycle."""

    period_s: float
    grasp_s: float
    """When the tool lifts the item off the pick belt."""
    release_s: float
    """When it leaves it on the place belt."""
    belt_speed_m_s: float
    """Of the pick belt along +y and of the place belt along -y."""
    grasp_pose: tuple[float, float, float, float]
    release_pose: tuple[float, float, float, float]
    """x, y, z of the tool and its turn at these times."""

    @property
    def count(self) -> int:
        return GONE + 1 + COMING

    @property
    def handled(self) -> int:
        """Row of the item that is picked and placed in this cycle."""
        return GONE

    def at(self, t: ArrayLike, tool_pose: ArrayLike) -> Array:
        """Positions and turns of all items, the farthest gone first, the last to come last.

        At the end of a cycle each row has moved to where the row before it began: the next cycle goes on there,
        while the first item leaves the picture and a new one enters it.

        Args:
            t: (...,) s; after a period the next cycle begins.
            tool_pose: (..., 4) where the tool is then.
        Returns:
            (..., count, 4) x, y, z (m) and the turn (rad) of each item's point under the tool.
        """
        times, tool = np.asarray(t, dtype=float), np.asarray(tool_pose, dtype=float)
        phase = times - self.period_s * np.maximum(np.ceil(times / self.period_s - 1e-9) - 1.0, 0.0)
        place = self.handled - np.arange(self.count)
        # an item's own clock shows grasp_s when it is grasped
        clock = phase[..., None] + place * self.period_s
        coming = self._riding(self.grasp_pose, clock - self.grasp_s, 1.0)
        leaving = self._riding(self.release_pose, clock - self.release_s, -1.0)
        carried = np.broadcast_to(tool[..., None, :], coming.shape)
        stage = np.where(clock < self.grasp_s, 0, np.where(clock < self.release_s, 1, 2))[..., None]
        return np.choose(stage, [coming, carried, leaving])

    def _riding(self, pose: tuple[float, ...], since: Array, direction: float) -> Array:
        """(..., 4) on a belt that passes `pose` at time 0."""
        items = np.broadcast_to(np.array(pose), (*since.shape, 4)).copy()
        items[..., 1] += direction * self.belt_speed_m_s * since
        return items
