"""Pictures that give too many strokes, such as noise: refused at once, with a way out that helps."""

from __future__ import annotations

import pickle
import re

import numpy as np
import pytest

from app.drawing import TooManyStrokes, draw_image
from app.drawing.compose import Look, compose
from app.drawing.crowd import coarser_settings
from app.drawing.modes import DRAWING_MODES, MAX_STROKES
from app.drawing.source import Source, strokes_source
from app.drawing.vectorise import crowding, vectorise
from app.drawing.vectorise.pixel_graph import trace
from app.drawing.vectorise.thinning import thin
from tests.drawing.test_load import encoded
from tests.drawing.vectorise.pictures import circles_and_cross, inked, photo

SENTENCE = re.compile(
    r"This picture gives \d+ 000 strokes, more than the 10 000 that make sense: "
    r"set \w+ to [\d.]+( and \w+ to [\d.]+)? for a coarser drawing\."
)


def noise(kind: str, side: int = 400) -> np.ndarray:
    random = np.random.default_rng(0)
    if kind == "grey":
        return random.integers(0, 256, (side, side)).astype(np.uint8)
    if kind == "dithered":
        tone = np.linspace(0.1, 0.9, side)
        return np.where(tone > random.random((side, side)), 255, 0).astype(np.uint8)
    return np.where(random.random((side, side)) < 0.5, 255, 0).astype(np.uint8)


def refusal_of(source: Source, mode: str) -> TooManyStrokes | None:
    try:
        compose(source, Look(mode))
    except TooManyStrokes as crowd:
        return crowd
    return None


@pytest.mark.parametrize("kind", ["grey", "black and white", "dithered"])
@pytest.mark.parametrize(
    "mode", ["auto", "centreline", "outline", "canny", "paper", "threshold_rows", "sketch", "hatch"]
)
def test_too_many_strokes_are_refused_with_a_way_out(mode, kind):
    """And the way out helps, at once."""
    source = Source("noise", noise(kind))
    crowd = refusal_of(source, mode)
    if crowd is None:
        assert mode not in ("centreline", "threshold_rows")
        return
    assert crowd.count > MAX_STROKES and SENTENCE.fullmatch(str(crowd))
    offered = {each.name: each for each in DRAWING_MODES[mode].parameters}
    for name, value in crowd.coarser.items():
        assert offered[name].low <= value <= offered[name].high
    made = compose(source, Look(mode, parameters=crowd.coarser))
    assert 1 <= len(made.strokes) <= MAX_STROKES


def test_noise_is_refused_before_its_lines_are_traced(monkeypatch):
    """Tracing them took minutes."""
    monkeypatch.setattr("app.drawing.vectorise.tracing.trace", lambda _: pytest.fail("they were traced"))
    with pytest.raises(TooManyStrokes):
        compose(Source("noise", noise("black and white", 1000)), Look("centreline", (210.0, 297.0)))


def test_strokes_are_counted_before_they_are_put_in_order(monkeypatch):
    monkeypatch.setattr("app.drawing.compose.order_strokes", lambda *_, **__: pytest.fail("they were ordered"))
    with pytest.raises(TooManyStrokes):
        compose(Source("noise", noise("grey")), Look("threshold_rows"))


def test_the_way_out_works_through_draw_image():
    data = encoded(noise("black and white", 300))
    with pytest.raises(TooManyStrokes) as crowd:
        draw_image(data, "centreline", (100.0, 100.0))
    assert draw_image(data, "centreline", (100.0, 100.0), **crowd.value.coarser).time_s > 1.0


def test_many_given_strokes_are_refused_too():
    strokes = [np.array([[k, 0.0], [k, 1.0]]) for k in range(MAX_STROKES + 1)]
    with pytest.raises(TooManyStrokes, match="simplify") as crowd:
        compose(strokes_source("many", strokes), Look())
    assert crowd.value.count == MAX_STROKES + 1 and crowd.value.coarser == {}


def test_the_refusal_goes_to_another_process():
    again = pickle.loads(pickle.dumps(TooManyStrokes("Too many.", 41_000, {"smooth": 9.0})))
    assert (str(again), again.count, again.coarser) == ("Too many.", 41_000, {"smooth": 9.0})


def test_it_becomes_coarser_with_every_step():
    present: dict[str, float] = {}
    seen = []
    for _ in range(4):
        present |= coarser_settings(60_000, "canny", present)
        seen.append(present.copy())
    assert [step["smooth"] for step in seen] == [15, 31, 31, 31]
    assert [step["shortest_mm"] for step in seen] == [5, 10, 20, 20]
    assert "width" not in seen[1] and seen[2]["width"] < 500


def test_tones_become_coarser_by_their_own_settings():
    assert coarser_settings(20_000, "stipple", {"dots": 20_000}) == {"dots": 5000}
    assert 2.0 < coarser_settings(20_000, "hatch", {})["pitch"] <= 4.0
    assert set(coarser_settings(15_000, "threshold_rows", {})) == {"pitch"}
    assert set(coarser_settings(60_000, "threshold_rows", {})) == {"smooth", "pitch"}
    assert coarser_settings(20_000, "streamlines", {}) == {}


@pytest.mark.parametrize("mask", [inked(circles_and_cross()) < 128, noise("grey", 100) < 60, photo() < 60])
def test_lines_are_counted_without_tracing_them(mask):
    """As many as there are; rings, which have no end, are left out."""
    thinned = thin(mask)
    branches = trace(thinned)
    has_length = np.array([len(line) > 1 for line in branches.lines])
    rings = np.count_nonzero((branches.degrees == 0).all(axis=1) & has_length)
    assert crowding.line_count(thinned) == pytest.approx(len(branches.lines) - rings, rel=0.02, abs=1)


@pytest.mark.parametrize("mode", ["canny", "sketch", "outline"])
def test_a_real_picture_is_far_from_being_too_much(mode):
    for grey in (photo(), inked(circles_and_cross())):
        found = vectorise(grey, mode, 0.25)
        assert found.strokes and crowding.line_count(thin(found.edge_mask)) < crowding.MAX_LINES / 20
