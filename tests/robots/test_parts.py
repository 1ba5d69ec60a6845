"""The drawn machines: shapes are closed, loops close in the very numbers that are sent to the browser."""

from __future__ import annotations

import math
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from app.robots import ROBOTS, GeometryError, Robot, make_robot
from app.robots.parts import LEG, MATERIALS, Machine, Part, Placement, library, machine_of
from app.robots.parts.belts import BELT
from app.robots.parts.par4 import HALF_SPACING as PAR4_HALF_SPACING
from app.robots.parts.shading import split_sharp_edges

MESHES = Path(__file__).parents[2] / "meshes"
GAP = 1e-6
"""Loops close to this (metres)."""

VARIANTS: list[tuple[str, dict[str, Any]]] = [
    *((name, {}) for name in ROBOTS),
    ("par4", {"R": 0.12, "L": 0.26, "l": 0.45, "h": 0.05, "d": 0.08, "d_i": 0.02, "B_z": 0.03, "P_z": 0.055}),
    ("delta3", {"f": 0.4573, "e": 0.115, "rf": 0.112, "re": 0.232, "q_min": math.radians(-35.0)}),
    ("linear", {"S_A": 0.60, "U_A": 0.35, "W_A": 0.17, "l": 0.45, "s_p": 0.12}),
    ("fivebar", {"l_f": 0.12, "l_p": 0.20, "l_d": 0.28, "z_min": -0.05, "z_max": 0.08}),
]


@pytest.fixture(params=VARIANTS, ids=lambda variant: f"{variant[0]}-{len(variant[1])}")
def robot(request: pytest.FixtureRequest) -> Robot:
    name, dimensions = request.param
    return make_robot(name, **dimensions)


def dimensions_of(robot: Robot) -> Any:
    """The robot's own geometry, whose fields depend on the robot."""
    return robot.geometry


def reachable_poses(robot: Robot, count: int, seed: int = 1) -> NDArray[np.float64]:
    """Poses all over the workspace."""
    rng = np.random.default_rng(seed)
    spread = np.array([0.25, 0.25, 0.35, 3.0])[: robot.dof]
    poses = robot.home + rng.uniform(-1.0, 1.0, (200 * count, robot.dof)) * spread
    poses = poses[robot.reachable(poses)]
    assert len(poses) >= count
    return poses[:count]


def path(robot: Robot) -> Iterator[NDArray[np.float64]]:
    """Small steps on a closed curve through much of the workspace, turning where the robot can turn."""
    targets = reachable_poses(robot, 6, seed=5)
    for start, end in zip(targets, np.roll(targets, -1, axis=0), strict=True):
        for t in np.linspace(0.0, 1.0, 300, endpoint=False):
            yield robot.nearest(start + t * (end - start))


def rotated(wxyz: ArrayLike, point: ArrayLike) -> NDArray[np.float64]:
    """A point turned by a quaternion, as three.js does it: without normalising."""
    w, x, y, z = np.asarray(wxyz, dtype=float)
    columns = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.array(columns) @ np.asarray(point, dtype=float)


def where(placement: Placement, copy: int, point: ArrayLike) -> NDArray[np.float64]:
    """A point of one copy of a body, in the base frame."""
    return placement.positions[copy] + rotated(placement.wxyzs[copy], point)


def on_tool(machine: Machine, pose: NDArray[np.float64], point: ArrayLike) -> NDArray[np.float64]:
    """A point of the tool frame, in the base frame."""
    position, wxyz = machine.tool_frame(pose.tolist())
    return np.array(position, dtype=np.float32) + rotated(np.array(wxyz, dtype=np.float32), point)


def placed(robot: Robot, machine: Machine, pose: NDArray[np.float64]) -> dict[str, Placement]:
    values = pose.tolist()
    return machine.place(values, robot.solve(*values))


def close(one: ArrayLike, other: ArrayLike) -> bool:
    return float(np.linalg.norm(np.asarray(one) - np.asarray(other))) < GAP


def tangent(azimuth_deg: float) -> NDArray[np.float64]:
    a = math.radians(azimuth_deg)
    return np.array([-math.sin(a), math.cos(a), 0.0])


def part_named(machine: Machine, name: str) -> Part:
    return next(part for part in machine.parts if part.name == name)


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
    from app.robots.parts.machine import RodPairs

    pairs = RodPairs([0.3], 0.02)
    for lower in ((0.0, 0.0, -0.4), (1e-9, 0.0, -0.4), (0.0, 0.0, 0.4), (0.4, 0.0, 0.0)):
        placement = pairs.place([(0.0, 0.0, 0.0)], [lower])
        length = float(np.linalg.norm(lower))
        middle = 0.5 * (where(placement, 0, (0.0, 0.0, -length)) + where(placement, 1, (0.0, 0.0, -length)))
        assert close(middle, lower)


def test_shapes_are_closed_and_turned_inside_out_nowhere(robot: Robot) -> None:
    for part in machine_of(robot).parts:
        mesh = part.mesh()
        assert mesh.is_watertight, part.name
        assert mesh.is_winding_consistent, part.name
        assert all(body.volume > 0.0 for body in mesh.split(only_watertight=False)), part.name


