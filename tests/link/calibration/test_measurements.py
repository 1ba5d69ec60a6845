"""Tables of measured poses, good and bad."""

from __future__ import annotations

import numpy as np
import pytest

from app.link.calibration.measurements import Measurements, head
from app.link.errors import LinkError
from app.robots import ROBOTS, make_robot

GOOD = "q1_deg,q2_deg,q3_deg,x_mm,y_mm,z_mm\n10,20,30,1,-2,-330\n11,21,31,2,-3,-331\n"


def test_degrees_and_millimetres_become_radians_and_metres():
    data = Measurements.from_csv("delta3", GOOD)
    np.testing.assert_allclose(data.joints[0], np.radians([10, 20, 30]))
    np.testing.assert_allclose(data.tool_m[1], [0.002, -0.003, -0.331])
    assert np.isnan(data.angle).all() and data.values == 6 and data.lines == (2, 3)


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_table_is_read_back(robot):
    n, rng = len(make_robot(robot).joint_names), np.random.default_rng(1)
    angle = rng.normal(size=5) if len(make_robot(robot).pose_names) == 4 else None
    made = Measurements.of(robot, rng.normal(size=(5, n)), rng.normal(size=(5, 3)), angle)
    back = Measurements.from_csv(robot, made.csv())
    for name in ("joints", "tool_m", "angle"):
        np.testing.assert_allclose(getattr(back, name), getattr(made, name), rtol=1e-8)
    assert made.csv().splitlines()[0] == ",".join(head(robot))


def test_the_angle_may_be_left_out_and_columns_may_be_swapped():
    text = "z_mm;y_mm;x_mm;q4_deg;q3_deg;q2_deg;q1_deg\n-300,5;2;1;40;30;20;10\n"
    data = Measurements.from_csv("par4", text)
    np.testing.assert_allclose(data.tool_m, [[0.001, 0.002, -0.3005]])
    np.testing.assert_allclose(np.degrees(data.joints), [[10, 20, 30, 40]])
    assert np.isnan(data.angle).all()


def test_rows_go_and_the_others_keep_their_names():
    data = Measurements.from_csv("delta3", "# by Ann\n\n" + GOOD).without([4])
    assert data.lines == (5,) and data.tool_m[0, 0] == pytest.approx(0.002)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "it needs a head (q1_deg, q2_deg, q3_deg, x_mm, y_mm, z_mm)"),
        ("q1_deg,q2_deg,q3_deg,x_mm,y_mm,z_mm\n", "no measurements yet"),
        (GOOD.replace("y_mm", "y"), "no column y_mm"),
        (GOOD.replace("-330", "deep"), "Line 2: 'deep' is not a number"),
        (GOOD.replace("31,2", "31,nan"), "Row 3: a value is missing"),
        (GOOD.replace("31,2", "inf,2"), "Row 3: a value is missing"),
        (GOOD.replace("31,2,", "31,"), "Line 3: 5 columns instead of the head's 6"),
        (GOOD.replace("31,2,", "31,,"), "Line 3: an empty cell is not a number"),
        (GOOD.replace("-331", "-331000"), "Row 3: the tool is more than 5 m away"),
        (GOOD + "1,2,3,4,5,6\n" * 1000, "more than 1000"),
    ],
)
def test_a_bad_table_is_refused_with_its_row(text, complaint):
    with pytest.raises(LinkError) as refused:
        Measurements.from_csv("delta3", text)
    assert complaint in str(refused.value) and str(refused.value).endswith(".")


def test_arrays_of_another_robot_are_refused():
    with pytest.raises(LinkError, match="needs 4 joints"):
        Measurements.of("par4", np.zeros((2, 3)), np.zeros((2, 3)))
