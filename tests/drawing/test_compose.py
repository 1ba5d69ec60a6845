"""Compositions: where the drawing lies on its sheet, in which order, and what is refused."""

from __future__ import annotations

import dataclasses
import pickle
from itertools import pairwise

import cv2
import numpy as np
import pytest

from app.drawing.compose import MANY, STAGES, Look, compose
from app.drawing.errors import DrawingError
from app.drawing.order import pen_up_s
from app.drawing.rasterise import render_ink, similarity
from app.drawing.source import Source, strokes_source, text_source
from tests.drawing.vectorise.pictures import circles_and_cross, filled, inked, length, logo, photo, rms_and_covered
from tests.support.paper import face, flat

A5 = (148.0, 210.0)


def picture(grey) -> Source:
    return Source("picture", grey)


def bounds(strokes) -> tuple[float, ...]:
    points = np.concatenate(strokes)
    return (*points.min(axis=0), *points.max(axis=0))


def frame(height: int, width: int, border: int = 5) -> np.ndarray:
    """A picture with a line along its border."""
    grey = np.full((height, width), 255, np.uint8)
    cv2.rectangle(grey, (border, border), (width - 1 - border, height - 1 - border), (0,), 3)
    return grey


@pytest.mark.parametrize(
    ("look", "width", "height"),
    [
        (Look(), 128.0, 64.0),
        (Look(sheet_mm=(210.0, 148.0)), 190.0, 95.0),
        (Look(sheet_mm=(210.0, 100.0), margin_mm=0.0), 200.0, 100.0),
        (Look(margin_mm=24.0), 100.0, 50.0),
        (Look(scale=0.5), 64.0, 32.0),
    ],
)
def test_a_picture_fills_the_margins(look, width, height):
    """Its frame is drawn 5 of 400 pixels inside its border."""
    made = compose(picture(frame(200, 400)), dataclasses.replace(look, mode="centreline"))
    inset = 5.5 * width / 400
    wanted = np.array([width, height]) / 2 - inset
    np.testing.assert_allclose(bounds(made.strokes), (*-wanted, *wanted), atol=0.6 * width / 400)
    assert made.prepared is not None
    assert made.mm_per_px * made.prepared.shape[1] == pytest.approx(width, rel=1e-3)


def test_the_picture_is_neither_turned_nor_mirrored():
    grey = np.full((300, 300), 255, np.uint8)
    cv2.line(grey, (20, 20), (140, 20), (0,), 3)  # top left, and half as long to the lower right
    cv2.line(grey, (220, 280), (280, 280), (0,), 3)
    made = compose(picture(grey), Look("centreline"))
    left, right = sorted(made.strokes, key=lambda stroke: stroke[:, 0].mean())
    assert left[:, 1].mean() > 40.0 and right[:, 1].mean() < -40.0
    assert length([left]) == pytest.approx(2 * length([right]), rel=0.05)


@pytest.mark.parametrize("source", [text_source("Delta Lab"), strokes_source("line", [[[3, 7], [9, 7]]])])
def test_strokes_are_fitted_like_a_picture(source):
    made = compose(source, Look("sketch", scale=0.5))
    x0, y0, x1, y1 = bounds(made.strokes)
    assert (x0, x1) == pytest.approx((-32.0, 32.0)) and y0 == pytest.approx(-y1)
    before = bounds(source.strokes)
    assert (y1 - y0) / 64.0 == pytest.approx((before[3] - before[1]) / (before[2] - before[0]))
    assert (made.mode, made.similarity, made.prepared, made.mm_per_px) == ("strokes", None, None, 1.0)


def test_strokes_in_place_stay_there():
    stroke = np.array([[10.0, 20.0], [30.0, -40.0]])
    made = compose(strokes_source("pad", [stroke], in_place=True), Look(scale=0.5))
    assert len(made.strokes) == 1
    np.testing.assert_allclose(sorted(made.strokes[0].tolist()), sorted(stroke.tolist()))
    beyond = compose(strokes_source("pad", [3 * stroke], in_place=True), Look())
    assert "larger than its sheet" in beyond.notes[0]


