"""Machines with known faults, measured with known noise, are found again, as often and as closely as is claimed."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from app.link.board_geometry import geometry_values
from app.link.calibration.identifiability import unseparated
from app.link.calibration.measurements import Measurements
from app.link.calibration.next_poses import next_poses
from app.link.calibration.problem import FRAME, KINEMATIC, Problem, make_problem
from app.link.calibration.report import board_settings, choices, csv, rows, sentences
from app.link.calibration.solve import Solution, solve
from app.link.errors import LinkError
from app.link.protocol.settings import GEOMETRY_ID, GEOMETRY_SIZE, setting_id
from app.robots import ROBOTS, build_robot, make_robot

Array = NDArray[np.float64]

DIMENSIONS = {"par4": ("L", "l"), "delta3": ("f", "rf", "re"), "linear": ("l", "U_A"), "fivebar": ("l_p", "l_d")}
ALL_FRAME = tuple(name for name, _ in FRAME)


def problem_of(robot: str, **options) -> Problem:
    return make_problem(robot, **{"dimensions": DIMENSIONS[robot], "frame": ALL_FRAME, **options})


def true_values(problem: Problem, seed: int) -> Array:
    """A machine as likely as the tolerances say."""
    return problem.assumed + problem.tolerances * np.random.default_rng(seed).normal(size=len(problem.unknowns))


def measured(problem: Problem, true: Array, count: int, seed: int = 0) -> Measurements:
    """What the machine of these values would measure, written out from the meaning of each unknown.

    Poses of the true machine -> its joints by its inverse kinematics -> what its wrong offsets report.
    """
    known = {u.name: float(v) for u, v in zip(problem.unknowns, true, strict=True)}
    changed = {name: known[name] for name in KINEMATIC[problem.robot] if name in known}
    robot, rng = build_robot(problem.robot, {**problem.dimensions, **changed}), np.random.default_rng(seed)
    spread = rng.uniform(-1.0, 1.0, (20 * count, robot.dof)) * ([0.08, 0.06, 0.03, 0.5][: robot.dof])
    poses = robot.home + spread
    poses = poses[robot.reachable(poses)][:count]
    offsets = np.array([known.get(f"offset {name}", 0.0) for name in robot.joint_names])
    x, y, z, turn = (known.get(name, 0.0) for name in ALL_FRAME)
    c, s = math.cos(turn), math.sin(turn)
    tool = poses[:, :3] @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) + [x, y, z]
    tool += rng.normal(0.0, problem.noise_m, tool.shape)
    angle = None
    if robot.dof == 4:
        angle = poses[:, 3] + turn + rng.normal(0.0, problem.angle_noise, len(poses))
    return Measurements.of(problem.robot, robot.inverse(poses) - offsets, tool, angle)


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_jacobian_is_the_slope_of_the_forward_kinematics(robot):
    problem = problem_of(robot, dimensions=KINEMATIC[robot])
    true = problem.assumed + 0.3 * problem.tolerances
    joints = measured(problem, true, 6).joints
    jacobian = problem.jacobian(true, joints)
    for k in range(len(true)):
        step = np.zeros(len(true))
        step[k] = 1e-6
        slope = (problem.predict(true + step, joints) - problem.predict(true - step, joints)) / 2e-6
        np.testing.assert_allclose(jacobian[:, :, k], slope, atol=1e-5 * max(1.0, np.abs(slope).max()))


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_wrong_machine_is_found_within_what_is_claimed(robot):
    problem = problem_of(robot)
    true = true_values(problem, 5)
    found = solve(problem, measured(problem, true, 25, 6))
    assert found.trusted and not found.outliers
    assert (np.abs(found.values - true) < 3.5 * found.deviations).all()
    assert np.median(found.shrinkage) < 0.3
    assert found.tool_rms_m == pytest.approx(problem.noise_m, rel=0.4)


@pytest.mark.parametrize(("robot", "trials"), [("delta3", 60), ("par4", 25)])
def test_the_intervals_hold_the_truth_95_times_in_100(robot, trials):
    problem = problem_of(robot)
    hits = []
    for seed in range(trials):
        true = true_values(problem, seed)
        low, high = solve(problem, measured(problem, true, 12, 1000 + seed)).intervals.T
        hits.append((low <= true) & (true <= high))
    assert 0.88 <= np.mean(hits) <= 0.99


def test_without_noise_the_machine_comes_out_exactly():
    problem = make_problem("delta3", dimensions=("rf", "re"), noise_m=1e-7)
    true = true_values(problem, 3)
    np.testing.assert_allclose(solve(problem, measured(problem, true, 20)).values, true, atol=1e-6)


def test_what_was_assumed_counts_where_nothing_was_measured():
    """The screw's nut q4 does not move the tool: without a measured angle it keeps its tolerance, at its prior."""
    problem = make_problem("fivebar", frame=("frame z",))
    data = measured(problem, problem.assumed, 10)
    found = solve(problem, Measurements.of("fivebar", data.joints, data.tool_m))
    place = [u.name for u in problem.unknowns].index("offset q4")
    assert found.shrinkage[place] > 0.95
    assert abs(found.values[place]) < 0.3 * problem.tolerances[place]


