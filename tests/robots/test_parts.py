"""The drawn machines move as the kinematics says: loops close in the very numbers that are sent to the browser."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from app.robots import ROBOTS, Robot, make_robot
from app.robots.parts import Placement, machine_of
from app.robots.parts.belts import BELT
from app.robots.parts.machine import RodPairs
from app.robots.parts.par4 import HALF_SPACING as PAR4_HALF_SPACING
from tests.support.machines import (
    VARIANTS,
    close,
    dimensions_of,
    on_tool,
    part_named,
    path,
    placed,
    reachable_poses,
    tangent,
    where,
)


@pytest.fixture(params=VARIANTS, ids=lambda variant: f"{variant[0]}-{len(variant[1])}")
def robot(request: pytest.FixtureRequest) -> Robot:
    name, dimensions = request.param
    return make_robot(name, **dimensions)


@pytest.mark.parametrize("dimensions", [values for name, values in VARIANTS if name == "par4"])
def test_par4_rods_run_from_the_arms_to_the_bars(dimensions: dict[str, Any]) -> None:
    robot = make_robot("par4", **dimensions)
    machine, g, w = machine_of(robot), dimensions_of(robot), PAR4_HALF_SPACING
    x = g.d / 2 + g.d_i
    # Legs 1 and 2 hold the first bar, which is turned by half a turn; 3 and 4 the second.
    studs = [(0, -x, 225.0), (0, x, 315.0), (1, -x, 225.0), (1, x, 315.0)]
    for pose in reachable_poses(robot, 40):
        bodies = placed(robot, machine, pose)
        for leg, (bar, stud_x, azimuth) in enumerate(studs):
            for side, rod in ((w, 2 * leg), (-w, 2 * leg + 1)):
                assert close(where(bodies["arms"], leg, (g.L, side, 0.0)), where(bodies["rods"], rod, (0.0, 0.0, 0.0)))
                stud = np.array([stud_x, -g.h_i, 0.0]) + side * tangent(azimuth)
                assert close(where(bodies["rods"], rod, (0.0, 0.0, -g.l)), where(bodies["bars"], bar, stud))


@pytest.mark.parametrize("dimensions", [values for name, values in VARIANTS if name == "par4"])
def test_par4_platform_is_a_parallelogram_that_turns_the_tool_twice_as_far(dimensions: dict[str, Any]) -> None:
    robot = make_robot("par4", **dimensions)
    machine, g = machine_of(robot), dimensions_of(robot)
    for pose in reachable_poses(robot, 40):
        bodies = placed(robot, machine, pose)
        for link, side in ((0, 1.0), (1, -1.0)):
            pivot = (side * g.d / 2, 0.0, 0.0)
            assert close(where(bodies["links"], link, (0.0, 0.0, 0.0)), where(bodies["bars"], 1, pivot))
            assert close(where(bodies["links"], link, (0.0, g.h, 0.0)), where(bodies["bars"], 0, np.negative(pivot)))
        assert close(on_tool(machine, pose, (0.0, 0.0, g.P_z)), where(bodies["belts"], 0, (0.0, 0.0, 0.0)))
        assert close(on_tool(machine, pose, (0.0, 0.0, 0.0)), pose[:3])
        pointer = on_tool(machine, pose, (1.0, 0.0, 0.0)) - on_tool(machine, pose, (0.0, 0.0, 0.0))
        assert math.atan2(pointer[1], pointer[0]) == pytest.approx(2.0 * pose[3], abs=1e-6)


def test_par4_belt_wheels_have_the_ratio_of_the_belt() -> None:
    robot = make_robot("par4")
    vertices = part_named(machine_of(robot), "belts").mesh().vertices
    belt = vertices[vertices[:, 2] > vertices[:, 2].mean()]
    large, small = belt[:, 0].max() - dimensions_of(robot).d / 2 - BELT, -belt[:, 0].min() - BELT
    assert large == pytest.approx(2.0 * small, rel=1e-6)


@pytest.mark.parametrize("dimensions", [values for name, values in VARIANTS if name == "delta3"])
def test_delta3_rods_run_from_the_arms_to_the_star(dimensions: dict[str, Any]) -> None:
    robot = make_robot("delta3", **dimensions)
    machine, g = machine_of(robot), dimensions_of(robot)
    rp, w = g.e / (2 * math.sqrt(3)), min(0.020, 1.2 * g.e / (2 * math.sqrt(3)))
    for pose in reachable_poses(robot, 40):
        bodies = placed(robot, machine, pose)
        for leg, azimuth in enumerate((270.0, 30.0, 150.0)):
            outward = rp * np.array([math.cos(math.radians(azimuth)), math.sin(math.radians(azimuth)), 0.0])
            for side, rod in ((w, 2 * leg), (-w, 2 * leg + 1)):
                assert close(where(bodies["arms"], leg, (g.rf, side, 0.0)), where(bodies["rods"], rod, (0.0, 0.0, 0.0)))
                stud = on_tool(machine, pose, outward + side * tangent(azimuth))
                assert close(where(bodies["rods"], rod, (0.0, 0.0, -g.re)), stud)


@pytest.mark.parametrize("dimensions", [values for name, values in VARIANTS if name == "linear"])
def test_linear_rods_run_from_the_carriages_to_the_platform(dimensions: dict[str, Any]) -> None:
    robot = make_robot("linear", **dimensions)
    machine, g, w = machine_of(robot), dimensions_of(robot), 0.026
    corners = [(-g.s_p / 2, -g.w_p, 0.0), (g.s_p / 2, -g.w_p, 0.0), (0.0, g.u_b, 0.0)]
    rails = next(body.fixed for body in machine.bodies if body.name == "axes")
    assert rails is not None
    for pose in reachable_poses(robot, 40):
        bodies, joints = placed(robot, machine, pose), robot.solve(*pose)
        for leg, azimuth in enumerate((210.0, 330.0, 90.0)):
            assert close(bodies["carriages"].positions[leg], rails.positions[leg] - np.array([0.0, 0.0, joints[leg]]))
            assert np.array_equal(bodies["carriages"].wxyzs[leg], rails.wxyzs[leg])
            for side, rod in ((w, 2 * leg), (-w, 2 * leg + 1)):
                top = where(bodies["carriages"], leg, (0.0, side, 0.0))
                assert close(top, where(bodies["rods"], rod, (0.0, 0.0, 0.0)))
                stud = on_tool(machine, pose, np.array(corners[leg]) + side * tangent(azimuth))
                assert close(where(bodies["rods"], rod, (0.0, 0.0, -g.l)), stud)


@pytest.mark.parametrize("dimensions", [values for name, values in VARIANTS if name == "linear"])
def test_linear_carriages_stay_on_their_rails(dimensions: dict[str, Any]) -> None:
    robot = make_robot("linear", **dimensions)
    machine = machine_of(robot)
    rail, shoes = part_named(machine, "guide_rail").mesh().bounds, part_named(machine, "carriage_shoes").mesh().bounds
    assert shoes[1, 2] < rail[1, 2]
    assert shoes[0, 2] - robot.joint_limits[:, 1].max() > rail[0, 2]


@pytest.mark.parametrize("dimensions", [values for name, values in VARIANTS if name == "fivebar"])
def test_fivebar_links_meet_in_the_elbows_and_on_the_shaft(dimensions: dict[str, Any]) -> None:
    robot = make_robot("fivebar", **dimensions)
    machine, g = machine_of(robot), dimensions_of(robot)
    for pose in reachable_poses(robot, 40):
        bodies = placed(robot, machine, pose)
        on_shaft = on_tool(machine, pose, (0.0, 0.0, machine.lift - pose[2]))
        for leg, motor in enumerate((-g.l_f / 2, g.l_f / 2)):
            elbow = where(bodies["proximal"], leg, (g.l_p, 0.0, 0.0))
            assert close(where(bodies["proximal"], leg, (0.0, 0.0, 0.0)), (motor, 0.0, machine.lift))
            assert close(where(bodies["distal"], leg, (0.0, 0.0, 0.0)), elbow)
            assert close(where(bodies["distal"], leg, (g.l_d, 0.0, 0.0)), on_shaft)
            wheels = bodies["wheels"].positions[4 * leg : 4 * leg + 4, :2]
            assert close(wheels, np.array([(motor, 0.0), elbow[:2], elbow[:2], pose[:2]]))


def test_fivebar_wheels_turn_like_the_nuts_they_drive() -> None:
    robot = make_robot("fivebar")
    machine = machine_of(robot)
    for pose in reachable_poses(robot, 40):
        wheels, joints = placed(robot, machine, pose)["wheels"], robot.solve(*pose)
        for copy, angle in enumerate([joints[3]] * 4 + [joints[2]] * 4):
            spoke = where(wheels, copy, (1.0, 0.0, 0.0)) - wheels.positions[copy]
            assert close(spoke, (math.cos(angle), math.sin(angle), 0.0))
        finger = on_tool(machine, pose, (1.0, 0.0, 0.0)) - on_tool(machine, pose, (0.0, 0.0, 0.0))
        assert close(finger, (math.cos(pose[3]), math.sin(pose[3]), 0.0))


@pytest.mark.parametrize("dimensions", [values for name, values in VARIANTS if name == "fivebar"])
def test_fivebar_shaft_reaches_through_both_nuts_at_either_end_of_its_travel(dimensions: dict[str, Any]) -> None:
    robot = make_robot("fivebar", **dimensions)
    machine, g = machine_of(robot), dimensions_of(robot)
    shaft, nut = part_named(machine, "shaft").mesh().bounds, part_named(machine, "distal_tube").mesh().bounds
    gripper = part_named(machine, "shaft_stops").mesh().vertices
    below = gripper[gripper[:, 2] < shaft[1, 2] / 2, 2].max()
    assert shaft[1, 2] + g.z_min > machine.lift + nut[1, 2]
    assert below + g.z_max < machine.lift - nut[1, 2]


def test_fivebar_groove_has_the_lead_of_the_screw() -> None:
    lead = 0.02
    machine = machine_of(make_robot("fivebar", p=lead))
    x, y, z = part_named(machine, "screw_groove").mesh().vertices.T
    outer = np.hypot(x, y) > np.hypot(x, y).max() - 1e-6
    along = z[outer] / lead - np.arctan2(y, x)[outer] / (2.0 * math.pi)
    from_first = np.mod(along - along[0] + 0.5, 1.0) - 0.5
    edges = np.unique(np.round(from_first, 5))
    assert len(edges) == 2
    assert np.ptp(edges) * lead == pytest.approx(0.004, rel=1e-3)


def test_drawn_joints_are_those_of_the_kinematics(robot: Robot) -> None:
    machine = machine_of(robot)
    lift = np.array([0.0, 0.0, machine.lift])
    for pose in reachable_poses(robot, 20):
        skeleton = robot.skeleton(pose.tolist(), robot.solve(*pose))
        bodies = placed(robot, machine, pose)
        driven = bodies[next(name for name in ("arms", "carriages", "proximal") if name in bodies)]
        assert close(driven.positions if robot.name != "linear" else skeleton.base, skeleton.base + lift)
        if "rods" in bodies:
            rods = bodies["rods"].positions.reshape(len(skeleton.elbow), 2, 3)
            across = rods[:, 0] - rods[:, 1]
            assert close(rods.mean(axis=1), skeleton.elbow)
            assert np.allclose(across / np.linalg.norm(across, axis=1, keepdims=True), skeleton.hinge, atol=1e-5)
        else:
            assert close(bodies["distal"].positions, skeleton.elbow + lift)


def test_every_moving_body_is_placed_and_no_other(robot: Robot) -> None:
    machine = machine_of(robot)
    bodies = placed(robot, machine, robot.home)
    home = robot.home.tolist()
    legs = len(robot.skeleton(home, robot.solve(*home)).base)
    moving = {body.name: body for body in machine.bodies if body.fixed is None}
    assert bodies.keys() == moving.keys()
    for body in machine.bodies:
        placement = bodies[body.name] if body.fixed is None else body.fixed
        assert placement.positions.shape == (len(body.legs), 3)
        assert placement.wxyzs.shape == (len(body.legs), 4)
        assert placement.positions.dtype == placement.wxyzs.dtype == np.float32
        assert np.allclose(np.linalg.norm(placement.wxyzs, axis=1), 1.0, atol=1e-6)
        assert all(leg is None or 0 <= leg < legs for leg in body.legs)


def test_few_moving_parts_cost_few_messages() -> None:
    moving = {
        name: sum(len(body.parts) for body in machine_of(make_robot(name)).bodies if body.fixed is None)
        for name in ROBOTS
    }
    assert moving["par4"] <= 6
    assert moving["delta3"] <= 4
    assert moving["linear"] <= 5
    assert moving["fivebar"] <= 6


def test_arrays_that_never_change_are_the_same_object() -> None:
    robot = make_robot("par4")
    machine = machine_of(robot)
    first, second = (placed(robot, machine, pose) for pose in reachable_poses(robot, 2))
    assert first["arms"].positions is second["arms"].positions
    assert first["bars"].wxyzs is second["bars"].wxyzs
    assert first["arms"].wxyzs is not second["arms"].wxyzs


def test_machines_move_continuously(robot: Robot) -> None:
    machine = machine_of(robot)
    before: dict[str, Placement] | None = None
    for pose in path(robot):
        now = placed(robot, machine, pose)
        if before is not None:
            for name, placement in now.items():
                assert np.abs(placement.positions - before[name].positions).max() < 0.02, name
                if name != "wheels":
                    assert np.abs(placement.wxyzs - before[name].wxyzs).max() < 0.1, name
        before = now


def test_a_rod_may_hang_straight_down_or_point_up() -> None:
    pairs = RodPairs([0.3], 0.02)
    for lower in ((0.0, 0.0, -0.4), (1e-9, 0.0, -0.4), (0.0, 0.0, 0.4), (0.4, 0.0, 0.0)):
        placement = pairs.place([(0.0, 0.0, 0.0)], [lower])
        length = float(np.linalg.norm(lower))
        middle = 0.5 * (where(placement, 0, (0.0, 0.0, -length)) + where(placement, 1, (0.0, 0.0, -length)))
        assert close(middle, lower)
