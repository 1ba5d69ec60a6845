"""The drawing delta's machine: three arms, a star that only translates, and a pen.

The pen's tip hangs a little below the pose's point, which lies in the plane of the rod joints, so that the
joints clear the paper: see `tool_tip`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.delta3 import ARM_AZIMUTHS, Delta3
from app.robots.parts import arms, motors, rods, tools
from app.robots.parts import delta3_shapes as shapes
from app.robots.parts.machine import ORIGIN, Machine, RodPairs
from app.robots.parts.part import LEG, Body, Part, Placement
from app.robots.parts.rotary import RotaryArms

BALL_RADIUS = 0.0042
PEN_LENGTH = 0.105
LEGS = (0, 1, 2)
PAIRS = (0, 0, 1, 1, 2, 2)


class Delta3Machine(Machine):
    """See the module. Arms as in `RotaryArms`, rods as in `RodPairs`; the platform rides on the tool frame."""

    tool_tip = -0.010

    def __init__(self, robot: Delta3) -> None:
        g = self._geometry = robot.geometry
        self._rb, self._rp = g.f / (2 * math.sqrt(3)), g.e / (2 * math.sqrt(3))
        self.half_spacing = min(0.020, max(0.0105, 1.2 * self._rp))
        reach = g.rf + g.re
        self.floor = -math.sqrt(reach**2 - min(self._rb - self._rp, 0.9 * reach) ** 2) - 0.05
        self._arms = RotaryArms(ARM_AZIMUTHS, self._rb, g.rf, 0.0)
        self._rods = RodPairs(ARM_AZIMUTHS, self.half_spacing)
        self._corners = [(self._rp * math.cos(a), self._rp * math.sin(a)) for a in ARM_AZIMUTHS]
        self.bodies = (*self._fixed_bodies(), *self._moving_bodies(), self._platform())

    def place(self, pose: Sequence[float], joints: Sequence[float]) -> dict[str, Placement]:
        x, y, z = pose
        positions, turns, elbows = self._arms.place(joints)
        corners = [(x + cx, y + cy, z) for cx, cy in self._corners]
        return {"arms": Placement(positions, turns), "rods": self._rods.place(elbows, corners)}

    def _fixed_bodies(self) -> tuple[Body, ...]:
        g, rb = self._geometry, self._rb
        stand = (rb + g.rf + 0.09, self.floor)
        drive = max(0.012, min(0.080, rb - 0.030))
        gear, motor = 0.4 * drive, 0.6 * drive
        foot = max(0.008, min(0.040, 0.55 * rb - 0.02))
        return (
            Body(
                "stand",
                (
                    Part("spokes", "aluminium", shapes.spokes, stand[:1]),
                    Part("posts", "steel", shapes.posts, stand),
                    Part("stand_fittings", "motor", shapes.stand_fittings, stand),
                ),
                fixed=ORIGIN,
            ),
            Body(
                "base",
                (
                    Part("base_plate", "housing", shapes.base_plate, (rb,)),
                    Part("base_box", "accent", shapes.base_box, (rb,)),
                ),
                fixed=ORIGIN,
            ),
            Body(
                "drives",
                (
                    Part("bracket", "aluminium", motors.bracket, (shapes.PLATE_TOP, foot)),
                    Part("hub_shaft", "steel", arms.hub_shaft, ()),
                    Part("gearbox", "steel", motors.square_gearbox, (gear,)),
                    Part("motor", "motor", motors.motor, (gear, motor)),
                ),
                legs=LEGS,
                fixed=self._arms.level,
            ),
        )

    def _moving_bodies(self) -> tuple[Body, ...]:
        g, w, r = self._geometry, self.half_spacing, BALL_RADIUS
        return (
            Body("arms", (Part("arm", LEG, arms.arm, (g.rf, w, r)),), LEGS),
            Body(
                "rods",
                (
                    Part("rod", "carbon", rods.rod, (g.re, r)),
                    Part("rod_fittings", LEG, rods.rod_fittings, (g.re, r)),
                ),
                PAIRS,
            ),
        )

    def _platform(self) -> Body:
        star = (self._rp, self.half_spacing, BALL_RADIUS, ARM_AZIMUTHS)
        tip = self.tool_tip
        return Body(
            "platform",
            (
                Part("star", "aluminium", shapes.platform_star, star),
                Part("pen_clamp", "housing", shapes.pen_clamp, ()),
                Part("pen", "ink", tools.pen_body, (tip, PEN_LENGTH)),
                Part("pen_cone", "steel", tools.pen_cone, (tip,)),
                Part("pen_point", "rubber", tools.pen_point, (tip,)),
            ),
            frame="tool",
            fixed=ORIGIN,
        )
