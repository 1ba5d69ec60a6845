"""The ghosts of a comparison: errors drawn larger, each robot in its law's colour."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from app.robots import ROBOTS, build_robot
from app.robots.parts import machine_of
from app.simulation.controlled_run import ControlledRun
from app.ui import theme
from app.ui.compare.magnified import LONGEST_ERROR_M, ghost, pleasant_factor, worst_error_m
from app.ui.ghost_nodes import GhostNodes
from app.ui.shape_cache import ShapeCache


def off_by(robot_name: str, error: list[float]) -> ControlledRun:
    """A robot that stands still at home, `error` beside it."""
    robot = build_robot(robot_name, {})
    wanted = robot.home
    pose = wanted + np.array([*error, *[0.0] * (robot.dof - len(error))])
    return cast(ControlledRun, SimpleNamespace(pose_ref=wanted[None], pose=pose[None], q=robot.inverse(pose)[None]))


@pytest.mark.parametrize("name", ROBOTS)
def test_an_error_is_drawn_larger_and_the_joints_fit(name: str):
    robot, run = build_robot(name, {}), off_by(name, [1e-4, -2e-4, 1e-4])
    pose, joints = ghost(robot, run, 0, 50.0)
    assert np.subtract(pose, run.pose_ref[0])[:3] == pytest.approx([5e-3, -1e-2, 5e-3])
    assert robot.forward(np.array(joints)) == pytest.approx(pose, abs=1e-9)


def test_a_large_error_is_drawn_as_it_is_and_a_medium_one_only_so_far():
    robot = build_robot("delta3", {})
    large, medium = off_by("delta3", [0.0, 0.0, -0.12]), off_by("delta3", [0.0, 0.0, -0.01])
    assert np.subtract(ghost(robot, medium, 0, 500.0)[0], medium.pose_ref[0])[2] == pytest.approx(-LONGEST_ERROR_M)
    assert np.subtract(ghost(robot, large, 0, 500.0)[0], large.pose_ref[0])[2] == pytest.approx(-0.12)


def test_out_of_reach_it_is_drawn_as_it_was():
    robot = build_robot("fivebar", {})
    far = robot.home + [0.0, 0.1, 0.0, 0.0]
    pose = far + [0.0, 2e-3, 0.0, 0.0]
    run = cast(ControlledRun, SimpleNamespace(pose_ref=far[None], pose=pose[None], q=robot.inverse(pose)[None]))
    assert ghost(robot, run, 0, 1000.0) == (run.pose[0].tolist(), run.q[0].tolist())
    assert ghost(robot, run, 0, 2.0)[0] != run.pose[0].tolist(), "where it is in reach it is magnified"


def test_the_first_factor_makes_the_worst_error_seen():
    assert worst_error_m(off_by("linear", [2.8e-3])) == pytest.approx(2.8e-3)
    assert pleasant_factor(2.8e-3) == 10 and pleasant_factor(2e-6) == 1000 and pleasant_factor(0.09) == 1


class Scene:
    """Keeps what viser would have drawn."""

    def __init__(self) -> None:
        self.nodes: dict[str, Any] = {}

    def add_batched_meshes_simple(self, name: str, *_: Any, **values: Any) -> Any:
        self.nodes[name] = SimpleNamespace(**values, remove=lambda: self.nodes.pop(name))
        return self.nodes[name]


def test_each_ghost_is_wholly_in_its_own_colour():
    robot, shapes, scene = build_robot("linear", {}), ShapeCache(), Scene()
    shapes.learn(robot)
    machine = machine_of(robot)
    home = robot.home.tolist(), robot.inverse(robot.home).tolist()
    nodes = GhostNodes(cast(Any, scene), shapes, "/ghosts", lambda part, leg: theme.TRACE, 0.4)
    tints = [theme.law_color("PD"), theme.law_color("CTC")]
    nodes.show(machine, [home, home], tints)
    assert scene.nodes
    for node in scene.nodes.values():
        half = len(node.batched_colors) // 2
        assert (node.batched_colors[:half] == tints[0]).all() and (node.batched_colors[half:] == tints[1]).all()
    before = list(scene.nodes.values())
    nodes.show(machine, [home, home], tints)
    assert list(scene.nodes.values()) == before, "moving them makes nothing anew"
    nodes.show(machine, [home, home], tints[::-1])
    assert all((node.batched_colors[0] == tints[1]).all() for node in scene.nodes.values())
    nodes.show(machine, [home])
    assert all((node.batched_colors == theme.TRACE).all() for node in scene.nodes.values())
