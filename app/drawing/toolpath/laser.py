"""The power of a laser, by the speed at which it really moves."""

from __future__ import annotations

import numpy as np

from app.drawing.toolpath.pen import PenSettings
from app.drawing.toolpath.plan import Toolpath
from app.robots.robot import Array


def laser_power(toolpath: Toolpath, pen: PenSettings) -> Array:
    """(k,) share 0 to 1 of the power that is right at the pen's speed.

    It is proportional to the actual speed, so that every millimetre gets the same energy: a corner is not burnt, and
    at rest and between the strokes the laser is off. A dot, where the tool rests, is not marked.
    """
    if not pen.laser:
        return np.zeros(len(toolpath.t))
    share = np.minimum(toolpath.speed_m_s / (1e-3 * pen.speed_mm_s), 1.0)
    return np.where(toolpath.pen, share, 0.0)
