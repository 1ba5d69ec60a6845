"""What a board holds of its robot's geometry: enough for its kinematics, and told apart by a hash."""

from __future__ import annotations

import math
import struct
import zlib

import numpy as np
import pytest

from app.link.board_geometry import BOARD_ROBOTS, geometry_hash, geometry_values, robot_from_geometry
from app.link.protocol.codes import RobotKind
from app.link.protocol.settings import GEOMETRY_SIZE
from app.robots import ROBOTS, Robot, make_robot
from tests.support.machines import VARIANTS, reachable_poses

ROBOT_VARIANTS = [pytest.param(make_robot(name, **sizes), id=f"{name}-{len(sizes)}") for name, sizes in VARIANTS]


def rotary(v: tuple[float, ...], pose: list[float], leg: int) -> float:
    """The equation of PROTOCOL.md, of whose two roots the elbow's farther outside is taken."""
    L, l, height = v[:3]
    ca, sa, a_x, a_y, link = v[3 + 5 * leg : 8 + 5 * leg]
    x, y, z, theta = (*pose, 0.0)[:4]
    u = np.array([x + a_x - link * math.sin(theta), y + a_y + link * math.cos(theta), z + height])
    out = u[0] * ca + u[1] * sa
    E, F, G = 2 * L * u[2], -2 * L * out, u @ u + L * L - l * l
    middle, half = math.atan2(E, F), math.acos(-G / math.hypot(E, F))
    roots = [math.remainder(middle + side * half, math.tau) for side in (1, -1)]
    return max(roots, key=lambda q: -u[2] * math.cos(q) - out * math.sin(q))


def linear(v: tuple[float, ...], pose: list[float], leg: int) -> float:
    zx, zy = v[1 + 2 * leg : 3 + 2 * leg]
    return -pose[2] - math.sqrt(v[0] ** 2 - (pose[0] - zx) ** 2 - (pose[1] - zy) ** 2)


@pytest.mark.parametrize("robot", ROBOT_VARIANTS)
def test_the_documented_formulas_give_our_joints(robot: Robot):
    values = geometry_values(robot)
    for pose in reachable_poses(robot, 50):
        joints, p = robot.inverse(pose), pose.tolist()
        if robot.name == "fivebar":
            assert values[3] * p[2] == pytest.approx(joints[3] - joints[2], abs=1e-12)
            for motor, q in zip((-values[0], values[0]), joints, strict=False):
                elbow = np.array([motor + values[1] * math.cos(q), values[1] * math.sin(q)])
                assert np.linalg.norm(pose[:2] - elbow) == pytest.approx(values[2], abs=1e-12)
            continue
        formula = linear if robot.name == "linear" else rotary
        for leg, q in enumerate(joints):
            assert formula(values, p, leg) == pytest.approx(q, abs=1e-9)


@pytest.mark.parametrize("robot", ROBOT_VARIANTS)
def test_a_robot_is_found_in_the_boards_numbers(robot: Robot):
    """As a board holds them, in four bytes; where several robots share them, one with the same kinematics."""
    held = struct.unpack("<23f", struct.pack("<23f", *geometry_values(robot)))
    found = robot_from_geometry(BOARD_ROBOTS[robot.name], held)
    assert found is not None and found.name == robot.name
    poses = reachable_poses(robot, 30)
    np.testing.assert_allclose(found.inverse(poses), robot.inverse(poses), atol=3e-6)


@pytest.mark.parametrize(
    ("name", "preset"), [(name, preset) for name, entry in ROBOTS.items() for preset in entry.presets]
)
def test_every_preset_comes_back_exactly(name: str, preset: str):
    robot = make_robot(name, preset=preset)
    found = robot_from_geometry(BOARD_ROBOTS[name], geometry_values(robot))
    assert found is not None and found.geometry == robot.geometry


def test_legs_that_differ_are_no_robot_of_ours():
    for name in ("par4", "delta3", "linear"):
        values = list(geometry_values(make_robot(name)))
        values[5] += 1e-3
        assert robot_from_geometry(BOARD_ROBOTS[name], values) is None


@pytest.mark.parametrize("values", [[0.0] * 23, [math.nan] * 23, [1e9] * 23, [0.1] * 5])
@pytest.mark.parametrize("kind", RobotKind)
def test_nonsense_is_no_robot(kind: RobotKind, values: list[float]):
    assert robot_from_geometry(kind, values) is None


def test_the_hash_is_the_crc_of_the_floats_and_notices_a_tenth_of_a_millimetre():
    values = geometry_values(make_robot("par4"))
    assert len(values) == GEOMETRY_SIZE
    image = b"".join(struct.pack("<f", value) for value in values)
    assert geometry_hash(values) == zlib.crc32(image)
    hashes = {geometry_hash(geometry_values(make_robot(name, **sizes))) for name, sizes in VARIANTS}
    hashes |= {geometry_hash(geometry_values(make_robot("par4", l=0.386 + k * 1e-4))) for k in range(1, 9)}
    assert len(hashes) == len(VARIANTS) + 8
