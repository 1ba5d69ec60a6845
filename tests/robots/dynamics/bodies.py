"""The robots as bodies, without any equation of motion: what moves, how heavy it is, and where.

A rigid body is its mass at its centre and its inertia times what turns: a joint angle, or the direction of a rod
that does not spin. Velocities are differences of positions; Lagrange's equations make forces of the energies.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from app.robots import Robot
from app.robots.dynamics import GRAVITY, Delta3Inertia, Dynamics, FiveBarInertia, LinearInertia, Par4Inertia
from app.robots.fivebar import FiveBar
from app.robots.par4 import Par4
from app.robots.robot import Array, Skeleton

Masses = list[tuple[float, Array]]
"""Weights and the coordinates whose velocities they weigh."""


def bodies(dynamics: Dynamics, pose: Array) -> tuple[Masses, Masses]:
    """Masses (kg) at points (3,), and inertias (kg m^2) of angles or directions, at one pose."""
    robot, inertia = dynamics.robot, dynamics.inertia
    joints = robot.inverse(pose)
    skeleton = robot.skeleton(pose.tolist(), joints.tolist())
    if isinstance(inertia, LinearInertia):
        points, spins = _rods(skeleton, inertia.rod_mass, inertia.rod_com, inertia.rod_inertia, 2)
        points += [(inertia.carriage_mass, elbow) for elbow in skeleton.elbow]
        return [*points, (inertia.platform_mass + inertia.payload, pose)], spins
    if isinstance(inertia, FiveBarInertia):
        return _fivebar(robot, inertia, skeleton, pose, joints)
    assert isinstance(inertia, Delta3Inertia | Par4Inertia)
    points, spins = _rods(skeleton, inertia.rod_mass, inertia.rod_com, inertia.rod_inertia, 2)
    arms = skeleton.base + inertia.arm_com * (skeleton.elbow - skeleton.base)
    points += [(inertia.arm_mass, arm) for arm in arms]
    spins.append((inertia.arm_inertia + inertia.rotor_inertia, joints))
    if isinstance(inertia, Delta3Inertia):
        return [*points, (inertia.platform_mass + inertia.payload, pose)], spins
    more_points, more_spins = _platform(robot, inertia, pose)
    return points + more_points, spins + more_spins


def _rods(skeleton: Skeleton, mass: float, com: float, inertia: float, count: int) -> tuple[Masses, Masses]:
    points, spins = [], []
    for elbow, end in zip(skeleton.elbow, skeleton.platform, strict=True):
        points.append((count * mass, (1 - com) * elbow + com * end))
        spins.append((count * inertia, (end - elbow) / np.linalg.norm(end - elbow)))
    return points, spins


def _fivebar(
    robot: Robot, inertia: FiveBarInertia, skeleton: Skeleton, pose: Array, joints: Array
) -> tuple[Masses, Masses]:
    assert isinstance(robot, FiveBar)
    points, spins = _rods(skeleton, inertia.distal_mass, inertia.distal_com, inertia.distal_inertia, 1)
    arms = skeleton.base + inertia.proximal_com * (skeleton.elbow - skeleton.base)
    points += [(inertia.proximal_mass, arm) for arm in arms]
    points.append((inertia.tool_mass + inertia.payload, pose[:3]))
    spins.append((inertia.proximal_inertia + inertia.arm_drive, joints[:2]))
    spins.append((inertia.nut_inertia + inertia.nut_drive, joints[2:]))
    spins.append((inertia.tool_inertia, pose[3:]))
    return points, spins


def _platform(robot: Robot, inertia: Par4Inertia, pose: Array) -> tuple[Masses, Masses]:
    assert isinstance(robot, Par4)
    theta, h = float(pose[3]), robot.geometry.h
    near = pose[:3]
    far = near + h * np.array([-math.sin(theta), math.cos(theta), 0.0])
    link = (1 - inertia.link_com) * near + inertia.link_com * far
    points = [
        (inertia.bar_mass, near),
        (inertia.bar_mass, far),
        (2 * inertia.link_mass, link),
        (inertia.tool_mass + inertia.payload, near),
    ]
    return points, [(2 * inertia.link_inertia, pose[3:]), (inertia.tool_inertia, 2 * pose[3:])]


def derivative(f: Callable[[float], Array], step: float) -> Array:
    """f'(0), error of the order step^4."""
    return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step)


def mass_matrix(dynamics: Dynamics, pose: Array) -> Array:
    """(dof, dof) of the kinetic energy 1/2 v^T M v = 1/2 sum of weight |d coordinate / dt|^2."""

    def coordinates(at: Array) -> Array:
        return np.concatenate([np.sqrt(weight) * values for group in bodies(dynamics, at) for weight, values in group])

    units = np.eye(len(pose))
    columns = [derivative(lambda s, u=unit: coordinates(pose + s * u), 2e-4) for unit in units]
    return np.array(columns) @ np.array(columns).T


def potential_energy(dynamics: Dynamics, pose: Array) -> float:
    points, _ = bodies(dynamics, pose)
    return sum(GRAVITY * weight * float(point[2]) for weight, point in points)


def gravity(dynamics: Dynamics, pose: Array) -> Array:
    """(dof,) gradient of the potential energy."""
    units = np.eye(len(pose))
    return np.array(
        [derivative(lambda s, u=u: np.array(potential_energy(dynamics, pose + s * u)), 5e-4) for u in units]
    )


def bias(dynamics: Dynamics, pose: Array, rate: Array) -> Array:
    """(dof,) d/dt dT/dv - dT/dp + dV/dp without acceleration."""
    changes = np.array(
        [derivative(lambda s, u=unit: mass_matrix(dynamics, pose + s * u), 4e-4) for unit in np.eye(len(pose))]
    )
    momentum = np.einsum("kij,k,j->i", changes, rate, rate)
    return momentum - 0.5 * np.einsum("kij,i,j->k", changes, rate, rate) + gravity(dynamics, pose)