def test_a_dot_stays_where_it_is():
    made = compose(strokes_source("dot", [[[5, 5], [5, 5]]]), Look())
    assert [stroke.tolist() for stroke in made.strokes] == [[[0, 0], [0, 0]]]


def test_hand_drawn_strokes_are_ordered_and_joined():
    corners = np.array([[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]], float)
    sides = list(np.stack([corners[:-1], corners[1:]], axis=1))
    made = compose(strokes_source("square", [sides[0], sides[2][::-1], sides[3], sides[1]]), Look())
    assert len(made.strokes) == 1 and (made.strokes[0][0] == made.strokes[0][-1]).all()
    assert length(made.strokes) == pytest.approx(4 * 128.0)


def test_strokes_that_touch_are_one_but_in_the_papers_way():
    for mode in ("sketch", "canny", "outline", "paper", "squiggle", "hatch", "streamlines", "portrait"):
        strokes = compose(picture(face(150)), Look(mode, (80.0, 80.0))).strokes
        gaps = np.array([np.linalg.norm(after[0] - before[-1]) for before, after in pairwise(strokes)])
        assert mode == "paper" or (gaps > 0.05).all(), mode


def test_the_order_spares_time():
    made = compose(picture(inked(circles_and_cross())), Look("outline"))
    shuffled = [made.strokes[k] for k in np.random.default_rng(1).permutation(len(made.strokes))]
    assert pen_up_s(made.strokes) < 0.9 * pen_up_s(shuffled)


def test_many_strokes_are_in_a_good_order_too():
    dots = np.random.default_rng(0).random((MANY + 500, 1, 2)).repeat(2, axis=1) * 100
    made = compose(strokes_source("dots", list(dots)), Look(scale=0.8))
    assert MANY < len(made.strokes) <= len(dots), "a few touch"
    mean_hop = np.mean([np.linalg.norm(b[0] - a[-1]) for a, b in pairwise(made.strokes)])
    assert mean_hop < 1.1 * 0.8 * 128.0 / np.sqrt(len(dots)), "a shortest way takes 0.71 of that, a greedy one 0.9"


def test_lines_are_where_they_are_in_the_picture():
    lines = circles_and_cross()
    made = compose(picture(inked(lines)), Look("auto", margin_mm=10.0))
    assert made.mode == "centreline" and len(made.strokes) == len(lines)
    truth = [(line - 255.5) * (1, -1) * 128.0 / 512 for line in lines]
    off, covered = rms_and_covered([s / 0.25 for s in made.strokes], [t / 0.25 for t in truth])
    assert off < 0.5 and covered > 0.99


@pytest.mark.parametrize("mode", ["squiggle", "hatch", "threshold_rows"])
@pytest.mark.parametrize("pen_mm", [0.4, 1.0])
def test_tones_are_right_for_the_pen(mode, pen_mm):
    """As dark on the sheet as wanted, by another simulation of the ink: 80 % of ink is black."""
    made = compose(picture(flat(0.6, 300)), Look(mode, (60.0, 60.0), 5.0, pen_mm=pen_mm))
    ink = 1.0 - render_ink(made.strokes, (60.0, 60.0), pen_mm, 10.0)[100:-100, 100:-100].mean() / 255.0
    assert ink == pytest.approx(0.97 if mode == "threshold_rows" else 0.48, abs=0.04)


def test_similarity_is_that_of_the_whole_picture():
    grey = cv2.resize(face(256), (1000, 1000), interpolation=cv2.INTER_CUBIC)
    good, bad = (compose(picture(grey), Look(mode)) for mode in ("squiggle", "threshold_rows"))
    assert good.similarity is not None and bad.similarity is not None
    assert good.similarity > 0.9 > 0.5 > bad.similarity
    assert good.prepared is not None
    half = np.array(good.prepared.shape[::-1]) / 2
    pixels = [stroke * (1, -1) / good.mm_per_px + half - 0.5 for stroke in good.strokes]
    assert good.similarity == pytest.approx(similarity(good.prepared, pixels, good.mm_per_px, 0.5), abs=0.05)


