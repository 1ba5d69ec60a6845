"""From bytes to a path: `draw_image` keeps its contract."""

from __future__ import annotations

import re

import cv2
import numpy as np
import pytest

from app.drawing import DrawingError, draw_image
from app.drawing.exports import read_points_file, write_points_file, write_svg
from app.drawing.order import is_closed
from app.drawing.pipeline import MODES, STAGES
from app.drawing.toolpath import PenSettings, Placement, default_placement
from app.robots import make_robot
from tests.drawing.test_load import encoded
from tests.drawing.vectorise.pictures import circles_and_cross, inked, length
from tests.support.paper import face

LINES = circles_and_cross()
IMAGE = encoded(inked(LINES))
SMALL = encoded(face(80))
RECTANGLE = np.array([[-20.0, -10.0], [20.0, -10.0], [20.0, 10.0], [-20.0, 10.0], [-20.0, -10.0]])


def test_line_art_becomes_its_lines():
    drawing = draw_image(IMAGE)
    assert drawing.mode == "centreline" and len(drawing.strokes) == len(LINES) and drawing.sheet_mm == (160.0, 160.0)
    assert drawing.ink_mm == pytest.approx(length(LINES) * 160.0 / 512, rel=0.02)
    assert drawing.lifts == len(LINES) - 1
    assert sum(is_closed(stroke) for stroke in drawing.strokes) == 5


def test_the_numbers_are_those_of_the_path():
    drawing = draw_image(IMAGE, sheet_mm=(100.0, 100.0))
    path = drawing.toolpath
    assert drawing.time_s == path.t[-1]
    down = np.diff(path.pose[:, :2], axis=0)[path.pen[1:] & path.pen[:-1]]
    assert drawing.ink_mm == pytest.approx(1e3 * np.hypot(*down.T).sum(), rel=0.005)
    lifted = np.count_nonzero(np.diff(path.pen.astype(int)) == -1) - 1
    assert lifted == drawing.lifts


def test_the_way_with_the_pen_up_begins_at_the_first_stroke():
    drawing = draw_image(IMAGE)
    ends = [(before[-1], after[0]) for before, after in zip(drawing.strokes, drawing.strokes[1:], strict=False)]
    assert drawing.pen_up_mm == pytest.approx(sum(float(np.linalg.norm(b - a)) for a, b in ends))


@pytest.mark.parametrize("sheet", [(160.0, 160.0), (148.0, 210.0), (210.0, 148.0)])
def test_the_picture_fills_the_sheet_unless_a_margin_is_wanted(sheet):
    grey = np.full((200, 300), 255, np.uint8)
    cv2.rectangle(grey, (3, 3), (296, 196), (0,), 3)
    for margin in (0.0, 10.0):
        points = np.concatenate(draw_image(encoded(grey), "centreline", sheet, margin_mm=margin).strokes)
        side = min((sheet[0] - 2 * margin) / 300, (sheet[1] - 2 * margin) / 200)
        np.testing.assert_allclose(np.abs(points).max(axis=0), side * np.array([146.5, 96.5]), atol=side)


@pytest.mark.parametrize("data", [write_svg([RECTANGLE], (80.0, 60.0)).encode()])
def test_an_svg_is_drawn_as_it_is(data):
    drawing = draw_image(data, "sketch", (100.0, 100.0), margin_mm=10.0)
    assert drawing.mode == "strokes" and drawing.lifts == 0
    assert drawing.ink_mm == pytest.approx(2 * (80.0 + 40.0), rel=1e-3)
    assert drawing.time_s > drawing.ink_mm / 80.0


def test_what_was_drawn_can_be_drawn_again():
    first = draw_image(IMAGE, sheet_mm=(100.0, 100.0))
    text = write_points_file(first.strokes, first.sheet_mm)
    again = draw_image(text.encode(), sheet_mm=(100.0, 100.0))
    widest = np.ptp(np.concatenate(read_points_file(text)[0]), axis=0).max()
    assert len(again.strokes) == len(first.strokes)
    assert again.ink_mm == pytest.approx(first.ink_mm * 100.0 / widest)


