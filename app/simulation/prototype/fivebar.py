"""The 5R robot as MuJoCo bodies: two arms, two rods, a carrier in their common joint with both nuts, the screw.

The rods meet on the carrier, which slides in x and y and never turns: the belts hand the turns of motors 3 and 4
through the elbows whatever the links do, so that the nuts turn by q_3 and q_4 themselves.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.dynamics.inertia import FiveBarInertia
from app.robots.fivebar import FiveBar
from app.robots.parts.fivebar import FiveBarMachine
from app.robots.parts.quaternions import about_z
from app.simulation.prototype.draft import Draft
from app.simulation.prototype.frames import Frame, Vector

UP = (0.0, 0.0, 1.0)
WEIGHTLESS = 1e-12
"""kg of the nuts, whose mass the paper counts to the screw's, and of the carrier."""
WHEEL_MASS, WHEEL_INERTIA = 1e-6, 1e-9
"""kg and kg m^2: next to nothing, as the paper gives the belts' wheels no masses of their own."""


def add_fivebar(draft: Draft, robot: FiveBar, inertia: FiveBarInertia, pose: Sequence[float]) -> None:
    """The whole robot, its links as high above the tool's tip as they are drawn."""
    x, y, z, phi = map(float, pose)
    joints = robot.solve(x, y, z, phi)
    lift = FiveBarMachine(robot).lift
    for k in (0, 1):
        _add_leg(draft, robot, inertia, k, joints[k], (x, y, lift))
    draft.body("carrier", "world", Frame((x, y, lift)), mass=WEIGHTLESS)
    for name, axis, value in (("x", (1.0, 0.0, 0.0), x), ("y", (0.0, 1.0, 0.0), y)):
        draft.joint("carrier", name, axis, value, kind="slide")
    for name, joint, q in (("nut3", "q3", joints[2]), ("nut4", "q4", joints[3])):
        frame = Frame((x, y, lift), about_z(q))
        draft.body(name, "carrier", frame, mass=WEIGHTLESS, inertia=(inertia.nut_inertia,) * 3)
        draft.joint(name, joint, UP, q, armature=inertia.nut_drive)
    about = (inertia.tool_inertia,) * 3
    draft.body("tool", "carrier", Frame((x, y, z), about_z(phi)), mass=inertia.tool_mass, inertia=about)
    draft.joint("tool", "z", UP, z, kind="slide")
    draft.joint("tool", "phi", UP, phi)
    _close_loops(draft, robot)


def _add_leg(draft: Draft, robot: FiveBar, inertia: FiveBarInertia, k: int, q: float, tool: Vector) -> None:
    """Arm and rod of leg k, counted from 0; `tool` is where the rod ends."""
    g, arm, rod = robot.geometry, f"proximal{k + 1}", f"distal{k + 1}"
    motor: Vector = (robot.linkage.motors[k], 0.0, tool[2])
    elbow: Vector = (motor[0] + g.l_p * math.cos(q), g.l_p * math.sin(q), tool[2])
    psi = math.atan2(tool[1] - elbow[1], tool[0] - elbow[0])
    about, centre = (inertia.proximal_inertia,) * 3, (inertia.proximal_com * g.l_p, 0.0, 0.0)
    draft.body(arm, "world", Frame(motor, about_z(q)), mass=inertia.proximal_mass, inertia=about, centre=centre)
    draft.joint(arm, robot.joint_names[k], UP, q, armature=inertia.arm_drive)
    about, centre = (inertia.distal_inertia,) * 3, (inertia.distal_com * g.l_d, 0.0, 0.0)
    draft.body(rod, arm, Frame(elbow, about_z(psi)), mass=inertia.distal_mass, inertia=about, centre=centre)
    draft.joint(rod, f"elbow{k + 1}", UP)


def _close_loops(draft: Draft, robot: FiveBar) -> None:
    """Both rods end on the carrier; phi = q_4 and z = p / (2 pi) (q_4 - q_3)."""
    for rod in ("distal1", "distal2"):
        draft.connect(rod, "carrier", (robot.geometry.l_d, 0.0, 0.0))
    lead = robot.geometry.p / math.tau
    draft.hold_sum("spline", (("phi", 1.0), ("q4", -1.0)))
    draft.hold_sum("screw", (("z", 1.0), ("q4", -lead), ("q3", lead)))


def add_wheels(draft: Draft, robot: FiveBar, pose: Sequence[float]) -> None:
    """The belts' wheels on motors and elbows, to be looked at: those of leg 1 turn by q_4, those of leg 2 by q_3,
    whatever the links do. The wheels in the tool's axis are the nuts'."""
    joints = robot.solve(*pose)
    for k, nut in ((0, 3), (1, 2)):
        arm, drive, q = f"q{k + 1}", f"q{nut + 1}", joints[nut]
        at_motor, at_elbow = draft.frames[f"proximal{k + 1}"].position, draft.frames[f"distal{k + 1}"].position
        for name, parent, place, terms in (
            (f"motor_wheel{k + 1}", "world", at_motor, ()),
            (f"elbow_wheel{k + 1}", f"proximal{k + 1}", at_elbow, ((arm, 1.0),)),
        ):
            draft.body(name, parent, Frame(place, about_z(q)), mass=WHEEL_MASS, inertia=(WHEEL_INERTIA,) * 3)
            draft.joint(name, name, UP, q)
            draft.hold_sum(f"{name}_belt", ((name, 1.0), *terms, (drive, -1.0)))