@pytest.mark.parametrize("name", ROBOTS)
def test_shapes_stay_closed_at_the_ends_of_every_dimension(name: str) -> None:
    tried = 0
    for symbol, dimension in ROBOTS[name].geometry.dimensions().items():
        for value in (dimension.low, dimension.high):
            try:
                robot = make_robot(name, **dict[str, Any]({symbol: value}))
            except GeometryError:
                continue
            tried += 1
            for part in machine_of(robot).parts:
                mesh = part.mesh()
                assert len(mesh.faces) > 0, f"{symbol}={value}: {part.name}"
                assert mesh.is_watertight, f"{symbol}={value}: {part.name}"
    assert tried >= 5


def test_names_and_materials_are_known(robot: Robot) -> None:
    machine = machine_of(robot)
    names = [part.name for part in machine.parts]
    assert len(set(names)) == len(names)
    assert {part.material for part in machine.parts} <= {*MATERIALS, LEG}
    for body in machine.bodies:
        if any(part.material == LEG for part in body.parts):
            assert None not in body.legs


def test_changing_a_length_changes_only_the_parts_that_have_it() -> None:
    before, after = (set(machine_of(make_robot("par4", l=l)).parts) for l in (0.386, 0.40))
    assert {part.name for part in after - before} == {"rod", "rod_fittings", "stand", "stand_fittings"}


def test_machines_stand_on_their_floor(robot: Robot) -> None:
    machine = machine_of(robot)
    lowest = min(
        part.mesh().bounds[0, 2] + float(body.fixed.positions[:, 2].min())
        for body in machine.bodies
        if body.fixed is not None and body.frame == "base"
        for part in body.parts
    )
    assert lowest == pytest.approx(machine.floor, abs=1e-6)
    tool_low = min(part.mesh().bounds[0, 2] for body in machine.bodies if body.frame == "tool" for part in body.parts)
    assert tool_low == pytest.approx(machine.tool_tip, abs=1e-6)
    heights = reachable_poses(robot, 300)[:, 2]
    assert heights.min() + tool_low > machine.floor


def test_machines_have_a_sane_size() -> None:
    for name, low, high in (("par4", 0.7, 1.1), ("delta3", 0.5, 1.1), ("linear", 0.8, 1.2), ("fivebar", 0.3, 0.8)):
        machine = machine_of(make_robot(name))
        corners = []
        for body in machine.bodies:
            if body.fixed is None or body.frame == "tool":
                continue
            for part in body.parts:
                box = part.mesh().bounding_box.vertices
                corners += [where(body.fixed, copy, corner) for copy in range(len(body.legs)) for corner in box]
        size = np.ptp(np.array(corners), axis=0)
        assert low < size.max() < high, name


def test_sharp_edges_are_split_and_round_ones_are_not() -> None:
    import trimesh

    cube = trimesh.creation.box()
    vertices, faces = split_sharp_edges(cube.vertices, cube.faces)
    assert (len(vertices), len(faces)) == (24, 12)
    ball = trimesh.creation.icosphere(subdivisions=3)
    vertices, faces = split_sharp_edges(ball.vertices, ball.faces)
    assert len(vertices) == len(ball.vertices)
    assert np.allclose(vertices[faces], ball.vertices[ball.faces], atol=1e-6)


def test_arrays_draw_the_same_triangles_as_the_mesh(robot: Robot) -> None:
    for part in machine_of(robot).parts:
        mesh, (vertices, faces) = part.mesh(), part.arrays()
        assert vertices.dtype == np.float32
        assert faces.dtype == np.uint32
        assert np.allclose(vertices[faces], mesh.vertices[mesh.faces], atol=1e-6)


@pytest.mark.parametrize("name", ROBOTS)
def test_committed_meshes_are_what_the_code_builds(name: str) -> None:
    parts = machine_of(make_robot(name)).parts
    assert {path.stem for path in (MESHES / name).glob("*.glb")} == {part.name for part in parts}
    for part in parts:
        built, read = part.mesh(), library.load(name, part.name, MESHES)
        assert read.is_watertight, part.name
        assert np.allclose(read.bounds, built.bounds, atol=1e-6), part.name
        assert read.area == pytest.approx(built.area, rel=1e-4), part.name
        assert read.volume == pytest.approx(built.volume, rel=1e-3), part.name


def test_committed_meshes_are_small() -> None:
    assert sum(path.stat().st_size for path in MESHES.glob("*/*.glb")) < 600_000


def test_meshes_are_written_anew_without_leftovers(tmp_path: Path) -> None:
    stale = tmp_path / "par4" / "propeller.glb"
    stale.parent.mkdir()
    stale.write_bytes(b"")
    written = library.build_all(tmp_path)
    assert not stale.exists()
    assert sorted(written) == sorted(tmp_path.glob("*/*.glb"))
    assert library.load("par4", "arm", tmp_path).is_watertight
    with pytest.raises(FileNotFoundError, match="propeller"):
        library.load("par4", "propeller", tmp_path)


def test_kinematics_do_not_load_solid_modelling_and_drawing_does_not_load_trimesh() -> None:
    script = (
        "import sys; from app.robots import make_robot; robot = make_robot('par4');"
        "assert 'manifold3d' not in sys.modules;"
        "from app.robots.parts import machine_of; [part.arrays() for part in machine_of(robot).parts];"
        "assert 'trimesh' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True, cwd=MESHES.parent)
