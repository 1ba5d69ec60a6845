"""The Par4's machine.

The platform is drawn as it works: two bars that never turn, two links that turn by theta between them, and on
each link a belt wheel twice as large as the one on the tool's spindle, so that the tool turns by 2 theta.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.par4 import ARM_AZIMUTHS, Par4
from app.robots.parts import arms, motors, rods, tools
from app.robots.parts import par4_shapes as shapes
from app.robots.parts.machine import ORIGIN, Machine, RodPairs, quaternions, rows, standing, vectors
from app.robots.parts.part import LEG, Body, Part, Placement
from app.robots.parts.quaternions import IDENTITY, Quaternion, about_z
from app.robots.parts.rotary import RotaryArms

HALF_SPACING = 0.022
"""Half the distance between the two rods of a leg."""
BALL_RADIUS = 0.0052
LEGS = (0, 1, 2, 3)
PAIRS = (0, 0, 1, 1, 2, 2, 3, 3)


class Par4Machine(Machine):
    """See the module. The tool's tip is the tool point D.

    Body frames: arms as in `RotaryArms`, rods as in `RodPairs`; bars in the middle between their pivots, links
    at their pivot in the bar of legs 3 and 4 with y towards the other, belts on the tool's axis: these three
    in the plane of the rod joints.
    """

    def __init__(self, robot: Par4) -> None:
        g = self._geometry = robot.geometry
        self.floor = g.B_z - g.L * math.sin(max(g.q_max, 0.0)) - g.l - abs(g.P_z) - 0.08
        self._arms = RotaryArms(ARM_AZIMUTHS, g.R, g.L, g.B_z)
        self._rods = RodPairs(ARM_AZIMUTHS, HALF_SPACING)
        self._wheel_radius = min(0.015, 0.26 * g.d)
        self._bar_wxyzs = quaternions(about_z(math.pi) + IDENTITY)
        self._belts = standing((0.0, 0.0, g.P_z))
        self._platform_at: tuple[float, dict[str, Placement]] | None = None
        self.bodies = (*self._fixed_bodies(), *self._moving_bodies(), self._tool())

    def place(self, pose: Sequence[float], joints: Sequence[float]) -> dict[str, Placement]:
        g = self._geometry
        x, y, z, theta = pose
        top = z + g.P_z
        x12, y12 = x - g.h * math.sin(theta), y + g.h * math.cos(theta)
        along, north, south = 0.5 * g.d + g.d_i, y12 + g.h_i, y - g.h_i
        corners = (
            (x12 + along, north, top),
            (x12 - along, north, top),
            (x - along, south, top),
            (x + along, south, top),
        )
        positions, turns, elbows = self._arms.place(joints)
        return {
            "arms": Placement(positions, turns),
            "rods": self._rods.place(elbows, corners),
            **self._platform(theta),
        }

    def _platform(self, theta: float) -> dict[str, Placement]:
        """Bars, links and belts around the tool point; the very same arrays as long as theta stays."""
        if self._platform_at is None or self._platform_at[0] != theta:
            g = self._geometry
            top, half, turn = g.P_z, 0.5 * g.d, about_z(theta)
            swing = (-g.h * math.sin(theta), g.h * math.cos(theta), top)
            bodies = {
                "bars": Placement(vectors((*swing, 0.0, 0.0, top)), self._bar_wxyzs),
                "links": rows((half, 0.0, top, -half, 0.0, top), turn + turn),
                "belts": self._belts,
            }
            self._platform_at = (theta, bodies)
        return self._platform_at[1]

    def tool_frame(self, pose: Sequence[float]) -> tuple[tuple[float, float, float], Quaternion]:
        """The tool point D; the tool is turned by 2 theta."""
        return (pose[0], pose[1], pose[2]), about_z(2.0 * pose[3])

    def _fixed_bodies(self) -> tuple[Body, ...]:
        g = self._geometry
        stand = (g.R + g.L + 0.07, self.floor - g.B_z)
        drive = min(0.105, g.R - 0.055)
        gear, motor = 0.32 * drive, 0.68 * drive
        foot = min(0.050, 0.55 * g.R - 0.02)
        lifted = standing((0.0, 0.0, g.B_z))
        return (
            Body(
                "stand",
                (
                    Part("stand", "aluminium", shapes.stand, stand),
                    Part("stand_fittings", "motor", shapes.stand_fittings, stand),
                ),
                fixed=lifted,
            ),
            Body(
                "base",
                (
                    Part("base_plate", "housing", shapes.base_plate, (g.R,)),
                    Part("base_hanger", "housing", shapes.base_hanger, (g.R,)),
                    Part("base_pillars", "steel", shapes.base_pillars, (g.R,)),
                ),
                fixed=lifted,
            ),
            Body(
                "drives",
                (
                    Part("bracket", "aluminium", motors.bracket, (shapes.PLATE_TOP, foot)),
                    Part("hub_shaft", "steel", arms.hub_shaft, ()),
                    Part("gearbox", "steel", motors.round_gearbox, (gear,)),
                    Part("motor", "motor", motors.motor, (gear, motor)),
                    Part("motor_band", "accent", motors.motor_band, (gear, motor)),
                ),
                legs=LEGS,
                fixed=self._arms.level,
            ),
        )

    def _moving_bodies(self) -> tuple[Body, ...]:
        g = self._geometry
        w, r, wheel = HALF_SPACING, BALL_RADIUS, self._wheel_radius
        bar = (g.d, g.d_i, g.h_i, w, r, ARM_AZIMUTHS[2:])
        return (
            Body("arms", (Part("arm", LEG, arms.arm, (g.L, w, r)),), LEGS),
            Body(
                "rods",
                (
                    Part("rod", "carbon", rods.rod, (g.l, r)),
                    Part("rod_fittings", LEG, rods.rod_fittings, (g.l, r)),
                ),
                PAIRS,
            ),
            Body("bars", (Part("bar", "aluminium", shapes.platform_bar, bar),), (None, None), "platform"),
            Body("links", (Part("link", "steel", shapes.platform_link, (g.h, wheel)),), (None, None), "platform"),
            Body("belts", (Part("belts", "rubber", shapes.belts, (g.d, wheel)),), frame="platform"),
        )

    def _tool(self) -> Body:
        P_z = self._geometry.P_z
        low = P_z + shapes.WHEEL[0]
        height = low - 0.004
        if height < 0.018:
            parts = [Part("needle", "steel", tools.needle, (low,))]
        else:
            parts = [
                Part("gripper_body", "housing", tools.gripper_body, (height,)),
                Part("gripper_jaws", "aluminium", tools.gripper_jaws, (height,)),
                Part("gripper_pads", "rubber", tools.gripper_pads, (height,)),
                Part("gripper_mark", "accent", tools.gripper_mark, (height,)),
            ]
        spindle = Part("spindle", "steel", shapes.spindle, (self._wheel_radius, P_z, min(low, height)))
        return Body("tool", (*parts, spindle), frame="tool", fixed=ORIGIN)
