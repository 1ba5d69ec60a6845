"""Sweeps: values that sliders have, points that are the pipeline's own, and what must get better or worse."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from app.drawing.compare.sweep import SWEEPS, SweepPoint, sweep_point, sweep_values
from app.drawing.compose import Look, compose
from app.drawing.errors import DrawingError
from app.drawing.modes import DRAWING_MODES
from app.drawing.source import Source, strokes_source, text_source
from app.drawing.toolpath import PenSettings, default_placement, plan_toolpath
from app.robots import make_robot
from tests.drawing.toolpath.shapes import line

ROBOT = make_robot("delta3")
PLACEMENT = default_placement(ROBOT)
PEN = PenSettings()
SMALL = (50.0, 40.0)
EVERY = [(mode, parameter) for mode, parameters in SWEEPS.items() for parameter in parameters]


def shaded() -> Source:
    """A dark ball on a lighter ground."""
    y, x = np.mgrid[0:160, 0:200]
    grey = np.where((x - 100) ** 2 + (y - 80) ** 2 < 60**2, 40 + 0.8 * x, 220.0)
    return Source("ball", grey.astype(np.uint8))


def swept(source: Source, look: Look, parameter: str, *values: float, pen: PenSettings = PEN) -> list[SweepPoint]:
    return [sweep_point(source, look, ROBOT, PLACEMENT, pen, parameter, value) for value in values]


def test_every_mode_can_be_swept():
    assert SWEEPS.keys() == {*DRAWING_MODES, "strokes"}


@pytest.mark.parametrize(("mode", "parameter"), EVERY)
def test_values_ascend_on_their_slider(mode: str, parameter: str):
    values = sweep_values(mode, parameter)
    assert 4 <= len(values) <= 7 and values == sorted(set(values))
    if parameter in ("scale", "speed_mm_s"):
        return
    (slider,) = (each for each in DRAWING_MODES[mode].parameters if each.name == parameter)
    steps = (np.array(values) - slider.low) / slider.step
    assert slider.low <= values[0] and values[-1] <= slider.high
    assert np.allclose(steps, np.rint(steps), atol=1e-6)


def test_speeds_are_spread_by_factors_and_scales_evenly():
    speeds, scales = sweep_values("sketch", "speed_mm_s", 5), sweep_values("sketch", "scale", 4)
    assert np.ptp(np.diff(np.log(speeds))) < 0.1 and len(speeds) == 5
    assert np.allclose(scales, [0.4, 0.6, 0.8, 1.0])


def test_a_setting_that_a_mode_has_not_is_refused():
    with pytest.raises(DrawingError, match="no setting pitch"):
        sweep_values("sketch", "pitch")


@pytest.mark.parametrize("mode", ["squiggle", "canny", "portrait"])
def test_a_point_is_what_the_pipeline_gives(mode: str):
    look = Look(mode, SMALL, 2.0)
    (point,) = swept(shaded(), look, "speed_mm_s", 60.0)
    composition = compose(shaded(), look)
    path = plan_toolpath(composition.strokes, ROBOT, PLACEMENT, PenSettings(speed_mm_s=60.0))
    assert (point.value, point.reason, point.strokes) == (60.0, "", len(composition.strokes))
    assert point.time_s == path.duration_s
    assert composition.similarity is not None
    assert point.similarity == pytest.approx(composition.similarity, abs=0.02)
    inked = sum(float(np.hypot(*np.diff(stroke, axis=0).T).sum()) for stroke in composition.strokes)
    assert point.ink_mm == pytest.approx(inked, rel=0.05)
    assert 0.0 < point.deviation_um < 100.0


def test_more_dots_take_longer_and_look_more_like_the_picture():
    points = swept(shaded(), Look("stipple", SMALL, 2.0), "dots", 100.0, 200.0, 400.0)
    assert [point.strokes for point in points] == [100, 200, 400]
    for before, after in pairwise(points):
        assert after.time_s > 1.5 * before.time_s and after.similarity > before.similarity + 0.05


def test_a_faster_pen_takes_less_time_and_strays_farther():
    points = swept(text_source("Delta"), Look("auto", (100.0, 60.0)), "speed_mm_s", 20.0, 80.0, 320.0)
    for before, after in pairwise(points):
        assert after.time_s < before.time_s and after.deviation_um > before.deviation_um
    assert all(point.similarity > 0.98 and point.strokes == points[0].strokes for point in points)


def test_a_smaller_drawing_has_less_ink_in_proportion():
    points = swept(strokes_source("line", [line((0.0, 0.0), (3.0, 1.0))]), Look(), "scale", 0.25, 0.5, 1.0)
    assert [point.ink_mm for point in points] == pytest.approx(
        [share * 128.0 * math.hypot(1.0, 1 / 3) for share in (0.25, 0.5, 1.0)], rel=1e-3
    )


def test_the_missing_lift_spoils_the_look_and_is_counted_as_ink():
    strokes = [line((x, 0.0), (x + 2.0, 40.0)) for x in np.arange(0.0, 60.0, 12.0)]
    clean, stray = (
        swept(strokes_source("bars", strokes), Look(), "scale", 1.0, pen=PenSettings(lift=lift))[0]
        for lift in (True, False)
    )
    assert stray.ink_mm > clean.ink_mm + 50.0 and stray.similarity < clean.similarity - 0.02


def test_the_picture_stays_what_it_is_while_its_preparation_is_swept():
    """In its own width nothing is changed; from a few pixels it is drawn less like itself."""
    look = Look("squiggle", SMALL, 2.0)
    (plain,) = swept(shaded(), look, "speed_mm_s", 80.0)
    coarse, own = swept(shaded(), look, "width", 8.0, 200.0)
    assert own.similarity == plain.similarity and own.time_s == plain.time_s
    assert coarse.similarity < own.similarity - 0.02


@pytest.mark.parametrize(
    ("source", "look", "parameter", "value", "complaint"),
    [
        (text_source("far"), Look(), "scale", 9.0, "beyond the robot"),
        (Source("white", np.full((80, 60), 255, np.uint8)), Look("hatch"), "pitch", 2.0, "nothing to draw"),
        (shaded(), Look("hatch", SMALL), "pitch", 99.0, "must lie between"),
        (shaded(), Look("hatch", SMALL), "dots", 99.0, "no setting"),
        (shaded(), Look("hatch", SMALL), "speed_mm_s", 0.0, "speed"),
        (shaded(), Look("hatch", SMALL), "scale", 0.0, "scale"),
    ],
)
def test_what_cannot_be_drawn_is_nan_with_its_reason(source, look, parameter, value, complaint):
    (point,) = swept(source, look, parameter, value)
    assert complaint in point.reason and point.value == value and point.strokes == 0
    assert all(math.isnan(number) for number in (point.time_s, point.similarity, point.ink_mm, point.deviation_um))
