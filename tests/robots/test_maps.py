"""Maps of the workspace against brute force over directions, symmetry, and the five-bar's specification."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from app.robots import ROBOTS, make_robot
from app.robots.dynamics import INERTIA, dynamics_of
from app.robots.fivebar import WORKING_BOX
from app.robots.limits import drive_limits
from app.robots.maps import MAPS, Mapped, MapSettings, WorkspaceMap, compute_map
from app.robots.slices import coverage, extent, heights, slice_poses

every_robot = pytest.mark.parametrize("name", ROBOTS)
COARSE = 0.02


def settings_for(name: str, quantity: str = "torque share", **values: object) -> MapSettings:
    settings = MapSettings(name, quantity=quantity, height_m=float(make_robot(name).home[2]) - 0.01, payload_kg=0.1)
    return replace(settings, **values)  # type: ignore[arg-type]


def some_poses(found: WorkspaceMap, count: int = 6) -> tuple[np.ndarray, np.ndarray]:
    """Poses (k, dof) at points of a map, and its values there."""
    rows, columns = np.nonzero(np.isfinite(found.values))
    some = np.random.default_rng(5).choice(len(rows), count, replace=False)
    robot = make_robot(found.settings.robot)
    poses = slice_poses(robot, found.x, found.y, found.settings.height_m, found.settings.rotation_rad)
    return poses[rows[some], columns[some]], found.values[rows[some], columns[some]]


@every_robot
def test_the_worst_direction_is_the_worst_of_many(name):
    settings = settings_for(name, acceleration=7.0)
    poses, values = some_poses(compute_map(settings, COARSE))
    robot = make_robot(name)
    dynamics = dynamics_of(robot, INERTIA[name].changed(payload=0.1))
    angles = np.linspace(0.0, 2.0 * math.pi, 721)
    wanted = np.zeros((len(angles), len(poses), robot.dof))
    wanted[..., 0], wanted[..., 1] = 7.0 * np.cos(angles)[:, None], 7.0 * np.sin(angles)[:, None]
    still = np.zeros_like(wanted)
    efforts = dynamics.inverse(np.broadcast_to(poses, wanted.shape), still, wanted)
    shares = np.abs(efforts / drive_limits(robot).effort).max(axis=(0, 2))
    assert values == pytest.approx(100.0 * shares, rel=2e-5)


@every_robot
def test_the_torque_of_a_joint_is_the_inverse_dynamics(name):
    settings = settings_for(name, "joint torque", vector=(3.0, -4.0, 2.0), joint=1, payload_kg=0.0)
    found = compute_map(settings, COARSE)
    poses, values = some_poses(found)
    robot = make_robot(name)
    for pose, value in zip(poses, values, strict=True):
        acceleration = np.array([3.0, -4.0, 2.0, 0.0][: robot.dof])
        assert value == pytest.approx(robot.inverse_dynamics(pose, np.zeros(robot.dof), acceleration)[1], rel=1e-9)
    assert found.unit == ("N" if name == "linear" else "N m")
    assert found.level == drive_limits(robot).effort[1]


@every_robot
def test_joint_speeds_are_those_of_a_small_step(name):
    settings = settings_for(name, "joint speed", speed=0.5)
    poses, values = some_poses(compute_map(settings, COARSE))
    robot, step = make_robot(name), 1e-6
    rates = []
    for angle in np.linspace(0.0, math.pi, 361):
        moved = poses.copy()
        moved[:, :2] += step * np.array([math.cos(angle), math.sin(angle)])
        rates.append((robot.inverse(moved) - robot.inverse(poses)) / step)
    worst = np.abs(0.5 * np.array(rates) / drive_limits(robot).speed).max(axis=(0, 2))
    assert values == pytest.approx(100.0 * worst, rel=1e-4)


@every_robot
def test_at_the_available_acceleration_a_drive_is_at_its_limit(name):
    mapped = Mapped(settings_for(name))
    poses, _ = some_poses(compute_map(mapped.settings, COARSE))
    for pose in poses[:, None]:
        limit = float(mapped.available_acceleration(pose)[0])
        share = MAPS["torque share"].measure(Mapped(replace(mapped.settings, acceleration=limit)), pose)
        assert share == pytest.approx(100.0, rel=1e-9)


def test_the_delta_looks_the_same_from_all_three_sides():
    robot, (c, s) = make_robot("delta3"), (math.cos(math.radians(120.0)), math.sin(math.radians(120.0)))
    poses, _ = some_poses(compute_map(settings_for("delta3"), COARSE), 12)
    turned = poses.copy()
    turned[:, 0], turned[:, 1] = c * poses[:, 0] - s * poses[:, 1], s * poses[:, 0] + c * poses[:, 1]
    mapped = Mapped(settings_for("delta3"))
    assert robot.reachable(turned).all()
    for name in ("torque share", "available", "joint speed", "conditioning"):
        measure = MAPS[name].measure
        assert measure(mapped, turned) == pytest.approx(measure(mapped, poses), rel=1e-9), name
    shape = compute_map(settings_for("delta3"), COARSE).values
    assert not np.allclose(shape, np.nanmean(shape), equal_nan=True, rtol=0.05), "a flat map proves no symmetry"


@pytest.mark.parametrize("name", ["delta3", "fivebar"])
@pytest.mark.parametrize("quantity", ["torque share", "available", "joint speed", "conditioning"])
def test_maps_mirror_left_and_right(name, quantity):
    found = compute_map(settings_for(name, quantity), COARSE)
    assert found.x == pytest.approx(-found.x[::-1], abs=1e-12)
    assert np.allclose(found.values, found.values[:, ::-1], rtol=1e-8, equal_nan=True)


def in_the_box(quantity: str, **values: object) -> np.ndarray:
    """Values of the five-bar's map all over its working box."""
    found = compute_map(MapSettings("fivebar", quantity=quantity, **values), 0.0025)  # type: ignore[arg-type]
    across, along = (np.linspace(low, high, 23) for low, high in WORKING_BOX)
    return np.array([found.at(x, y) for x in across for y in along])


