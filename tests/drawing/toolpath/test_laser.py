"""A laser burns the strokes evenly, and nothing else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.drawing.toolpath import PenSettings, Toolpath, default_pen, default_placement, laser_power, plan_toolpath
from app.robots import ROBOTS, make_robot
from app.robots.robot import Array
from tests.drawing.toolpath.shapes import circle, dot, every_kind, line, zigzag

LASER = PenSettings(speed_mm_s=60.0, laser=True)


def planned(name: str, strokes: list[Array], pen: PenSettings = LASER) -> Toolpath:
    robot = make_robot(name)
    return plan_toolpath(strokes, robot, default_placement(robot), pen)


def moved_mm(path: Toolpath) -> Array:
    """(k + 1,) way of the tool before each sample, and after the last."""
    step = np.linalg.norm(np.diff(path.pose[:, :3], axis=0), axis=1)
    return 1e3 * np.concatenate([[0.0], step, [0.0]])


def test_nothing_is_a_laser_unless_asked():
    assert not PenSettings().laser
    assert not any(default_pen(make_robot(name)).laser for name in ROBOTS)


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("lift", [True, False])
def test_between_the_strokes_it_stays_at_the_papers_height_and_draws_nothing(name: str, lift: bool):
    path = planned(name, every_kind(), replace(LASER, lift=lift))
    paper = default_placement(make_robot(name)).height_m
    drawn = np.flatnonzero(path.stroke >= 0)
    assert (path.pose[drawn[0] : drawn[-1] + 1, 2] == paper).all()
    assert np.array_equal(path.pen, path.stroke >= 0)
    assert path.stray_ink_mm == 0.0
    assert path.max_joint_speed_ratio <= 1.0 and path.max_joint_acceleration_ratio <= 1.0


def test_it_is_off_on_every_sample_between_the_strokes():
    path = planned("delta3", every_kind())
    power = laser_power(path, LASER)
    assert power.shape == path.t.shape
    assert (power[path.stroke < 0] == 0.0).all()
    assert np.count_nonzero(path.speed_m_s[path.stroke < 0]) > 100


def test_strokes_that_touch_have_the_laser_off_in_between():
    """The hop there has no length, and a sample of its own all the same."""
    path = planned("par4", [line((0.0, 0.0), (10.0, 0.0)), line((10.0, 0.0), (10.0, 10.0)), dot(10.0, 10.0)])
    changes = np.flatnonzero(np.diff(path.stroke[path.stroke >= 0]))
    assert len(changes) == 2
    inner = path.stroke[np.flatnonzero(path.pen)[0] : np.flatnonzero(path.pen)[-1]]
    assert np.count_nonzero((inner[1:] < 0) & (inner[:-1] >= 0)) == 2


@pytest.mark.parametrize("name", ROBOTS)
def test_power_is_the_actual_speed_over_the_pens(name: str):
    path = planned(name, [zigzag(1.0, 3.0), circle(15.0)])
    power, way = laser_power(path, LASER), moved_mm(path)
    speed = (way[1:] + way[:-1]) / 2e-3
    assert np.allclose(power[path.pen], speed[path.pen] / 60.0, atol=1e-9)
    assert power.max() == pytest.approx(1.0, abs=1e-3) and power.max() <= 1.0
    corners = power[path.pen & (path.stroke == 0)]
    assert corners.min() < 0.2, "slow in the corners, and weak there"


def test_every_millimetre_gets_the_same_energy():
    path = planned("delta3", [zigzag(1.0, 3.0), line((-30.0, 10.0), (30.0, 10.0))])
    energy = 1e-3 * laser_power(path, LASER)
    for number, length in ((0, 19 * np.hypot(1.0, 3.0)), (1, 60.0)):
        assert energy[path.stroke == number].sum() == pytest.approx(length / 60.0, rel=0.025)  # corners are rounded


def test_it_is_off_at_rest():
    path = planned("par4", [dot(3.0, 4.0), line((10.0, 0.0), (20.0, 0.0)), dot(20.0, 0.0)])
    way = moved_mm(path)
    resting = (way[1:] == 0.0) & (way[:-1] == 0.0)
    assert np.count_nonzero(resting & path.pen) > 50
    assert (laser_power(path, LASER)[resting] == 0.0).all()


def test_full_power_is_not_exceeded_by_a_pen_that_is_faster_than_planned():
    path = planned("delta3", [line((-30.0, 0.0), (30.0, 0.0))])
    assert laser_power(path, replace(LASER, speed_mm_s=20.0)).max() == 1.0


@pytest.mark.parametrize("lift", [True, False])
def test_a_pen_that_is_no_laser_has_no_power(lift: bool):
    pen = replace(LASER, laser=False, lift=lift)
    path = planned("delta3", every_kind(), pen)
    assert (laser_power(path, pen) == 0.0).all() and len(laser_power(path, pen)) == len(path.t)
