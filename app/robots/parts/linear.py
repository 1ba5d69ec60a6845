"""The linear delta's machine: three belt axes between two plates, six rods, a hub with a suction cup.

The pose's point lies in the middle of the platform, in the plane of its rod joints; the cup's lip hangs
below it, see `tool_tip`. At the lowest pose it touches the bottom plate.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.linear import RAIL_AZIMUTHS, LinearDelta
from app.robots.parts import linear_shapes as shapes
from app.robots.parts import rods, tools
from app.robots.parts.machine import ORIGIN, Machine, RodPairs, quaternions, vectors
from app.robots.parts.part import LEG, Body, Part, Placement
from app.robots.parts.quaternions import about_z
from app.robots.parts.stands import FOOT_HEIGHT

HALF_SPACING = 0.026
BALL_RADIUS = 0.0055
LEGS = (0, 1, 2)
PAIRS = (0, 0, 1, 1, 2, 2)


class LinearMachine(Machine):
    """See the module. A carriage's frame has its origin in the middle of its rod joints, x outward and y along
    the hinge; rods as in `RodPairs`; the platform rides on the tool frame."""

    tool_tip = -0.034

    def __init__(self, robot: LinearDelta) -> None:
        g = self._geometry = robot.geometry
        self.seen_from = (0.14, -0.95, 0.26)
        self.floor = g.z_min + self.tool_tip - shapes.PLATE - FOOT_HEIGHT
        self._joints = ((-g.S_A / 2, -g.W_A), (g.S_A / 2, -g.W_A), (0.0, g.U_A))
        self._corners = ((-g.s_p / 2, -g.w_p), (g.s_p / 2, -g.w_p), (0.0, g.u_b))
        self._rods = RodPairs(RAIL_AZIMUTHS, HALF_SPACING)
        self._carriage_wxyzs = quaternions([v for a in RAIL_AZIMUTHS for v in about_z(a)])
        self.bodies = (*self._fixed_bodies(), *self._moving_bodies(), self._platform())

    def place(self, pose: Sequence[float], joints: Sequence[float]) -> dict[str, Placement]:
        x, y, z = pose
        upper = [(ax, ay, -d) for (ax, ay), d in zip(self._joints, joints, strict=True)]
        lower = [(x + bx, y + by, z) for bx, by in self._corners]
        return {
            "carriages": Placement(vectors([v for joint in upper for v in joint]), self._carriage_wxyzs),
            "rods": self._rods.place(upper, lower),
        }

    def _columns(self) -> tuple[tuple[float, float], ...]:
        c = shapes.COLUMN
        return tuple(
            (x + c * math.cos(a), y + c * math.sin(a)) for (x, y), a in zip(self._joints, RAIL_AZIMUTHS, strict=True)
        )

    def _fixed_bodies(self) -> tuple[Body, ...]:
        columns = self._columns()
        high, low, thick = 0.085, self.floor + FOOT_HEIGHT + shapes.PLATE, shapes.PLATE
        axis = (high, low)
        top, bottom = (columns, high, high + thick, True), (columns, low - thick, low, False)
        plates = (
            Part("top_plate", "housing", shapes.end_plate, top, casts_shadow=False),
            Part("bottom_plate", "housing", shapes.end_plate, bottom, casts_shadow=False),
            Part("feet", "rubber", shapes.stand_feet, (columns, self.floor)),
        )
        positions = vectors([v for x, y in self._joints for v in (x, y, 0.0)])
        return (
            Body("frame", plates, fixed=ORIGIN),
            Body(
                "axes",
                (
                    Part("column", "aluminium", shapes.column, axis),
                    Part("guide_rail", "steel", shapes.guide_rail, axis),
                    Part("drive_belt", "rubber", shapes.drive_belt, axis),
                    Part("axis_ends", "housing", shapes.axis_ends, axis),
                    Part("axis_motor", "motor", shapes.axis_motor, axis),
                ),
                legs=LEGS,
                fixed=Placement(positions, self._carriage_wxyzs),
            ),
        )

    def _moving_bodies(self) -> tuple[Body, ...]:
        l, w, r = self._geometry.l, HALF_SPACING, BALL_RADIUS
        return (
            Body(
                "carriages",
                (
                    Part("carriage", LEG, shapes.carriage, (w, r)),
                    Part("carriage_shoes", "steel", shapes.carriage_shoes, ()),
                ),
                LEGS,
            ),
            Body(
                "rods",
                (
                    Part("rod", "carbon", rods.rod, (l, r)),
                    Part("rod_fittings", LEG, rods.rod_fittings, (l, r)),
                ),
                PAIRS,
            ),
        )

    def _platform(self) -> Body:
        plate = (self._corners, RAIL_AZIMUTHS, HALF_SPACING, BALL_RADIUS)
        return Body(
            "platform",
            (
                Part("platform_plate", "aluminium", shapes.platform_plate, plate),
                Part("tool_flange", "housing", shapes.tool_flange, ()),
                Part("suction_cup", "rubber", tools.suction_cup, (-0.009, self.tool_tip)),
            ),
            frame="tool",
            fixed=ORIGIN,
        )