def groups(found: Solution) -> dict[frozenset[str], str]:
    return {frozenset(group.names): group.sentence for group in unseparated(found.problem, found.information)}


@pytest.mark.parametrize(
    ("robot", "dimensions", "tolerances", "together"),
    [
        ("delta3", ("f", "e"), {"f": 2e-3}, "f − e"),
        ("par4", ("B_z", "P_z"), {}, "B_z − P_z"),
        ("par4", ("d", "d_i"), {"d_i": 3e-3}, "d + 2 d_i"),
        ("linear", ("U_A", "u_b"), {}, "U_A − u_b"),
        ("linear", ("S_A", "s_p"), {"s_p": 4e-3}, "S_A − s_p"),
    ],
)
def test_dimensions_that_only_show_together_are_named(robot, dimensions, tolerances, together):
    """By construction: the kinematics hold only these combinations."""
    problem = make_problem(robot, dimensions=dimensions, tolerances=tolerances)
    found = solve(problem, measured(problem, problem.assumed, 25))
    assert together in groups(found)[frozenset(dimensions)]
    assert abs(found.correlation[-1, -2]) > 0.5
    assert any(together in sentence for sentence in sentences(found))
    alone = make_problem(robot, dimensions=dimensions[:1], tolerances={dimensions[0]: 2e-3})
    assert groups(solve(alone, measured(alone, alone.assumed, 25))) == {}


def test_carriages_and_the_rulers_height_are_one_group():
    tolerances = {f"offset d{k}": 0.02 for k in (1, 2, 3)}
    problem = make_problem("linear", frame=("frame z",), tolerances=tolerances)
    found = solve(problem, measured(problem, problem.assumed, 20))
    (names, sentence), *others = groups(found).items()
    assert names == {"offset d1", "offset d2", "offset d3", "frame z"} and not others
    assert "only 3 combinations show" in sentence


def test_a_number_that_does_not_show_at_all_is_named():
    problem = make_problem("fivebar", offsets=False, dimensions=("l_p", "l_d"), frame=("frame turn",))
    data = measured(problem, problem.assumed, 8)
    lone = Measurements.of("fivebar", np.repeat(data.joints[:1], 8, axis=0), np.repeat(data.tool_m[:1], 8, axis=0))
    assert len(groups(solve(problem, lone))) == 1
    alone = make_problem("par4", dimensions=("R", "h"), tolerances={"h": 1e-9})
    named = groups(solve(alone, measured(alone, alone.assumed, 20)))
    assert "say nothing about h" in named[frozenset({"h"})]


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_wrong_row_is_named_and_the_fit_not_trusted(robot):
    problem = problem_of(robot)
    true = true_values(problem, 7)
    data = measured(problem, true, 16, 8)
    tool = data.tool_m.copy()
    tool[4] += [0.0, 0.004, 0.0]
    bad = Measurements.of(robot, data.joints, tool, data.angle)
    found = solve(problem, bad)
    assert found.outliers == (5,) and not found.trusted
    assert "Row 5 does not fit" in sentences(found)[0]
    with pytest.raises(LinkError, match="not to be trusted"):
        board_settings(found, {})
    gentle = solve(problem, bad, robust=True)
    assert gentle.trusted and gentle.outliers == (5,)
    assert (np.abs(gentle.values - true) < 4.0 * gentle.deviations).all()
    without = solve(problem, bad.without([5]))
    assert without.trusted and without.outliers == ()


