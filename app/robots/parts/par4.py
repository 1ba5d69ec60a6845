"""The Par4's machine.

The platform is drawn as it works: two bars that never turn, two links that turn by theta between them, and on
each link a belt wheel twice as large as the one on the tool's spindle, so that the tool turns by 2 theta.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.par4 import ARM_AZIMUTHS, Par4
from app.robots.parts import arms, motors, par4_shapes, rods
from app.robots.parts.machine import ORIGIN, Machine, RodPairs, quaternions, rows, standing, vectors
from app.robots.parts.part import LEG, Body, Part, Placement
from app.robots.parts.quaternions import IDENTITY, Quaternion, about_z, turned

HALF_SPACING = 0.022
"""Half the distance between the two rods of a leg."""
BALL_RADIUS = 0.0052
LEGS = (0, 1, 2, 3)
PAIRS = (0, 0, 1, 1, 2, 2, 3, 3)


class Par4Machine(Machine):
    """See the module. Moving bodies: arms, rods, bars, links, belts; the tool's spindle rides on the tool frame.

    Body frames: arms at the motor axis, x to the elbow, y along the hinge; rods as in `RodPairs`; bars in the
    middle between their pivots, in the plane of the rod joints; links at their pivot in the bar of legs 3
    and 4, y to the other pivot; belts at the spindle's axis in the plane of the rod joints.
    """

    def __init__(self, robot: Par4) -> None:
        g = robot.geometry
        self._geometry = g
        self.floor = g.B_z - g.L - g.l - 0.06
        self._rods = RodPairs(ARM_AZIMUTHS, HALF_SPACING)
        self._arms = [(math.cos(a), math.sin(a), about_z(a)) for a in ARM_AZIMUTHS]
        self._joint = (0.5 * g.d + g.d_i, g.h_i)
        self._arm_positions = vectors([v for ca, sa, _ in self._arms for v in (g.R * ca, g.R * sa, g.B_z)])
        self._bar_wxyzs = quaternions(about_z(math.pi) + IDENTITY)
        self._belt_wxyzs = quaternions(IDENTITY)
        self.bodies = (*self._fixed_bodies(), *self._moving_bodies(), self._tool())

    def place(self, pose: Sequence[float], joints: Sequence[float]) -> dict[str, Placement]:
        g = self._geometry
        x, y, z, theta = pose
        top = z + g.P_z
        swing_x, swing_y = -g.h * math.sin(theta), g.h * math.cos(theta)
        along, across = self._joint
        x12, y12 = x + swing_x, y + swing_y
        elbows, turns = [], []
        for (ca, sa, azimuth), q in zip(self._arms, joints, strict=True):
            reach = g.R + g.L * math.cos(q)
            elbows.append((reach * ca, reach * sa, g.B_z - g.L * math.sin(q)))
            turns += turned(azimuth, math.cos(0.5 * q), 0.0, math.sin(0.5 * q), 0.0)
        corners = (
            (x12 + along, y12 + across, top),
            (x12 - along, y12 + across, top),
            (x - along, y - across, top),
            (x + along, y - across, top),
        )
        half, turn = 0.5 * g.d, about_z(theta)
        return {
            "arms": Placement(self._arm_positions, quaternions(turns)),
            "rods": self._rods.place(elbows, corners),
            "bars": Placement(vectors((x12, y12, top, x, y, top)), self._bar_wxyzs),
            "links": rows((x + half, y, top, x - half, y, top), turn + turn),
            "belts": Placement(vectors((x, y, top)), self._belt_wxyzs),
        }

    def tool_frame(self, pose: Sequence[float]) -> tuple[tuple[float, float, float], Quaternion]:
        """The tool point D; the tool is turned by 2 theta."""
        return (pose[0], pose[1], pose[2]), about_z(2.0 * pose[3])

    def _fixed_bodies(self) -> list[Body]:
        g = self._geometry
        reach = g.R + g.L + 0.04
        lifted = standing((0.0, 0.0, g.B_z))
        motor_length = min(0.062, 0.5 * g.R)
        gearbox_length = min(0.030, 0.25 * g.R)
        wxyzs = [v for _, _, azimuth in self._arms for v in azimuth]
        stands = (reach, self.floor - g.B_z)
        return [
            Body(
                "stand",
                (
                    Part("stand", "aluminium", par4_shapes.stand, stands),
                    Part("stand_fittings", "motor", par4_shapes.stand_fittings, stands),
                ),
                fixed=lifted,
            ),
            Body(
                "base",
                (
                    Part("base_plate", "housing", par4_shapes.base_plate, (g.R,)),
                    Part("base_hanger", "housing", par4_shapes.hanger, (g.R,)),
                    Part("base_pillars", "steel", par4_shapes.base_pillars, (g.R,)),
                ),
                fixed=lifted,
            ),
            Body(
                "motors",
                (
                    Part("motor_bracket", "aluminium", motors.bracket, (par4_shapes.PLATE_TOP,)),
                    Part("motor_gearbox", "steel", motors.gearbox, (gearbox_length,)),
                    Part("motor", "motor", motors.motor, (gearbox_length, motor_length)),
                    Part("motor_label", "accent", motors.label, (gearbox_length, motor_length)),
                ),
                legs=LEGS,
                fixed=Placement(self._arm_positions, quaternions(wxyzs)),
            ),
        ]

    def _moving_bodies(self) -> list[Body]:
        g = self._geometry
        w, r = HALF_SPACING, BALL_RADIUS
        wheel = self._wheel_radius()
        studs = (g.d, g.d_i, g.h_i, w, r, ARM_AZIMUTHS[2], ARM_AZIMUTHS[3])
        return [
            Body(
                "arms",
                (
                    Part("arm", LEG, arms.arm, (g.L, w, r)),
                    Part("arm_hardware", "steel", arms.arm_hardware, (g.L, w, r)),
                ),
                legs=LEGS,
            ),
            Body(
                "rods",
                (
                    Part("rod", "carbon", rods.rod_tube, (g.l, r)),
                    Part("rod_fittings", LEG, rods.rod_fittings, (g.l, r)),
                ),
                legs=PAIRS,
            ),
            Body(
                "bars",
                (
                    Part("bar", "aluminium", par4_shapes.platform_bar, (g.d, g.d_i, g.h_i)),
                    Part("bar_studs", "steel", par4_shapes.platform_studs, studs),
                ),
                legs=(None, None),
            ),
            Body(
                "links",
                (
                    Part("link", "housing", par4_shapes.platform_link, (g.h,)),
                    Part("belt_wheel", "aluminium", par4_shapes.belt_wheel, (wheel,)),
                ),
                legs=(None, None),
            ),
            Body("belts", (Part("belts", "rubber", par4_shapes.belts, (g.d, wheel)),)),
        ]

    def _wheel_radius(self) -> float:
        """Of the belt wheels on the links; the spindle's has half of it."""
        return min(0.015, 0.26 * self._geometry.d)

    def _tool(self) -> Body:
        P_z = self._geometry.P_z
        height = P_z + par4_shapes.WHEEL[0] - 0.004
        wheel = self._wheel_radius()
        if height < 0.018:
            parts = [Part("needle", "steel", par4_shapes.needle, (P_z,))]
            height = P_z + par4_shapes.WHEEL[0]
        else:
            parts = [
                Part("gripper_body", "housing", par4_shapes.gripper_body, (height,)),
                Part("gripper_jaws", "aluminium", par4_shapes.gripper_jaws, (height,)),
                Part("gripper_pads", "rubber", par4_shapes.gripper_pads, (height,)),
                Part("gripper_mark", "accent", par4_shapes.gripper_mark, (height,)),
            ]
        parts.append(Part("spindle", "steel", par4_shapes.spindle, (wheel, P_z, height)))
        return Body("tool", tuple(parts), frame="tool", fixed=ORIGIN)
