"""The three deltas as MuJoCo bodies: arms or carriages, rods, and what hangs from them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.robots.delta3 import Delta3
from app.robots.dynamics.inertia import Delta3Inertia, LinearInertia, Par4Inertia, RotaryInertia
from app.robots.linear import LinearDelta
from app.robots.par4 import Par4
from app.robots.parts import linear as linear_parts
from app.robots.parts import par4 as par4_parts
from app.robots.parts.delta3 import Delta3Machine
from app.robots.parts.quaternions import about_z
from app.robots.robot import Robot, Skeleton
from app.simulation.prototype.draft import Draft
from app.simulation.prototype.frames import Frame, about_y, product
from app.simulation.prototype.legs import Rod, add_rods, azimuths

UP, DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)


def add_linear(draft: Draft, robot: LinearDelta, inertia: LinearInertia, pose: Sequence[float]) -> None:
    """Carriages on slides, and a platform. Rods are bodies, whatever `inertia.lumped` says."""
    skeleton, joints = _configuration(robot, pose)
    carriages = [f"carriage{leg + 1}" for leg in range(3)]
    for name, joint, d, elbow, azimuth in zip(
        carriages, robot.joint_names, joints, skeleton.elbow.tolist(), azimuths(skeleton), strict=True
    ):
        # A sphere of 2 cm: a carriage never turns, so any inertia will do.
        round_ = (1e-4 * inertia.carriage_mass,) * 3
        draft.body(name, "world", Frame(tuple(elbow), about_z(azimuth)), mass=inertia.carriage_mass, inertia=round_)
        draft.joint(name, joint, DOWN, d, kind="slide")
    _add_platform(draft, robot, pose, inertia.platform_mass)
    rod = Rod(robot.geometry.l, inertia.rod_mass, inertia.rod_com, inertia.rod_inertia, linear_parts.HALF_SPACING)
    add_rods(draft, rod, skeleton, carriages, ["platform"] * 3)


def add_delta3(draft: Draft, robot: Delta3, inertia: Delta3Inertia, pose: Sequence[float]) -> None:
    """Three arms and a platform."""
    g = robot.geometry
    skeleton, joints = _configuration(robot, pose)
    arms = _add_arms(draft, robot, inertia, g.rf, skeleton, joints)
    _add_platform(draft, robot, pose, inertia.platform_mass)
    rod = Rod(g.re, inertia.rod_mass, inertia.rod_com, inertia.rod_inertia, Delta3Machine(robot).half_spacing)
    add_rods(draft, rod, skeleton, arms, ["platform"] * 3)


def add_par4(draft: Draft, robot: Par4, inertia: Par4Inertia, pose: Sequence[float]) -> None:
    """Four arms and the platform of two bars, two links and the spindle, which the belt turns by 2 theta."""
    g = robot.geometry
    skeleton, joints = _configuration(robot, pose)
    arms = _add_arms(draft, robot, inertia, g.L, skeleton, joints)
    _add_articulated_platform(draft, robot, inertia, pose)
    rod = Rod(g.l, inertia.rod_mass, inertia.rod_com, inertia.rod_inertia, par4_parts.HALF_SPACING)
    add_rods(draft, rod, skeleton, arms, ["far_bar", "far_bar", "near_bar", "near_bar"])


def _configuration(robot: Robot, pose: Sequence[float]) -> tuple[Skeleton, list[float]]:
    joints = list(robot.solve(*pose))
    return robot.skeleton(pose, joints), joints


def _add_arms(
    draft: Draft, robot: Robot, inertia: RotaryInertia, length: float, skeleton: Skeleton, joints: Sequence[float]
) -> list[str]:
    names = [f"arm{leg + 1}" for leg in range(len(joints))]
    about = inertia.arm_inertia
    for name, joint, q, base, azimuth in zip(
        names, robot.joint_names, joints, skeleton.base.tolist(), azimuths(skeleton), strict=True
    ):
        frame = Frame(tuple(base), product(about_z(azimuth), about_y(q)))
        centre = (inertia.arm_com * length, 0.0, 0.0)
        draft.body(name, "world", frame, mass=inertia.arm_mass, inertia=(0.0, about, about), centre=centre)
        draft.joint(name, joint, (0.0, 1.0, 0.0), q, armature=inertia.rotor_inertia)
    return names


def _add_platform(draft: Draft, robot: Robot, pose: Sequence[float], mass: float) -> None:
    """A platform that the rods keep level; its inertia plays no part."""
    x, y, z = map(float, pose)
    draft.body("platform", "world", Frame((x, y, z)), mass=mass, inertia=(1e-3 * mass,) * 3)
    draft.free("platform", robot.pose_names, (x, y, z))
    draft.body("tool", "platform", Frame((x, y, z)))


def _add_articulated_platform(draft: Draft, robot: Par4, inertia: Par4Inertia, pose: Sequence[float]) -> None:
    g = robot.geometry
    x, y, z, theta = map(float, pose)
    half, top, turn = 0.5 * g.d, z + g.P_z, about_z(theta)
    bar, link = inertia.bar_mass, inertia.link_inertia
    far = (x - g.h * math.sin(theta), y + g.h * math.cos(theta), top)
    draft.body("near_bar", "world", Frame((x, y, z)), mass=bar, inertia=(1e-3 * bar,) * 3, centre=(0.0, 0.0, g.P_z))
    draft.free("near_bar", robot.pose_names[:3], (x, y, z))
    for name, joint, side in (("link1", "theta", half), ("link2", "theta2", -half)):
        centre = (0.0, inertia.link_com * g.h, 0.0)
        frame = Frame((x + side, y, top), turn)
        draft.body(name, "near_bar", frame, mass=inertia.link_mass, inertia=(link, link, link), centre=centre)
        draft.joint(name, joint, UP, theta)
    draft.body("far_bar", "link1", Frame(far), mass=bar, inertia=(1e-3 * bar,) * 3)
    draft.joint("far_bar", "far_turn", UP, at=(half, 0.0, 0.0))
    draft.connect("link2", "far_bar", (0.0, g.h, 0.0))
    spindle, about = Frame((x, y, z), about_z(2.0 * theta)), (inertia.tool_inertia,) * 3
    draft.body("tool", "near_bar", spindle, mass=inertia.tool_mass, inertia=about)
    draft.joint("tool", "spindle", UP, 2.0 * theta)
    draft.hold_sum("belt", (("spindle", 1.0), ("theta", -2.0)))
