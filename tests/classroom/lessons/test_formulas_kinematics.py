"""Formulas of legs, assemblies, workspace and the Par4's printed sign, against numbers that come from elsewhere."""

from __future__ import annotations

import math
from typing import Any

import pytest

from app.classroom.lessons.formulas import FORMULAS, FormulaMistake
from app.robots import make_robot

HOME = {"x": 0, "y": -36, "z": -300, "theta": 0}


def value(name: str, pick: str = "", /, **arguments: Any) -> Any:
    return FORMULAS[name].quantity(arguments, pick).value


def unit(name: str, pick: str = "", /, **arguments: Any) -> str | None:
    return FORMULAS[name].quantity(arguments, pick).unit


def by_hand(z: float) -> dict[str, float]:
    """Terms of the drawing delta's leg on its axis, in decimetres."""
    u = (120 - 360) / (2 * math.sqrt(3)) / 100
    return {"E": 3.2 * z, "F": -3.2 * u, "G": u * u + z * z + 1.6**2 - 3.8**2, "u_r": 100 * u}


@pytest.mark.parametrize("term", ["E", "F", "G", "u_r"])
def test_a_legs_terms_are_those_computed_by_hand(term: str) -> None:
    leg = {"robot": "delta3", "pose": {"z": -330}, "leg": 1}
    assert value("leg_equation", term, **leg) == pytest.approx(by_hand(-3.3)[term])
    assert unit("leg_equation", term, **leg) == ("mm" if term == "u_r" else "dm^2")


def test_both_roots_solve_the_equation_and_the_outer_one_is_the_robots() -> None:
    pose = {"x": 50, "y": -80, "z": -350, "theta": math.degrees(0.5)}
    leg = {"robot": "par4", "pose": pose, "leg": 2}
    E, F, G = (value("leg_equation", term, **leg) for term in "EFG")
    for root in ("outer", "inner"):
        q = math.radians(value("leg_equation", root, **leg))
        assert E * math.sin(q) + F * math.cos(q) + G == pytest.approx(0, abs=1e-9)
    assert value("leg_equation", "outer", **leg) == pytest.approx(25.35419, abs=1e-5)
    assert value("leg_equation", "D", **leg) == pytest.approx(E * E + F * F - G * G)


def test_a_leg_that_cannot_reach_is_short_or_long_and_has_no_angle() -> None:
    far, near = ({"robot": "delta3", "pose": {"z": z}, "leg": 1} for z in (-560, -150))
    spanned = math.hypot(by_hand(0)["u_r"], 560)
    assert value("leg_equation", "reach", **far) == pytest.approx(spanned)
    assert value("leg_equation", "short", **far) == pytest.approx(spanned - 540)
    assert value("leg_equation", "short", **near) == pytest.approx(-55, abs=1)
    with pytest.raises(FormulaMistake, match="cannot do this"):
        value("leg_equation", "outer", **far)


def test_a_leg_that_is_not_there_is_a_mistake() -> None:
    with pytest.raises(FormulaMistake, match="legs 1 to 3"):
        value("leg_equation", "E", robot="delta3", pose={"z": -330}, leg=4)
    with pytest.raises(FormulaMistake, match="only par4 and delta3"):
        value("leg_equation", "E", robot="linear", pose={"z": -400}, leg=1)


def test_assemblies_one_by_one() -> None:
    joints = dict.fromkeys(("q1", "q2", "q3"), 20)
    lower, upper = (value("assembly", "z", robot="delta3", joints=joints, mode=mode) for mode in (1, 2))
    mirror = -160 * math.sin(math.radians(20))
    assert lower + upper == pytest.approx(2 * mirror)
    with pytest.raises(FormulaMistake, match="2 assemblies"):
        value("assembly", "z", robot="delta3", joints=joints, mode=3)


def test_the_printed_sign_changes_arm_three_by_three_degrees() -> None:
    assert value("par4_printed", "error", pose=HOME) == pytest.approx(3.11, abs=0.01)
    assert value("par4_printed", "q3_right", pose=HOME) == pytest.approx(-2.11389, abs=1e-4)
    added = value("par4_printed", "F", pose=HOME) - value("par4_printed", "F_right", pose=HOME)
    assert added == pytest.approx(4 * 2.0 * 0.09 * math.cos(math.radians(45)))


def test_the_rod_at_the_printed_angle_as_the_robots_joints_have_it() -> None:
    robot, pose = make_robot("par4"), [0.0, -0.036, -0.3, 0.0]
    joints = robot.inverse(pose)
    joints[2] = math.radians(value("par4_printed", "q3", pose=HOME))
    bones = robot.skeleton(pose, joints.tolist())
    assert value("par4_printed", "rod", pose=HOME) == pytest.approx(1e3 * math.dist(bones.elbow[2], bones.platform[2]))


@pytest.mark.parametrize(
    ("arguments", "inside"),
    [({"step": 20}, 1016), ({"step": 10}, 8118), ({"step": 10, "theta": 45}, 6767)],
)
def test_points_of_the_papers_grid(arguments: dict[str, float], inside: int) -> None:
    assert value("par4_grid", "inside", **arguments) == inside
    assert value("par4_grid", "volume", **arguments) == pytest.approx(inside * arguments["step"] ** 3 / 1e6)


def test_another_joint_height_moves_the_workspace_out_of_the_papers_box() -> None:
    assert value("par4_grid", "inside", step=10, P_z=0) < value("par4_grid", "inside", step=10)
    with pytest.raises(FormulaMistake, match="between 2 and 50"):
        value("par4_grid", "inside", step=0.1)


def test_the_column_through_home_ends_where_the_arms_meet_their_stops() -> None:
    assert value("column", "lowest", robot="par4") == pytest.approx(-506.99, abs=1.2)
    assert value("column", "highest", robot="par4") == pytest.approx(-224.14, abs=1.2)
    assert value("reachable", robot="par4", pose={"y": -36, "z": -506}) is True
    assert value("reachable", robot="par4", pose={"y": -36, "z": -508}) is False