def test_the_five_bars_box_has_the_figures_of_its_specification():
    """Section B5 of the specification; the map is linear between its points."""
    assert in_the_box("conditioning").max() == pytest.approx(3.82, rel=0.002)
    assert 0.896 * in_the_box("torque share", acceleration=11.3).max() == pytest.approx(37.6, rel=0.002)
    assert 0.078125 * in_the_box("joint speed", speed=1.16).max() == pytest.approx(9.24, rel=0.002)
    assert in_the_box("available").min() == pytest.approx(26.9, rel=0.002)


@every_robot
def test_the_map_ends_where_reach_ends(name):
    settings = settings_for(name, "conditioning")
    found, robot = compute_map(settings, 0.01), make_robot(name)
    rng = np.random.default_rng(2)
    places = np.tile(robot.home, (20_000, 1))
    places[:, :2] = rng.uniform(-1.0, 1.0, (len(places), 2))
    places[:, 2] = settings.height_m
    inside = places[robot.reachable(places), :2]
    assert len(inside) > 50
    assert (inside >= [found.x[0], found.y[0]]).all() and (inside <= [found.x[-1], found.y[-1]]).all()
    poses = slice_poses(robot, found.x, found.y, settings.height_m, 0.0)
    assert np.array_equal(np.isfinite(found.values), robot.reachable(poses))


def test_a_map_is_read_between_its_points():
    found = compute_map(settings_for("linear", "conditioning"), 0.01)
    r, c = (axis // 2 for axis in found.values.shape)
    (left, right), (near, far) = found.x[c : c + 2].tolist(), found.y[r : r + 2].tolist()
    corners = found.values[r : r + 2, c : c + 2]
    assert found.at(0.5 * (left + right), 0.5 * (near + far)) == pytest.approx(corners.mean())
    assert found.at(left, near) == pytest.approx(corners[0, 0])
    assert math.isnan(found.at(5.0, 0.0)) and math.isnan(found.at(*(float(axis[0]) for axis in (found.x, found.y))))


@every_robot
def test_heights_lie_within_reach(name):
    robot = make_robot(name)
    low, high = heights(robot)
    assert low < robot.home[2] < high
    for z in (low, 0.5 * (low + high), high):
        assert robot.reach([*robot.home[:2], z, 0.0][: robot.dof]).ok


@every_robot
def test_cells_at_the_edge_are_covered_in_part(name):
    """A coarse grid's covered area is that of a fine one."""
    robot = make_robot(name)
    z = float(robot.home[2])
    low, high = extent(robot, z, 0.0)
    areas = []
    for step in (0.012, 0.002):
        x, y = (np.arange(a, b, step) for a, b in zip(low, high, strict=True))
        shares = coverage(robot, x, y, z, 0.0)
        assert 0.0 <= shares.min() < 1e-9 and shares.max() == 1.0
        areas.append(shares.sum() * step**2)
    assert areas[0] == pytest.approx(areas[1], rel=0.005)


def test_a_slice_beyond_reach_is_empty():
    found = compute_map(MapSettings("delta3", quantity="conditioning", height_m=-3.0))
    assert np.isnan(found.values).all() and not found.beyond.any()
    low, high = extent(make_robot("delta3"), -3.0, 0.0)
    assert (low < high).all()


def test_a_payload_costs_torque_and_acceleration():
    light, heavy = (settings_for("linear", payload_kg=kg) for kg in (0.0, 1.0))
    pose = make_robot("linear").home[None]
    for quantity, sign in (("torque share", 1.0), ("available", -1.0)):
        measure = MAPS[quantity].measure
        assert sign * (measure(Mapped(heavy), pose) - measure(Mapped(light), pose)) > 1.0
