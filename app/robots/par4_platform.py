"""The Par4's articulated platform: two bars that never turn, and two links between them that turn by theta."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
PerLeg = tuple[float, float, float, float]


@dataclass(frozen=True)
class Par4Platform:
    """Where the rods end on the platform. Legs 3 and 4 carry the bar of the tool point, 1 and 2 the other one."""

    along: PerLeg
    """Rod joint of each leg from the middle of its bar, along the bar (x)."""
    across: PerLeg
    """The same across the bar (y)."""
    links: PerLeg
    """Length of the turning link between the tool point and the leg's bar: h, h, 0, 0."""
    height: float
    """Rod joints above the tool point (P_iz)."""
    theta_max: float

    @property
    def h(self) -> float:
        return max(self.links)

    def joints(self, pose: Array) -> Array:
        """(..., 4, 3) rod joints of poses (..., 4); (1)-(12)."""
        s, c = np.sin(pose[..., 3, None]), np.cos(pose[..., 3, None])
        links = np.array(self.links)
        shift = np.broadcast_arrays(self.along - links * s, self.across + links * c, self.height)
        return pose[..., None, :3] + np.stack(shift, axis=-1)

    def loop_rows(self, rods: Array, theta: Array) -> Array:
        """Jx (..., 4, 4) of rod vectors (..., 4, 3): rows [l_i, l_i . dP_i/dtheta]."""
        s, c = np.sin(theta)[..., None], np.cos(theta)[..., None]
        spin = -np.array(self.links) * (rods[..., 0] * c + rods[..., 1] * s)
        return np.concatenate([rods, spin[..., None]], axis=-1)
