"""The curves: as large as they say, smooth, and with the derivatives they say."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.motion import CURVES, MotionError, MotionSettings, default_motion
from app.motion.curves import rounded
from app.motion.placed import place
from app.robots import ROBOTS, make_robot

few = settings(max_examples=30)
S = np.linspace(0.0, 1.0, 2001)
shapes = st.builds(
    MotionSettings,
    curve=st.sampled_from(sorted(CURVES)),
    size_m=st.floats(0.01, 0.3),
    height_m=st.floats(0.01, 0.3),
    turns=st.floats(0.25, 8.0),
    sides=st.integers(3, 12),
)


def central_differences(law, s: np.ndarray, step: float = 1e-6) -> tuple[np.ndarray, np.ndarray]:
    """Of the value and of the first derivative, by s."""
    after, before = law.at(s + step), law.at(s - step)
    return (after[0] - before[0]) / (2 * step), (after[1] - before[1]) / (2 * step)


@few
@given(shapes)
def test_derivatives_equal_central_differences(shape):
    law = CURVES[shape.curve].draw(shape)
    s = np.linspace(0.0007, 0.9993, 301)
    first, second = central_differences(law, s)
    _, d1, d2 = law.at(s)
    assert np.allclose(d1, first, rtol=1e-5, atol=1e-6 * np.abs(d1).max())
    assert np.allclose(d2, second, rtol=1e-4, atol=2e-3 * np.abs(d2).max() + 1e-9)


@few
@given(shapes)
def test_a_curve_fits_its_cylinder_and_height(shape):
    points = CURVES[shape.curve].draw(shape).at(S)[0]
    radius = np.hypot(points[:, 0], points[:, 1])
    assert radius.max() <= shape.size_m * (1 + 1e-9)
    assert radius.max() >= (0.5 if shape.curve == "polygon" else 0.999) * shape.size_m
    rise = shape.height_m if "height_m" in CURVES[shape.curve].parameters else 0.0
    assert np.ptp(points[:, 2]) == pytest.approx(rise, abs=1e-9)


@few
@given(shapes)
def test_closed_curves_close_smoothly_and_open_ones_do_not(shape):
    kind = CURVES[shape.curve]
    starts, ends = (np.concatenate([row[k] for row in kind.draw(shape).at(S)]) for k in (0, -1))
    if kind.closed:
        assert np.allclose(starts, ends, atol=1e-9 * max(1.0, np.abs(starts).max()))
    else:
        assert np.abs(starts[:3] - ends[:3]).max() > 1e-3


def test_rounded_corners_have_a_continuous_second_derivative_and_keep_the_straights():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 2, 0], [1, 2, 1]])
    curve = rounded(points, np.array([0.4, 0.3]))
    value, _, second = curve.at(np.linspace(0.0, 1.0, 40001))
    assert np.allclose(value[[0, -1]], points[[0, -1]])
    assert np.abs(np.diff(second, axis=0)).max() < 2e-3 * np.abs(second).max()
    on_first = (value[:, 1] == 0) & (value[:, 2] == 0)
    assert value[on_first, 0].max() == pytest.approx(0.6, abs=1e-4), (
        "the tool leaves the straight 0.4 before the corner"
    )


def test_an_arch_needs_a_lift():
    with pytest.raises(MotionError, match="height above 0"):
        CURVES["arch"].draw(MotionSettings(curve="arch", height_m=0.0))


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("curve", CURVES)
def test_a_placed_curve_runs_its_laps_and_turns_the_tool(name, curve):
    robot = make_robot(name)
    wanted = replace(default_motion(name), curve=curve, laps=3)
    placed = place(wanted, robot)
    poses, first, _ = placed.at(S)
    assert np.allclose(np.gradient(poses, S, axis=0)[2:-2], first[2:-2], atol=2e-3 * np.abs(first).max() + 1e-9)
    if CURVES[curve].closed:
        assert np.allclose(placed.at(S / 3)[0], placed.at(S / 3 + 1 / 3)[0], atol=1e-9)
    if robot.dof == 4:
        assert poses[:, 3].min() == pytest.approx(-wanted.turn_rad / 2, abs=1e-6)
        assert poses[:, 3].max() == pytest.approx(wanted.turn_rad / 2, abs=1e-6)
