"""The serial arm by its own forward kinematics and known ways, and the comparison by integrals over Jacobians."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.drawing.compare.paths import rose, zigzag
from app.drawing.compare.serial_arm import SerialArm, arm_behind, compare_with_arm
from app.drawing.errors import DrawingError
from app.drawing.toolpath import default_placement
from app.robots import make_robot
from tests.drawing.toolpath.shapes import circle, dot, line

arms = st.builds(
    SerialArm,
    st.floats(0.05, 0.5),
    st.floats(0.05, 0.5),
    st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)),
    st.sampled_from([-1, 1]),
)


def around(arm: SerialArm, low: float, high: float, count: int = 200) -> np.ndarray:
    """Points (count, 2) at such shares of the way from the innermost to the outermost reach."""
    rng = np.random.default_rng(3)
    inner = abs(arm.l1_m - arm.l2_m)
    radius = inner + rng.uniform(low, high, count) * (arm.l1_m + arm.l2_m - inner)
    turn = rng.uniform(-np.pi, np.pi, count)
    return np.column_stack([radius * np.cos(turn), radius * np.sin(turn)]) + arm.base_m


@given(arms)
def test_the_pen_is_where_the_angles_put_it(arm: SerialArm):
    points = around(arm, 0.01, 0.99)
    angles = arm.inverse(points)
    elbow = arm.base_m + arm.l1_m * np.column_stack([np.cos(angles[:, 0]), np.sin(angles[:, 0])])
    forearm = angles.sum(axis=1)
    pen = elbow + arm.l2_m * np.column_stack([np.cos(forearm), np.sin(forearm)])
    assert np.allclose(pen, points, atol=1e-9)
    assert np.allclose(arm.forward(angles), points, atol=1e-9)
    assert (np.sign(angles[:, 1]) == arm.elbow).all()
    assert arm.reach(points) == ""


@given(arms)
def test_rates_are_those_of_the_jacobian(arm: SerialArm):
    points, step = around(arm, 0.1, 0.9), 1e-6
    angles = arm.inverse(points)
    a, b = angles[:, 0], angles.sum(axis=1)
    jacobian = np.empty((len(points), 2, 2))
    jacobian[:, 0] = np.column_stack([-arm.l1_m * np.sin(a) - arm.l2_m * np.sin(b), -arm.l2_m * np.sin(b)])
    jacobian[:, 1] = np.column_stack([arm.l1_m * np.cos(a) + arm.l2_m * np.cos(b), arm.l2_m * np.cos(b)])
    for axis in np.eye(2):
        before, after = np.unwrap([arm.inverse(points - step * axis), arm.inverse(points + step * axis)], axis=0)
        rates = (after - before) / (2 * step)
        assert np.allclose(np.einsum("nij,nj->ni", jacobian, rates), axis, atol=2e-3)


@pytest.mark.parametrize(
    ("distance", "complaint"), [(0.45, "50 mm too short"), (0.03, "70 mm too near the shoulder"), (0.3, "")]
)
def test_out_of_reach_is_nan_and_said(distance: float, complaint: str):
    arm = SerialArm(0.25, 0.15, (0.02, -0.1))
    points = np.array([[0.02, -0.1 + distance], [0.02, 0.15]])
    assert complaint in arm.reach(points) and bool(arm.reach(points)) == bool(complaint)
    assert np.isnan(arm.inverse(points)[0]).all() == bool(complaint)
    assert np.isfinite(arm.inverse(points)[1]).all()


def test_straight_away_from_the_shoulder_the_elbow_decides():
    """Equal links: |pen - shoulder| = 2 l cos(elbow / 2), and the shoulder turns by half as much."""
    arm = SerialArm(0.2, 0.2, (0.0, -0.24))
    result = compare_with_arm([line((0.0, -80.0), (0.0, 80.0))], arm, joint_speed_rad_s=2.0)
    bend = [2.0 * math.acos(distance / 0.4) for distance in (0.16, 0.32)]
    assert result.arm_s == pytest.approx((bend[0] - bend[1]) / 2.0, rel=1e-9)


@pytest.mark.parametrize("base", [(0.0, -0.24), (0.24, 0.0), (-0.24, 0.0)])
def test_around_the_shoulder_only_the_shoulder_turns(base: tuple[float, float]):
    """Also where its angle passes through pi."""
    middle = math.atan2(-base[1], -base[0])
    turn = np.linspace(middle - 0.3, middle + 0.3, 400)
    arc = 1e3 * (np.array(base) + 0.24 * np.column_stack([np.cos(turn), np.sin(turn)]))
    result = compare_with_arm([arc], SerialArm(0.2, 0.15, base))
    assert result.arm_s == pytest.approx(0.6 / 4.0, rel=1e-3)


def test_the_deltas_time_is_the_integral_over_its_busiest_joint():
    robot = make_robot("delta3")
    placement = default_placement(robot)
    start, stop = np.array([-60.0, -20.0]), np.array([50.0, 70.0])
    s = (np.arange(4000.0) + 0.5) / 4000
    points = 1e-3 * (start + s[:, None] * (stop - start)) + placement.centre_m
    along = np.append((stop - start) / np.hypot(*(stop - start)), 0.0)
    pose = np.column_stack([points, np.full(len(s), placement.height_m)])
    rates = np.abs(robot.jacobian(pose) @ along).max(axis=1)
    wanted = float(rates.mean()) * 1e-3 * float(np.hypot(*(stop - start))) / 4.0
    result = compare_with_arm([line((-60.0, -20.0), (50.0, 70.0))], arm_behind(), robot=robot)
    assert result.delta_s == pytest.approx(wanted, rel=1e-4)
    assert result.saving_percent == pytest.approx(100 * (result.arm_s - result.delta_s) / result.arm_s)


def test_hops_take_their_time_and_dots_none():
    a, b = line((-40.0, 0.0), (-10.0, 5.0)), line((20.0, 9.0), (40.0, -30.0))
    apart = compare_with_arm([a, dot(20.0, 9.0), b], arm_behind())
    joined = compare_with_arm([np.concatenate([a, b])], arm_behind())
    assert apart.delta_s == pytest.approx(joined.delta_s) and apart.arm_s == pytest.approx(joined.arm_s)
    still = compare_with_arm([dot(3.0, 4.0)], arm_behind())
    assert still.delta_s == still.arm_s == 0.0 and math.isnan(still.saving_percent)


def test_times_are_inverse_to_the_joints_speed():
    slow, fast = (compare_with_arm([circle(40.0)], arm_behind(), speed) for speed in (1.0, 4.0))
    assert slow.delta_s == pytest.approx(4 * fast.delta_s) and slow.arm_s == pytest.approx(4 * fast.arm_s)
    assert slow.saving_percent == pytest.approx(fast.saving_percent)


@pytest.mark.parametrize(
    ("link", "drawing", "saving"),
    [(0.20, zigzag(), 13.0), (0.20, rose(), 21.0), (0.25, zigzag(), -7.0), (0.25, rose(), 1.0)],
)
def test_savings_are_near_those_computed_for_the_specification(link: float, drawing: list, saving: float):
    """Which did not record where its arm stood: a plausible place comes within some percent."""
    result = compare_with_arm(drawing, arm_behind(link, link))
    assert result.saving_percent == pytest.approx(saving, abs=7.0) and not result.reason


def test_assumptions_name_what_was_assumed_and_what_is_not_reproduced():
    told = " ".join(compare_with_arm([circle(20.0)], arm_behind(0.25, 0.15), 3.0).assumptions)
    for word in ("3 rad/s", "250 and 150 mm", "y = -240 mm", "Drawing delta", "not reproduced"):
        assert word in told


@pytest.mark.parametrize(
    ("strokes", "arm", "robot", "complaint", "missing"),
    [
        ([circle(90.0)], arm_behind(0.1, 0.1), "delta3", "too short", "arm"),
        ([circle(350.0)], arm_behind(0.6, 0.6), "delta3", "Drawing delta", "delta"),
        ([circle(20.0)], arm_behind(), "linear", "slide", "delta"),
    ],
)
def test_what_cannot_be_compared_is_said(strokes: list, arm: SerialArm, robot: str, complaint: str, missing: str):
    result = compare_with_arm(strokes, arm, robot=robot)
    assert complaint in result.reason and math.isnan(result.saving_percent)
    assert math.isnan(result.arm_s) == (missing == "arm") and math.isnan(result.delta_s) == (missing == "delta")


@pytest.mark.parametrize("robot", ["par4", "fivebar"])
def test_the_other_robots_with_turning_joints_compare_too(robot: str):
    result = compare_with_arm([circle(30.0)], arm_behind(), robot=robot)
    assert result.delta_s > 0.0 and not result.reason


def test_nothing_to_draw_and_impossible_settings_are_refused():
    with pytest.raises(DrawingError, match="nothing to draw"):
        compare_with_arm([], arm_behind())
    with pytest.raises(DrawingError, match="above 0"):
        compare_with_arm([circle(20.0)], arm_behind(), 0.0)
    with pytest.raises(DrawingError, match="links"):
        SerialArm(0.0, 0.2, (0.0, -0.2))
    with pytest.raises(DrawingError, match="shoulder"):
        SerialArm(0.2, 0.2, (math.nan, -0.2))