@pytest.mark.parametrize("row", range(6))
def test_a_wrong_row_is_named_also_where_the_fit_follows_it(row):
    """Of few rows each pulls the fit towards itself."""
    problem = make_problem("delta3", dimensions=("re",), frame=("frame x", "frame y", "frame z"))
    data = measured(problem, problem.assumed, 6, 4)
    tool = data.tool_m.copy()
    tool[row] += [0.0012, 0.0, 0.0012]
    assert solve(problem, Measurements.of("delta3", data.joints, tool)).outliers == (row + 1,)


def test_a_machine_that_is_another_one_is_not_believed():
    """Tool coordinates measured in inches do not pass for a badly built delta."""
    problem = problem_of("delta3")
    data = measured(problem, problem.assumed, 15)
    found = solve(problem, Measurements.of("delta3", data.joints, data.tool_m * [1.0, 1.1, 1.0]))
    assert not found.trusted
    assert any("do not fit" in sentence for sentence in sentences(found))


def test_good_machines_are_seldom_suspected():
    problem = problem_of("delta3")
    solved = [solve(problem, measured(problem, true_values(problem, s), 12, s)) for s in range(20)]
    assert sum(found.trusted for found in solved) >= 19


def test_joints_that_stand_only_in_the_true_machine_are_no_obstacle():
    """Near the end of its platform's turn the assumed Par4 cannot stand where the true one did."""
    problem = make_problem("par4", frame=("frame x", "frame y", "frame z"), tolerances={})
    true = problem.assumed + problem.tolerances * np.array([-1.0, -1.0, 1.0, -1.0, 0.0, 0.0, 0.0])
    data = measured(problem, true, 30)
    edge = make_robot("par4").inverse([[0.0, -0.036, -0.3, 0.7], [0.0, -0.036, -0.3, -0.7]])
    joints = np.vstack([data.joints, edge - true[:4]])
    assert np.isnan(problem.poses(problem.assumed, joints)).any()
    tool = np.vstack([data.tool_m, [[0.0, -0.036, -0.3]] * 2])
    found = solve(problem, Measurements.of("par4", joints, tool))
    assert found.trusted
    assert (np.abs(found.values - true) < 3.5 * found.deviations).all()


def test_impossible_joints_and_too_few_rows_are_refused():
    problem = problem_of("delta3")
    data = measured(problem, problem.assumed, 12)
    joints = data.joints.copy()
    joints[6] = [0.82, -1.38, -2.75]  # rods do not meet, whatever a calibration could change
    with pytest.raises(LinkError, match="Row 7: the robot cannot stand"):
        solve(problem, Measurements.of("delta3", joints, data.tool_m))
    with pytest.raises(LinkError, match="at least 4 poses"):
        solve(problem, data.rows([0, 1, 2]))
    with pytest.raises(LinkError, match="of delta3, not of par4"):
        solve(problem_of("par4"), data)


