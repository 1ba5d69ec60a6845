"""The board's kinematics, in floats of 4 bytes, against `app.robots`."""

from __future__ import annotations

import ctypes
import math

import numpy as np
import pytest

from app.link.board_geometry import BOARD_ROBOTS, geometry_values
from app.link.emulated.compiled import load_library
from app.robots import ROBOTS, Robot, make_robot
from tests.support.tools import needs

pytestmark = needs("gcc")

ROBOTS_TRIED = [(name, preset) for name, entry in ROBOTS.items() for preset in entry.presets]

Four = ctypes.c_float * 4


class BoardKinematics:
    def __init__(self, robot: Robot) -> None:
        self.kind, self.joints = BOARD_ROBOTS[robot.name], len(robot.joint_names)
        self.geometry = (ctypes.c_float * 23)(*geometry_values(robot))

    def inverse(self, pose: list[float]) -> list[float] | None:
        found = Four()
        closes = load_library().dl_inverse(self.kind, self.geometry, Four(*pose), found)
        return list(found)[: self.joints] if closes else None

    def forward(self, joints: list[float], steps: int, start: list[float] | None = None) -> list[float]:
        pose = Four(*(start or ()))
        if start is None:
            load_library().dl_forward_guess(self.kind, self.geometry, Four(*joints), pose)
        for _ in range(steps):
            load_library().dl_forward_step(self.kind, self.geometry, Four(*joints), pose)
        return list(pose)


def reachable_poses(robot: Robot, count: int) -> np.ndarray:
    """(count, dof) all over the workspace."""
    random = np.random.default_rng(5)
    size = np.array([0.25, 0.25, 0.25, 1.0])[: robot.dof]
    poses = robot.home + random.uniform(-size, size, (40 * count, robot.dof))
    poses = poses[robot.reachable(poses)]
    assert len(poses) >= count
    return poses[:count]


@pytest.mark.parametrize(("name", "preset"), ROBOTS_TRIED)
def test_inverse_is_that_of_the_robot(name, preset):
    robot = make_robot(name, preset=preset)
    board = BoardKinematics(robot)
    poses = reachable_poses(robot, 200)
    found = np.array([board.inverse(pose.tolist()) for pose in poses])
    np.testing.assert_allclose(found, robot.inverse(poses), rtol=0.0, atol=2e-5)


@pytest.mark.parametrize("name", ROBOTS)
def test_a_pose_out_of_reach_has_no_joints(name):
    robot = make_robot(name)
    board = BoardKinematics(robot)
    for far in (5.0, math.inf, math.nan):
        assert board.inverse([far, 0.1, -0.3, 0.0][: robot.dof]) is None


@pytest.mark.parametrize(("name", "preset"), ROBOTS_TRIED)
def test_forward_finds_the_assembly_of_the_machine_from_its_own_guess(name, preset):
    robot = make_robot(name, preset=preset)
    board = BoardKinematics(robot)
    poses = reachable_poses(robot, 100)
    found = np.array([board.forward(joints, 30)[: robot.dof] for joints in robot.inverse(poses).tolist()])
    np.testing.assert_allclose(found, poses, rtol=0.0, atol=2e-4)


@pytest.mark.parametrize("name", ROBOTS)
def test_one_step_of_newton_is_enough_for_a_jog(name):
    """10 mm apart, one step leaves less than 0.6 mm: a speed limit that is right to 6 percent."""
    robot = make_robot(name)
    board = BoardKinematics(robot)
    start = robot.home
    for direction in np.eye(3):
        pose = start.copy()
        pose[:3] += 0.01 * direction
        found = board.forward(robot.inverse(pose).tolist(), 1, [*start.tolist(), 0.0, 0.0][:4])
        assert np.linalg.norm(np.array(found[:3]) - pose[:3]) < 6e-4