def test_settings_find_their_way():
    """To the picture, the mode, the pen, the order and the sheet."""
    usual = draw_image(SMALL, "hatch", (60.0, 60.0))
    changed = {
        "gamma": draw_image(SMALL, "hatch", (60.0, 60.0), gamma=3.0).ink_mm > usual.ink_mm,
        "pitch": draw_image(SMALL, "hatch", (60.0, 60.0), pitch=3.0).lifts < usual.lifts,
        "speed_mm_s": draw_image(SMALL, "hatch", (60.0, 60.0), speed_mm_s=20.0).time_s > usual.time_s,
        "pen_mm": draw_image(SMALL, "hatch", (60.0, 60.0), pen_mm=1.0).lifts < usual.lifts,
        "scale": np.abs(np.concatenate(draw_image(SMALL, "hatch", (60.0, 60.0), scale=0.5).strokes)).max() < 16.0,
        "order_s": draw_image(SMALL, "hatch", (60.0, 60.0), order_s=0.2, seed=3).pen_up_mm <= usual.pen_up_mm * 1.01,
    }
    assert all(changed.values()), changed


def test_streamlines_have_a_smooth_of_their_own():
    rough, even = (draw_image(SMALL, "streamlines", (60.0, 60.0), smooth=smooth) for smooth in (1.5, 20.0))
    assert rough.ink_mm != even.ink_mm


def test_the_placement_is_where_it_is_drawn():
    robot = make_robot("delta3")
    usual = default_placement(robot)
    placement = Placement(usual.height_m, (0.02, -0.01), 0.5)
    path = draw_image(IMAGE, sheet_mm=(60.0, 60.0), placement=placement).toolpath
    drawn = path.pose[path.pen]
    np.testing.assert_allclose(drawn[:, 2], usual.height_m, atol=1e-6)
    middle = (drawn[:, :2].min(axis=0) + drawn[:, :2].max(axis=0)) / 2
    np.testing.assert_allclose(middle, placement.centre_m, atol=2e-3)


def test_stages_are_told_in_order():
    told: list[str] = []
    draw_image(SMALL, "squiggle", (60.0, 60.0), on_stage=told.append)
    assert tuple(told) == STAGES


def test_the_same_picture_gives_the_same_drawing():
    first, again = draw_image(IMAGE, "outline"), draw_image(IMAGE, "outline")
    assert all((a == b).all() for a, b in zip(first.strokes, again.strokes, strict=True))
    assert (first.toolpath.q == again.toolpath.q).all()


@pytest.mark.parametrize(
    ("arguments", "settings", "complaint"),
    [
        (("photo",), {}, f"no mode called photo; choose one of {', '.join(MODES)}"),
        (("hatch",), {"shortest_mm": 3}, "no setting shortest_mm"),
        (("sketch",), {"colour": "red"}, r"no setting colour; it has .*gamma.*lift.*margin_mm.*order_s"),
        (("sketch",), {"gamma": "red"}, "gamma cannot be 'red'"),
        (("sketch",), {"speed_mm_s": "fast"}, "speed_mm_s cannot be 'fast'"),
        (("sketch",), {"speed_mm_s": 0}, "speed"),
        (("sketch",), {"order_s": -1}, "order_s"),
        (("sketch",), {"order_s": float("nan")}, "order_s"),
        (("sketch",), {"margin_mm": 80}, "no room"),
        (("sketch",), {"pen_mm": "thin"}, "pen_mm cannot be 'thin'"),
        (("sketch", (100.0, 100.0), "arm"), {}, "no robot called arm"),
        (("sketch", (900.0, 900.0)), {}, "robot"),
    ],
)
def test_a_mistake_is_one_sentence(arguments, settings, complaint):
    with pytest.raises(DrawingError, match=complaint) as refusal:
        draw_image(IMAGE, *arguments, **settings)
    sentence = str(refusal.value)
    assert sentence.endswith(".") and not re.search(r"\.\s", sentence) and "\n" not in sentence


def test_the_pen_is_that_of_the_settings():
    drawing = draw_image(IMAGE, sheet_mm=(60.0, 60.0), lift_mm=10.0)
    heights = drawing.toolpath.pose[:, 2]
    assert np.ptp(heights) == pytest.approx(0.010, abs=1e-4)
    usual = draw_image(IMAGE, sheet_mm=(60.0, 60.0)).toolpath.pose[:, 2]
    assert np.ptp(usual) == pytest.approx(1e-3 * PenSettings().lift_mm, abs=1e-4)
