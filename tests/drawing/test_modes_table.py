"""The table of modes says what the modes do, and every value that it offers draws."""

from __future__ import annotations

from dataclasses import fields
from functools import cache

import cv2
import numpy as np
import pytest

from app.drawing.compose import Composition, Look, compose
from app.drawing.errors import DrawingError
from app.drawing.modes import DRAWING_MODES, MAX_STROKES, PAPER, PICTURE, PORTRAIT
from app.drawing.prepare import APERTURES
from app.drawing.rasterise import RASTER_MODES
from app.drawing.rasterise.mode import Parameter
from app.drawing.settings import accepted
from app.drawing.source import Source
from app.drawing.vectorise import MODES as VECTOR_MODES
from app.drawing.vectorise import Settings, vectorise
from tests.drawing.vectorise.pictures import photo
from tests.support.paper import face

ENDS = [
    (mode, parameter, end)
    for mode, entry in DRAWING_MODES.items()
    for parameter in entry.parameters
    for end in sorted({*parameter.choices} or {parameter.low, parameter.high})
]
EMPTY = {("auto", "smooth", 31.0), ("sketch", "smooth", 31.0)}
"""Where nothing is left of the small picture."""

VECTOR = ("auto", *VECTOR_MODES)


@cache
def picture() -> Source:
    """A face with a line drawn through it and a black disc: something for every mode."""
    grey = face(120)[20:80].copy()
    cv2.line(grey, (5, 5), (115, 40), (0,), 2)
    cv2.circle(grey, (25, 45), 12, (0,), -1)
    return Source("small", grey)


@cache
def drawn(mode: str, **parameters: float) -> Composition:
    return compose(picture(), Look(mode, (40.0, 40.0), 4.0, parameters=parameters))


def same(one: list[np.ndarray], other: list[np.ndarray]) -> bool:
    return len(one) == len(other) and all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


def test_every_mode_is_in_the_table():
    assert list(DRAWING_MODES) == ["auto", *VECTOR_MODES, *RASTER_MODES, PORTRAIT]


@pytest.mark.parametrize("mode", DRAWING_MODES)
def test_a_mode_explains_itself(mode):
    entry = DRAWING_MODES[mode]
    names = [parameter.name for parameter in entry.parameters]
    assert len(set(names)) == len(names) and entry.title and entry.explanation.endswith(".")
    assert len({each.label for each in entry.parameters}) == len(names)
    assert set(names) <= accepted(mode)
    for name in ("width", "gamma", "smooth"):
        assert name in names


@pytest.mark.parametrize("mode", DRAWING_MODES)
def test_ranges_are_those_of_a_slider(mode):
    for each in DRAWING_MODES[mode].parameters:
        assert each.low <= each.default <= each.high and each.step > 0.0, each.name
        if not each.auto:
            steps = (each.default - each.low) / each.step
            assert steps == pytest.approx(round(steps), abs=1e-6), f"{each.name}: no slider can show its default"
    odd = next((each for each in DRAWING_MODES[mode].parameters if each in PICTURE and each.name == "smooth"), None)
    assert odd is None or (odd.low % 2 == 1 and odd.step % 2 == 0)


@pytest.mark.parametrize("mode", DRAWING_MODES)
def test_the_defaults_are_what_the_mode_does(mode):
    entry = DRAWING_MODES[mode]
    explicit = {name: value for name, value in entry.defaults.items() if value != "auto"}
    assert explicit and same(drawn(mode).strokes, drawn(mode, **explicit).strokes)


@pytest.mark.parametrize("mode", [mode for mode in VECTOR_MODES if mode != PAPER])
def test_own_lengths_are_used(mode):
    """Just beside the default, the strokes change for some picture: it is not only shown, but used."""
    grey = photo()[:250, :250]
    defaults = DRAWING_MODES[mode].defaults
    usual = vectorise(grey, mode, 0.3).strokes
    for name in ("shortest_mm", "join_mm"):
        value = defaults[name]
        assert isinstance(value, float)
        assert same(usual, vectorise(grey, mode, 0.3, **{name: value}).strokes)
    assert not same(usual, vectorise(grey, mode, 0.3, shortest_mm=20.0).strokes)


def test_the_table_offers_what_the_functions_take():
    vector = {name for mode in VECTOR for name in (each.name for each in DRAWING_MODES[mode].parameters)}
    assert vector == {field.name for field in fields(Settings)} | {each.name for each in PICTURE}
    for name, mode in RASTER_MODES.items():
        own = {each.name for each in mode.parameters}
        assert {each.name for each in DRAWING_MODES[name].parameters} == own | {each.name for each in PICTURE}
    assert DRAWING_MODES["canny"].parameters[3].choices == tuple(map(float, APERTURES))


@pytest.mark.parametrize("mode", VECTOR_MODES)
def test_a_mode_offers_no_setting_that_does_nothing(mode):
    """And none is missing that does something."""
    grain = 12.0 * np.random.default_rng(0).standard_normal((200, 200))
    grey = np.clip(photo()[100:300, 100:300] + grain, 0, 255).astype(np.uint8)
    others = {"aperture": 7, "low": 5.0, "high": 35.0, "strong": 0.02, "weak": 0.065, "shortest_mm": 15.0}
    others |= {"join_mm": 5.0, "smooth_px": 5.0, "tolerance_mm": 1.0}
    usual = vectorise(grey, mode, 0.3).strokes
    effective = {name for name, value in others.items() if not same(usual, _strokes(grey, mode, name, value))}
    assert effective <= {each.name for each in DRAWING_MODES[mode].parameters}
    assert effective >= {each.name for each in DRAWING_MODES[mode].parameters} - {"width", "gamma", "smooth", "join_mm"}


def _strokes(grey: np.ndarray, mode: str, name: str, value: float) -> list[np.ndarray]:
    return vectorise(grey, mode, 0.3, **{name: value}).strokes


@pytest.mark.parametrize(("mode", "parameter", "end"), ENDS, ids=lambda value: getattr(value, "name", value))
def test_every_end_of_every_slider_draws_or_says_why_not(mode: str, parameter: Parameter, end: float):
    if (mode, parameter.name, end) in EMPTY:
        with pytest.raises(DrawingError, match="nothing to draw"):
            drawn(mode, **{parameter.name: end})
        return
    made = drawn(mode, **{parameter.name: end})
    assert made.mode == mode or mode == "auto"
    points = np.concatenate(made.strokes)
    assert np.isfinite(points).all() and np.abs(points).max() <= 16.5
    assert 1 <= len(made.strokes) <= MAX_STROKES
