"""The five-bar's machine: two hollow driven links, two distal ones, and a screw spline through their joint.

The tool's tip is the pose's point, so the links' plane lies `lift` above the plane z = 0 in which the paper
(and `Robot.skeleton`) draws the linkage. Belts of equal wheels carry the turns of motors 3 and 4 through the
elbows: every wheel of leg 1 turns by q_4 and every wheel of leg 2 by q_3, whatever the links do.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.fivebar import FiveBar
from app.robots.parts import fivebar_shapes as shapes
from app.robots.parts import tools
from app.robots.parts.machine import Machine, rows, standing
from app.robots.parts.part import LEG, Body, Part, Placement
from app.robots.parts.quaternions import Quaternion, about_z

GRIPPER = 0.046
LEGS = (0, 1)
WHEELS = (0, 0, 0, 0, 1, 1, 1, 1)


class FiveBarMachine(Machine):
    """See the module. A link's frame lies in the links' plane, at the joint nearer to the motor, x along the
    link; leg 2's is turned over about x. A wheel's frame has its origin in the face nearer to that plane."""

    def __init__(self, robot: FiveBar) -> None:
        g = self._geometry = robot.geometry
        self.lift = g.z_max + GRIPPER + 0.085
        self.seen_from = (0.85, 0.30, 0.38)
        self.floor = g.z_min - 0.03
        self._motors = robot.linkage.motors
        self.bodies = (*self._fixed_bodies(), *self._moving_bodies(), self._tool())

    def place(self, pose: Sequence[float], joints: Sequence[float]) -> dict[str, Placement]:
        x, y = pose[0], pose[1]
        q1, q2, q3, q4 = joints
        l_p, lift = self._geometry.l_p, self.lift
        left, right = self._motors
        x1, y1 = left + l_p * math.cos(q1), l_p * math.sin(q1)
        x2, y2 = right + l_p * math.cos(q2), l_p * math.sin(q2)
        inner, outer = shapes.INNER_WHEEL[1], shapes.OUTER_WHEEL[0]
        above, below = lift + outer, lift + inner
        over, under = lift - inner, lift - outer
        wheels = (
            *(left, 0.0, below, x1, y1, below, x1, y1, above, x, y, above),
            *(right, 0.0, over, x2, y2, over, x2, y2, under, x, y, under),
        )
        ahead, turned = about_z(q4), _turned_over(q3)
        proximal = rows((left, 0.0, lift, right, 0.0, lift), about_z(q1) + _turned_over(q2))
        psi1, psi2 = _heading(x - x1, y - y1), _heading(x - x2, y - y2)
        return {
            "proximal": proximal,
            "distal": rows((x1, y1, lift, x2, y2, lift), about_z(psi1) + _turned_over(psi2)),
            "wheels": rows(wheels, _turned_over(q4) * 2 + ahead * 2 + about_z(q3) * 2 + turned * 2),
        }

    def tool_frame(self, pose: Sequence[float]) -> tuple[tuple[float, float, float], Quaternion]:
        """The gripper's tip, turned by phi."""
        return (pose[0], pose[1], pose[2]), about_z(pose[3])

    def _fixed_bodies(self) -> tuple[Body, ...]:
        l_f = self._geometry.l_f
        half, radius = 0.5 * l_f, min(0.045, 0.42 * l_f)
        floor = self.floor - self.lift
        low = max(-0.235, floor + 0.030)
        return (
            Body(
                "base",
                (
                    Part("pedestal", "housing", shapes.pedestal, (half, radius, floor)),
                    Part("foot_plate", "housing", shapes.foot_plate, (half, radius, floor), casts_shadow=False),
                    Part("gearboxes", "aluminium", shapes.gearboxes, (half, radius)),
                ),
                fixed=standing((0.0, 0.0, self.lift)),
            ),
            Body(
                "motors",
                (Part("motor", "motor", shapes.motor, (radius, low)),),
                legs=LEGS,
                fixed=standing((-half, 0.0, self.lift), (half, 0.0, self.lift)),
            ),
        )

    def _moving_bodies(self) -> tuple[Body, ...]:
        g = self._geometry
        return (
            Body(
                "proximal",
                (
                    Part("proximal_link", LEG, shapes.proximal_link, (g.l_p, min(0.033, 0.46 * g.l_f))),
                    Part("proximal_belt", "rubber", shapes.proximal_belt, (g.l_p,)),
                ),
                LEGS,
            ),
            Body(
                "distal",
                (
                    Part("distal_tube", "carbon", shapes.distal_tube, (g.l_d,)),
                    Part("distal_ends", LEG, shapes.distal_ends, (g.l_d,)),
                ),
                LEGS,
            ),
            Body("wheels", (Part("belt_wheel", "aluminium", shapes.belt_wheel, ()),), WHEELS),
        )

    def _tool(self) -> Body:
        g = self._geometry
        top = self.lift + shapes.OUTER_WHEEL[1] + 0.020 - g.z_min
        return Body(
            "tool",
            (
                Part("shaft", "steel", shapes.shaft, (GRIPPER, top)),
                Part("screw_groove", "motor", shapes.screw_groove, (GRIPPER + 0.010, top - 0.010, g.p)),
                Part("shaft_stops", "housing", shapes.shaft_stops, (GRIPPER, top)),
                Part("gripper_body", "housing", tools.gripper_body, (GRIPPER,)),
                Part("gripper_jaws", "aluminium", tools.gripper_jaws, (GRIPPER,)),
                Part("gripper_pads", "rubber", tools.gripper_pads, (GRIPPER,)),
                Part("gripper_mark", "accent", tools.gripper_mark, (GRIPPER,)),
            ),
            frame="tool",
            fixed=standing((0.0, 0.0, 0.0)),
        )


def _turned_over(angle: float) -> Quaternion:
    """Half a turn about x, then `angle` about z."""
    return (0.0, math.cos(0.5 * angle), math.sin(0.5 * angle), 0.0)


def _heading(x: float, y: float) -> float:
    """Direction of a vector; it jumps only where the vector points to -y."""
    return 0.5 * math.pi - math.atan2(x, y)
