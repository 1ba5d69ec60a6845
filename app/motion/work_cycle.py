"""The five-bar's work cycle between two moving belts: pick an item from one, place it on the other, a-b to i-a.

    a-b  over to the pick belt, turning the tool back, and up to the belt's speed
    b-c  down, moving along with the belt    c-d  grasp    d-e  up, still moving along
    e-f  over to the place belt, turning the tool, from one belt's speed to the other's
    f-g  down    g-h  release    h-i  up     i-a  off the belt, to rest

Across the belts the tool follows the sin2 law, along them and in height quintics.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from app.robots import Robot, build_robot

PAPER_PERIOD_S = 2.46
TRANSFER, STROKE, GRIP = (duration / PAPER_PERIOD_S for duration in (0.48, 0.26, 0.10))
"""Shares of a period; what is left, 0.26 s of the paper's, brings the tool off the place belt to rest."""

SEGMENTS = ("a-b", "b-c", "c-d", "d-e", "e-f", "f-g", "g-h", "h-i", "i-a")


@dataclass(frozen=True)
class WorkCycle:
    """What may be chosen about the cycle; the defaults are the cycle W1."""

    belt_speed_m_s: float = 0.15
    """Of the pick belt along +y and of the place belt along -y."""
    stroke_m: float = 0.005
    """How far the tool goes down to the items."""
    period_s: float = PAPER_PERIOD_S
    """One item each period; all that the tool does takes its share."""
    transfer_s: float | None = None
    """From belt to belt; None: its share of the period. What it takes longer, the rest at a is shorter."""
    pick_x_m: float = -0.159
    place_x_m: float = 0.159
    turn_rad: float = math.pi
    """The tool turns by this with the item, and back without."""
    payload_kg: float = 0.0
    """Mass of an item, carried from grasp to release."""
    enforce_motor_speed: bool = True
    """Whether a cycle is refused in which a motor would turn faster than it can."""
    dimensions: dict[str, float] = field(default_factory=dict)
    """Changed dimensions of the robot, m and rad."""

    @property
    def robot(self) -> str:
        return "fivebar"

    def build(self) -> Robot:
        return build_robot(self.robot, self.dimensions)

    @property
    def title(self) -> str:
        return f"Work cycle, belts at {self.belt_speed_m_s * 1e3:.0f} mm/s, stroke {self.stroke_m * 1e3:.0f} mm"

    @property
    def durations(self) -> tuple[float, ...]:
        """(9,) s of the segments; the last may be too short, which is for the planner to refuse."""
        transfer = TRANSFER * self.period_s if self.transfer_s is None else self.transfer_s
        stroke, grip = STROKE * self.period_s, GRIP * self.period_s
        half = (transfer, stroke, grip, stroke)
        return (*half, *half, self.period_s - 2.0 * sum(half))


CYCLES: dict[str, WorkCycle] = {
    "W1": WorkCycle(),
    "W2": WorkCycle(stroke_m=0.025, enforce_motor_speed=False),
}
"""The reference cycles. W2's stroke loads the screw as much as the paper reports, which its motor is too slow for."""
