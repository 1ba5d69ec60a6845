"""Joints of a pose and back, from the 23 numbers that a board holds, in plain floats."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from app.link.protocol.codes import RobotKind
from app.robots.fivebar_linkage import Linkage
from app.robots.rotary_arm import outer_angle_scalar

Inverse = Callable[[Sequence[float]], tuple[float, ...]]
"""Pose (4) -> joints (n); NaN where a loop cannot close."""

LEGS, LEG_SIZE = 3, 5
SINGULAR = 1e-6
LONGEST_STEP = 0.1
"""m or rad: from the middle Newton's method then does not jump to another assembly."""


def inverse(kind: RobotKind, geometry: Sequence[float]) -> Inverse:
    """The inverse kinematics of this robot with this geometry (23)."""
    if kind == RobotKind.LINEAR:
        return _linear(geometry)
    return _fivebar(geometry) if kind == RobotKind.FIVEBAR else _rotary(geometry, 4 if kind == RobotKind.PAR4 else 3)


def _rotary(geometry: Sequence[float], legs: int) -> Inverse:
    L, l, height = geometry[:LEGS]
    rows = [tuple(geometry[LEGS + LEG_SIZE * leg :][:LEG_SIZE]) for leg in range(legs)]
    constant = L * L - l * l

    def joints(pose: Sequence[float]) -> tuple[float, ...]:
        x, y, z = pose[:3]
        theta = pose[3] if legs == 4 else 0.0
        s, c, u_z = math.sin(theta), math.cos(theta), z + height
        found = []
        for ca, sa, a_x, a_y, link in rows:
            u_x, u_y = x + a_x - link * s, y + a_y + link * c
            G = u_x * u_x + u_y * u_y + u_z * u_z + constant
            found.append(outer_angle_scalar(2 * L * u_z, -2 * L * (u_x * ca + u_y * sa), G))
        return tuple(found)

    return joints


def _linear(geometry: Sequence[float]) -> Inverse:
    l2 = geometry[0] * geometry[0]
    rails = [(geometry[1 + 2 * leg], geometry[2 + 2 * leg]) for leg in range(3)]

    def joints(pose: Sequence[float]) -> tuple[float, ...]:
        x, y, z = pose[:3]
        squares = [l2 - (x - zx) * (x - zx) - (y - zy) * (y - zy) for zx, zy in rails]
        return tuple([-z - math.sqrt(h2) if h2 >= 0.0 else math.nan for h2 in squares])

    return joints


def _fivebar(geometry: Sequence[float]) -> Inverse:
    half, l_p, l_d, turn = geometry[:4]
    linkage = Linkage((-half, half), l_p, l_d)

    def joints(pose: Sequence[float]) -> tuple[float, ...]:
        x, y, z, phi = pose
        return linkage.arm_angle(0, x, y), linkage.arm_angle(1, x, y), phi - turn * z, phi

    return joints


def forward_guess(kind: RobotKind, geometry: Sequence[float], joints: Sequence[float]) -> list[float]:
    """A pose (4) somewhere in the middle, from which Newton's method finds the assembly that the machine is in."""
    if kind == RobotKind.LINEAR:
        return [0.0, 0.0, -0.8 * geometry[0] - sum(joints) / 3.0, 0.0]
    if kind != RobotKind.FIVEBAR:
        return [0.0, 0.0, -geometry[2] - 0.8 * geometry[1], 0.0]
    l_p, l_d = geometry[1:3]
    x = 0.5 * l_p * (math.cos(joints[0]) + math.cos(joints[1]))
    y = 0.5 * l_p * (math.sin(joints[0]) + math.sin(joints[1])) + 0.7 * l_d
    return [x, y, 0.0, 0.0]


def forward_step(kind: RobotKind, geometry: Sequence[float], joints: Sequence[float], pose: list[float]) -> float:
    """One step of Newton's method on |rod|^2 = l^2 moves the pose towards that of the joints.

    Returns:
        how far it went, m and rad together; NaN where the rods do not determine it, and the pose stays.
    """
    if kind == RobotKind.FIVEBAR:
        pose[2:] = [(joints[3] - joints[2]) / geometry[3], joints[3]]
        rows = _fivebar_rods(geometry, joints, pose)
    elif kind == RobotKind.LINEAR:
        rows = _linear_rods(geometry, joints, pose)
    else:
        rows = _rotary_rods(geometry, joints, pose)
    step = _solved(rows)
    longest = max(map(abs, step))
    if not math.isfinite(longest):
        return math.nan
    share = LONGEST_STEP / longest if longest > LONGEST_STEP else 1.0
    for coordinate, change in enumerate(step):
        pose[coordinate] += share * change
    return share * longest


def _rotary_rods(geometry: Sequence[float], joints: Sequence[float], pose: Sequence[float]) -> list[list[float]]:
    """One equation a rod: the rod, how the half of its length's square changes with the turn if the platform has one,
    and by how much that half is too small."""
    L, l, height = geometry[:LEGS]
    theta = pose[3] if len(joints) == 4 else 0.0
    s, c = math.sin(theta), math.cos(theta)
    rows = []
    for leg, q in enumerate(joints):
        ca, sa, a_x, a_y, link = geometry[LEGS + LEG_SIZE * leg : LEGS + LEG_SIZE * (leg + 1)]
        out = L * math.cos(q)
        x, y = pose[0] + a_x - link * s - out * ca, pose[1] + a_y + link * c - out * sa
        z = pose[2] + height + L * math.sin(q)
        turning = [-link * (x * c + y * s)] if len(joints) == 4 else []
        rows.append([x, y, z, *turning, 0.5 * (l * l - x * x - y * y - z * z)])
    return rows


def _linear_rods(geometry: Sequence[float], joints: Sequence[float], pose: Sequence[float]) -> list[list[float]]:
    rows, l = [], geometry[0]
    for leg, d in enumerate(joints):
        x, y, z = pose[0] - geometry[1 + 2 * leg], pose[1] - geometry[2 + 2 * leg], pose[2] + d
        rows.append([x, y, z, 0.5 * (l * l - x * x - y * y - z * z)])
    return rows


def _fivebar_rods(geometry: Sequence[float], joints: Sequence[float], pose: Sequence[float]) -> list[list[float]]:
    half, l_p, l_d = geometry[:3]
    rows = []
    for motor, q in ((-half, joints[0]), (half, joints[1])):
        x, y = pose[0] - motor - l_p * math.cos(q), pose[1] - l_p * math.sin(q)
        rows.append([x, y, 0.5 * (l_d * l_d - x * x - y * y)])
    return rows


def _solved(rows: list[list[float]]) -> list[float]:
    """Gauss with pivots; NaN where the rows (n, n + 1) do not determine the n unknowns."""
    n = len(rows)
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        pivot = rows[k]
        if not abs(pivot[k]) > SINGULAR:
            return [math.nan] * n
        for i in range(n):
            if i != k:
                factor = rows[i][k] / pivot[k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], pivot, strict=True)]
    return [row[n] / row[k] for k, row in enumerate(rows)]
