"""How the pen is moved, and what suits each robot."""

from __future__ import annotations

from dataclasses import dataclass

from app.drawing.errors import DrawingError
from app.robots import Robot

LIFTS_MM: dict[str, float] = {"fivebar": 2.0}
"""Lifts by robot where the usual one is slow: the five-bar's screws take 0.4 s for a hop of 4 mm."""


@dataclass(frozen=True)
class PenSettings:
    """How the pen is moved."""

    speed_mm_s: float = 80.0
    """On the paper, where the joints allow it."""
    up_speed_mm_s: float = 300.0
    """Above the paper."""
    lift_mm: float = 4.0
    lift: bool = True
    """Without it the pen stays on the paper between the strokes, as with the robot of the paper."""
    laser: bool = False
    """A laser instead of a pen: it stays at its height between the strokes, switched off."""

    def __post_init__(self) -> None:
        if not (1.0 <= self.speed_mm_s <= 2000.0 and 1.0 <= self.up_speed_mm_s <= 2000.0):
            raise DrawingError("A pen's speed must lie between 1 and 2000 mm/s; choose a speed in this range.")
        if not 0.5 <= self.lift_mm <= 50.0:
            raise DrawingError("The pen is lifted by 0.5 to 50 mm; choose a height in this range.")

    @property
    def rises(self) -> bool:
        """Whether the tool goes up between the strokes."""
        return self.lift and not self.laser

    @property
    def marks_hops(self) -> bool:
        """Whether the ways between the strokes are drawn too."""
        return not self.lift and not self.laser


def default_pen(robot: Robot) -> PenSettings:
    """A pen lifted as high as suits the robot."""
    return PenSettings(lift_mm=LIFTS_MM.get(robot.name, PenSettings.lift_mm))
