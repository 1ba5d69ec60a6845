"""Drawings with known lines: each is drawn once, in the middle of its ink, in one go."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.vectorise import vectorise
from app.drawing.vectorise.ink import find_ink
from tests.drawing.vectorise.pictures import (
    MM_PER_PX,
    SHAPE,
    arc,
    cartoon,
    circles_and_cross,
    grid,
    inked,
    length,
    polygon,
    rms_and_covered,
    spiral,
)


def drawn(picture: np.ndarray, **settings: float) -> list[np.ndarray]:
    return vectorise(picture, "centreline", MM_PER_PX, **settings).strokes


@pytest.mark.parametrize("width", [4, 5, 6])
@pytest.mark.parametrize("drawing", [circles_and_cross, cartoon, spiral, grid])
def test_known_drawings(drawing, width):
    """The targets of the specification."""
    truth = drawing()
    strokes = drawn(inked(truth, width))
    rms, covered = rms_and_covered(strokes, truth)
    assert len(truth) <= len(strokes) <= len(truth) + 1
    assert 0.97 <= length(strokes) / length(truth) <= 1.02
    assert rms <= 0.35 and covered >= 0.99


@pytest.mark.parametrize("width", [1, 2, 3, 9, 15])
def test_a_line_drawn_once_is_one_stroke(width):
    wave = np.column_stack([np.linspace(40, 470, 800), 256 + 80 * np.sin(np.linspace(0, 12, 800))])
    (stroke,) = drawn(inked([wave], width))
    assert length([stroke]) == pytest.approx(length([wave]), rel=0.02)


@pytest.mark.parametrize(("radius", "width"), [(30, 3), (100, 5), (200, 9)])
def test_the_ink_of_a_circle_is_its_circumference(radius, width):
    (stroke,) = drawn(inked([arc(256, 256, radius)], width))
    assert length([stroke]) == pytest.approx(2 * np.pi * radius, rel=0.02)
    assert (stroke[0] == stroke[-1]).all()


@pytest.mark.parametrize("turn", [90, 60, 45])
@pytest.mark.parametrize("width", [3, 6, 9])
def test_two_crossing_lines_are_two_strokes(turn, width):
    way = 180 * np.array([np.cos(np.radians(turn)), np.sin(np.radians(turn))])
    truth = [polygon((60, 256), (450, 256)), np.array([256 - way, 256 + way])]
    strokes = drawn(inked(truth, width))
    assert len(strokes) == 2
    assert rms_and_covered(strokes, truth)[0] < 0.35


def test_few_points_on_straight_lines_and_corners_that_stay():
    truth = [polygon((60, 60), (450, 60), (450, 400), (60, 400), (60, 60))]
    (stroke,) = drawn(inked(truth))
    assert len(stroke) < 40
    assert np.hypot(*(stroke - (450, 400)).T).min() < 2.5


def test_dots_are_dots():
    points = [polygon((x, 100), (x, 100)) for x in (100, 300)]
    picture = inked([polygon((60, 256), (450, 256)), *points], 9)
    dots = [stroke for stroke in drawn(picture) if (stroke[0] == stroke[-1]).all()]
    assert sorted(np.rint(dot).astype(int).tolist() for dot in dots) == [[[100, 100]] * 2, [[300, 100]] * 2]
    picture[400, 400] = 0
    assert len(drawn(picture)) == 3


def test_a_gap_is_joined_as_asked():
    dashes = [polygon((60, 200), (200, 200)), polygon((210, 200), (400, 200))]
    assert len(drawn(inked(dashes), join_mm=0.5)) == 2
    assert len(drawn(inked(dashes), join_mm=3.0)) == 1


def test_short_strokes_are_dropped_as_asked():
    lines = [polygon((60, 200), (400, 200)), polygon((60, 300), (80, 300))]
    assert len(drawn(inked(lines), shortest_mm=3.0)) == 2
    assert length(drawn(inked(lines), shortest_mm=12.0)) == pytest.approx(340, rel=0.02)


def test_in_any_light_and_on_a_blackboard():
    truth = cartoon()
    y, x = np.indices(SHAPE)
    shaded = (inked(truth, 3) * (0.25 + 0.75 * x / 512) * (1 - 0.3 * y / 512)).astype(np.uint8)
    for picture in (shaded, 255 - inked(truth)):
        strokes = drawn(picture)
        assert len(truth) <= len(strokes) <= len(truth) + 1
        assert rms_and_covered(strokes, truth)[1] > 0.98


def test_lines_at_the_very_edge():
    picture = np.full((100, 140), 255, np.uint8)
    picture[:4], picture[:, -4:] = 0, 0
    (stroke,) = drawn(picture)
    assert stroke.min() >= 0 and (stroke.max(axis=0) <= [139, 99]).all()


def test_hardly_any_contrast_is_no_ink():
    faint = 255 - (255 - inked(cartoon())) // 20
    assert not find_ink(faint.astype(np.uint8))[0].any()
