"""Where the sheet lies and what fits on it."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.errors import DrawingError
from app.drawing.toolpath.placement import (
    SHEETS,
    Placement,
    Sheet,
    default_placement,
    fit_to_sheet,
    largest_sheet,
    sheet_fits,
)
from app.robots import ROBOTS, make_robot
from tests.drawing.toolpath.shapes import circle, dot, line


def test_the_sheet_is_turned_about_its_middle_and_then_moved():
    placement = Placement(-0.3, (0.1, 0.2), np.pi / 2)
    on_table = placement.on_table(np.array([[0.0, 0.0], [10.0, 0.0], [0.0, 20.0]]))
    assert np.allclose(on_table, [[0.1, 0.2], [0.1, 0.21], [0.08, 0.2]])


def test_delta3_draws_where_its_specification_says():
    placement = default_placement(make_robot("delta3"))
    assert placement.height_m == pytest.approx(-0.340) and placement.centre_m == (0.0, 0.0)


@pytest.mark.parametrize(
    ("name", "preset", "sheet"),
    [
        ("par4", None, Sheet("A5", 148, 210)),
        ("delta3", None, Sheet("A3", 297, 420)),
        ("delta3", "classic", Sheet("A6", 105, 148)),
        ("linear", None, Sheet("A5", 148, 210)),
        ("fivebar", None, Sheet("A5", 210, 148)),
    ],
)
def test_largest_sheets(name: str, preset: str | None, sheet: Sheet):
    robot = make_robot(name, preset=preset)
    placement = default_placement(robot)
    assert largest_sheet(robot, placement) == sheet
    half = np.array([sheet.width_mm, sheet.height_mm]) / 2
    for x, y in half * np.random.default_rng(0).uniform(-1.0, 1.0, (300, 2)):
        spot = placement.on_table(np.array([[x, y]]))[0]
        for z in (placement.height_m, placement.height_m + 0.004):
            assert robot.reach([*spot, z, 0.0][: robot.dof]).ok


def test_delta3_draws_a4_both_ways_and_classic_does_not():
    """As computed for the specification."""
    a4 = SHEETS[1]
    for sheet in (a4, a4.turned()):
        for height in (-0.440, -0.340, -0.290):
            assert sheet_fits(sheet, make_robot("delta3"), Placement(height), lift_mm=10.0)
    classic = make_robot("delta3", preset="classic")
    assert not any(sheet_fits(a4, classic, Placement(height)) for height in np.arange(-0.25, -0.13, 0.01))


@pytest.mark.parametrize("name", ROBOTS)
def test_a_sheet_out_of_reach_does_not_fit(name: str):
    robot = make_robot(name)
    away = default_placement(robot)
    assert largest_sheet(robot, Placement(away.height_m, (1.0, 1.0))) is None


def test_changed_dimensions_still_have_a_place():
    robot = make_robot("delta3", rf=0.12, re=0.3)
    assert largest_sheet(robot) is not None


def test_a_drawing_fills_the_sheet_to_its_margin():
    strokes = [circle(1.0, (7.0, 3.0)), line((5.0, 3.0), (9.0, 3.0))]
    fitted = np.concatenate(fit_to_sheet(strokes, Sheet("A5", 148, 210), margin_mm=14.0))
    assert np.allclose(fitted[:, 0].min(), -60.0) and np.allclose(fitted[:, 0].max(), 60.0)
    assert np.allclose(np.ptp(fitted[:, 1]), 60.0)
    assert np.allclose(fitted.min(axis=0) + fitted.max(axis=0), 0.0)


def test_a_lone_dot_goes_to_the_middle():
    assert np.allclose(fit_to_sheet([dot(3.0, 4.0)], SHEETS[3])[0], 0.0)


@pytest.mark.parametrize(
    ("strokes", "margin", "complaint"), [([dot(0, 0)], 60.0, "margin of 60 mm"), ([], 10.0, "nothing to draw")]
)
def test_what_cannot_be_fitted_is_said(strokes: list, margin: float, complaint: str):
    with pytest.raises(DrawingError, match=complaint):
        fit_to_sheet(strokes, SHEETS[3], margin)
