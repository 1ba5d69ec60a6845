"""A drawing is stopped between strokes: searched for here sample by sample."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.toolpath import PenSettings, Toolpath, Track, default_placement, pause_after, plan_toolpath, track
from app.robots import make_robot
from tests.drawing.toolpath.shapes import circle, dot, every_kind, line

FAR = [line((-40.0, 0.0), (-30.0, 0.0)), line((40.0, 30.0), (40.0, 20.0)), circle(5.0), dot(5.0, 0.0)]
PENS = [PenSettings(), PenSettings(lift=False), PenSettings(laser=True)]


def planned(strokes: list, pen: PenSettings | None = None, name: str = "delta3") -> Toolpath:
    robot = make_robot(name)
    return plan_toolpath(strokes, robot, default_placement(robot), pen)


def ways(path: Toolpath | Track) -> list[np.ndarray]:
    """Samples of each hop from a stroke to the next."""
    last = int(path.stroke.max())
    edges = [(np.flatnonzero(path.stroke == i)[-1], np.flatnonzero(path.stroke == i + 1)[0]) for i in range(last)]
    return [np.arange(end + 1, start) for end, start in edges]


@pytest.mark.parametrize("strokes", [every_kind(), FAR], ids=["every kind", "far"])
@pytest.mark.parametrize("name", ["delta3", "fivebar"])
def test_the_pen_is_at_its_highest(strokes: list, name: str):
    for path in (made := planned(strokes, None, name), track(made, 0.002)):
        for hop in ways(path):
            t = pause_after(path, float(path.t[hop[0]]))
            at = int(np.searchsorted(path.t, t))
            assert path.t[at] == t and hop[0] <= at <= hop[-1]
            assert path.pose[at, 2] == pytest.approx(path.pose[hop, 2].max(), abs=1.01e-6)
            assert path.stroke[at] == -1 and not path.pen[at]


@pytest.mark.parametrize("pen", PENS[1:], ids=["no lift", "laser"])
def test_without_a_lift_it_is_the_middle_of_the_way(pen: PenSettings):
    path = planned(FAR, pen)
    for hop in ways(path):
        middle = (path.t[hop[0]] + path.t[hop[-1]]) / 2
        assert pause_after(path, float(path.t[hop[0]]) - 0.01) == pytest.approx(middle, abs=0.51e-3)


def test_across_at_one_height_it_is_the_middle_too():
    path = planned([line((-60.0, 0.0), (-59.0, 0.0)), line((60.0, 0.0), (59.0, 0.0))], PenSettings(up_speed_mm_s=50.0))
    (hop,) = ways(path)
    pause = pause_after(path, 0.0)
    assert pause == pytest.approx((path.t[hop[0]] + path.t[hop[-1]]) / 2, abs=5e-3)
    at = path.pose[int(np.searchsorted(path.t, pause))]
    assert at[0] == pytest.approx(0.0, abs=5e-3)


@pytest.mark.parametrize("pen", PENS, ids=["lift", "no lift", "laser"])
def test_the_next_one_and_none_before(pen: PenSettings):
    path = planned(FAR, pen)
    tops = [pause_after(path, float(path.t[hop[0]])) for hop in ways(path)]
    assert tops == sorted(set(tops)) and len(tops) == len(FAR) - 1
    for t in np.linspace(-1.0, path.duration_s, 200):
        expected = next((top for top in tops if top >= t), path.duration_s)
        assert pause_after(path, float(t)) == expected
    assert pause_after(path, tops[0]) == tops[0]
    assert pause_after(path, np.nextafter(tops[0], np.inf)) == tops[1]


@pytest.mark.parametrize("pen", PENS, ids=["lift", "no lift", "laser"])
def test_during_the_last_stroke_it_is_the_end(pen: PenSettings):
    path = planned(FAR, pen)
    began = path.t[path.stroke == len(FAR) - 1].min()
    for made in (path, track(path)):
        assert pause_after(made, began) == pause_after(made, began + 1e6) == path.duration_s


def test_a_drawing_of_one_stroke_is_paused_at_its_end():
    path = planned([circle(10.0)])
    assert pause_after(path, 0.0) == pause_after(track(path), 0.0) == path.duration_s


def test_strokes_that_touch_are_paused_between():
    path = planned([line((0.0, 0.0), (10.0, 0.0)), line((10.0, 0.0), (10.0, 10.0))], PenSettings(laser=True))
    pause = pause_after(path, 0.0)
    assert path.t[path.stroke == 0].max() < pause < path.t[path.stroke == 1].min()