def test_no_finer_than_the_pen_unless_wanted():
    grey = photo()
    coarse, given = (compose(picture(grey), Look("canny", pen_mm=1.0, parameters=p)) for p in ({}, {"width": 512}))
    assert coarse.prepared is not None and given.prepared is not None
    assert coarse.prepared.shape == (320, 320) and coarse.mm_per_px == pytest.approx(0.4)
    assert given.prepared.shape == (512, 512)


def test_auto_and_none_leave_a_setting_to_the_mode():
    looks = [Look("canny", parameters=p) for p in ({}, {"low": "auto", "width": "auto", "shortest_mm": None})]
    first, second = (compose(picture(photo()), look).strokes for look in looks)
    assert len(first) == len(second) and all((a == b).all() for a, b in zip(first, second, strict=True))


def test_the_weight_of_a_portrait():
    def ink(look: Look) -> float:
        return length(compose(picture(face(200)), look).strokes)

    light, usual, full = (ink(Look("portrait", weight=weight)) for weight in (0.0, 0.5, 1.0))
    assert light < usual < full
    assert ink(Look("portrait", weight=0.5, parameters={"weight": 1.0})) == full
    assert light == pytest.approx(ink(Look("sketch")))


def test_what_goes_beyond_the_sheet_is_said():
    grey = frame(210, 148)
    assert compose(picture(grey), Look(scale=1.0)).notes == ()
    assert "larger than its sheet" in compose(picture(grey), Look(scale=1.5)).notes[0]


def test_stages_come_in_order_and_the_same_comes_out_twice():
    told: list[str] = []
    first = compose(picture(face(150)), Look("hatch"), on_stage=told.append)
    assert tuple(told) == STAGES
    again = pickle.loads(pickle.dumps(compose(picture(face(150)), Look("hatch"), seed=7)))
    assert all((a == b).all() for a, b in zip(first.strokes, again.strokes, strict=True))


@pytest.mark.parametrize(
    ("look", "complaint"),
    [
        (Look("photo"), "no mode called photo"),
        (Look(margin_mm=74.0), "no room"),
        (Look(margin_mm=-1.0), "no room"),
        (Look(sheet_mm=(0.0, 10.0)), "no room"),
        (Look(sheet_mm=(float("nan"), 10.0)), "no room"),
        (Look(scale=0.0), "scale of 0"),
        (Look(scale=float("nan")), "scale of nan"),
        (Look(pen_mm=0.0), "0 mm wide"),
        (Look("portrait", weight=2.0), "between 0"),
        (Look("canny", parameters={"wave": 3}), "no setting wave"),
        (Look("hatch", parameters={"shortest_mm": 3}), "no setting shortest_mm"),
        (Look("canny", parameters={"gamma": "red"}), "cannot be 'red'"),
        (Look("canny", parameters={"gamma": True}), "cannot be True"),
        (Look("canny", parameters={"gamma": [1]}), "cannot be"),
        (Look("canny", parameters={"gamma": float("nan")}), "gamma of nan"),
        (Look("canny", parameters={"low": 50, "high": 20}), "at most the high one"),
        (Look("canny", parameters={"aperture": 4}), "3, 5 or 7"),
        (Look("canny", parameters={"high": 1e6}), "nothing to draw"),
    ],
)
def test_what_cannot_be_is_refused_in_one_sentence(look, complaint):
    with pytest.raises(DrawingError, match=complaint) as refusal:
        compose(picture(filled(logo())), look)
    assert str(refusal.value).endswith(".") and "\n" not in str(refusal.value)