def test_the_next_poses_help_more_than_others():
    problem = problem_of("delta3")
    first = solve(problem, measured(problem, problem.assumed, 5))
    best = next_poses(problem, first.values, first.information, count=5)
    robot = problem.build(first.values)
    assert robot.reachable(best.pose).all()
    offsets = first.values[:3]
    np.testing.assert_allclose(robot.forward(best.joints + offsets), best.pose, atol=1e-8)

    def volume(joints: Array) -> float:
        """log determinant of the covariance after measuring there too, by the normal equations."""
        A = problem.jacobian(first.values, joints)[:, :3].reshape(-1, len(problem.unknowns)) / problem.noise_m
        return float(-np.linalg.slogdet(np.linalg.inv(first.covariance) + A.T @ A)[1])

    rng = np.random.default_rng(2)
    low, high = robot.joint_limits.T
    drawn = rng.uniform(low, high, (400, 3))
    drawn = drawn[robot.reachable(np.nan_to_num(robot.forward(drawn), nan=9.0))]
    others = [volume(drawn[rng.choice(len(drawn), 5, replace=False)] - offsets) for _ in range(200)]
    assert volume(best.joints) < np.quantile(others, 0.02)
    A = problem.jacobian(first.values, best.joints)[:, :3].reshape(-1, len(problem.unknowns)) / problem.noise_m
    after = np.sqrt(np.diag(np.linalg.inv(np.linalg.inv(first.covariance) + A.T @ A)))
    np.testing.assert_allclose(best.deviations, after, rtol=1e-6)


def test_the_board_gets_offsets_and_geometry_of_the_true_machine():
    """After the new offsets are set, what the board reports for a pose is what the true machine stands at."""
    problem = make_problem("delta3", dimensions=("rf", "re"), noise_m=1e-7)
    true = true_values(problem, 3)
    found = solve(problem, measured(problem, true, 20))
    present = {setting_id("offset", joint): 0.1 * joint for joint in range(3)}
    settings = board_settings(found, present)
    for joint in range(3):
        assert settings[setting_id("offset", joint)] == pytest.approx(0.1 * joint + true[joint], abs=1e-6)
    geometry = [settings[GEOMETRY_ID + k] for k in range(GEOMETRY_SIZE)]
    np.testing.assert_allclose(geometry, geometry_values(make_robot("delta3", rf=true[3], re=true[4])), atol=1e-6)
    only_offsets = make_problem("delta3")
    settings = board_settings(solve(only_offsets, measured(only_offsets, only_offsets.assumed, 9)), present)
    assert set(settings) == set(present)
    with pytest.raises(LinkError, match="read its settings first"):
        board_settings(found, {})


def test_the_table_is_in_degrees_and_millimetres():
    problem = make_problem("delta3", dimensions=("rf",))
    true = problem.assumed + np.array([math.radians(1.0), 0.0, 0.0, 1e-3])
    found = solve(problem, measured(problem, true, 30))
    table = {row.name: row for row in rows(found)}
    assert (table["offset q1"].unit, table["rf"].unit) == ("deg", "mm")
    assert table["offset q1"].found == pytest.approx(1.0, abs=2.0 * table["offset q1"].half_width)
    assert table["rf"].assumed == 160.0 and abs(table["rf"].found - 161.0) < 2.0 * table["rf"].half_width
    text = csv(found)
    assert text.startswith("# robot: delta3") and "offset q1,0," in text and "# trusted: yes" in text


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        ({"dimensions": ("q_min",)}, "'q_min' is no dimension to calibrate; choose from f, e, rf, re"),
        ({"frame": ("frame w",)}, "no part of the measuring frame"),
        ({"tolerances": {"rf": 1e-3}}, "'rf' is no unknown of this problem"),
        ({"dimensions": ("rf",), "tolerances": {"rf": 0.0}}, "above 0"),
        ({"noise_m": 0.0}, "above 0"),
        ({"offsets": False}, "Nothing is looked for"),
        ({"nominal": {"rf": 9.0}}, "must lie between"),
    ],
)
def test_a_problem_without_sense_is_refused(options, complaint):
    with pytest.raises(LinkError) as refused:
        make_problem("delta3", **options)
    assert complaint in str(refused.value)


@pytest.mark.parametrize("robot", ROBOTS)
def test_every_choice_has_a_label_and_works(robot):
    named = choices(robot)
    for name, label in named.items():
        assert label
        frame, dimensions = ((name,), ()) if name in ALL_FRAME else ((), (name,))
        assert [u.name for u in make_problem(robot, offsets=False, frame=frame, dimensions=dimensions).unknowns] == [
            name
        ]
    assert set(KINEMATIC[robot]) | set(ALL_FRAME) == set(named)
