"""Text in single strokes: every character, its place, and what is said about those that are missing."""

from __future__ import annotations

import string
from functools import lru_cache
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import KDTree

from app.drawing.errors import DrawingError
from app.drawing.lettering import Align, letter_strokes, unknown_characters
from app.drawing.lettering_glyphs import GLYPHS, MARKS
from app.drawing.svg_path import path_polylines

PRINTABLE = [chr(code) for code in range(0x21, 0x7F)]
ACCENTED = list("ÄÖÜäöüßéèêëáàâíìîïóòôúùûñçåÅÉÑÇ¿¡°±€")
BAR = (-3.0, 11.0)
"""From where to where `|` goes, at 10 mm from the line that letters stand on."""

SLACK = 0.02
"""mm by which arcs may miss a line: their ends are rounded to hundredths, and they are drawn as chords."""

Points = NDArray[np.float64]


def box(strokes: list[Points]) -> tuple[float, float, float, float]:
    """Left, bottom, right, top."""
    points = np.concatenate(strokes)
    return (*points.min(axis=0), *points.max(axis=0))


def width(text: str) -> float:
    left, _, right, _ = box(letter_strokes(text))
    return right - left


@lru_cache
def between_bars(character: str) -> tuple[Points, ...]:
    """Strokes of a character: x from the bar before it, y from the line that letters stand on, at 10 mm."""
    first, *strokes, last = letter_strokes(f"|{character}|")
    assert np.ptp(first[:, 0]) == np.ptp(last[:, 0]) == 0.0
    corner = np.array([first[0, 0], first[:, 1].min() - BAR[0]])
    return tuple(stroke - corner for stroke in [*strokes, last])


@pytest.mark.parametrize("character", PRINTABLE + ACCENTED)
def test_every_character_is_drawn_in_its_box(character):
    *strokes, last = between_bars(character)
    assert strokes and not unknown_characters(character)
    left, bottom, right, top = box(strokes)
    assert left == pytest.approx(2.0) and last[0, 0] - right == pytest.approx(2.0)  # spacing 0.2 of 10 mm
    assert bottom >= BAR[0] - SLACK and top <= (14.0 if character in "ÅÉÑÄÖÜ" else 11.6)
    assert right - left <= 8.5


def test_the_table_keeps_its_word():
    """Characters begin at x = 0, and a mark is about as far to the left of 0 as to the right."""
    for data in GLYPHS.values():
        assert box(path_polylines(data, 0.01))[0] == pytest.approx(0.0, abs=SLACK)
    for data in MARKS.values():
        left, _, right, _ = box(path_polylines(data, 0.01))
        assert -left == pytest.approx(right, abs=0.25)


def test_letters_stand_on_the_line_and_reach_their_heights():
    for character in string.ascii_uppercase + string.digits:
        _, bottom, _, top = box(list(between_bars(character)[:-1]))
        assert (bottom, top) == pytest.approx((-0.6 if character == "Q" else 0.0, 10.0), abs=SLACK)
    for character in "acemnorsuvwxz":
        assert box(list(between_bars(character)[:-1]))[1::2] == pytest.approx((0.0, 7.0), abs=SLACK)
    for character in "gpqyj":
        assert box(list(between_bars(character)[:-1]))[1] == pytest.approx(-3.0, abs=SLACK)


def samples(strokes: tuple[Points, ...]) -> Points:
    parts = np.linspace(0.0, 1.0, 12)[:, None, None]
    return np.concatenate([(stroke[:-1] + parts * np.diff(stroke, axis=0)).reshape(-1, 2) for stroke in strokes])


def test_no_two_characters_look_alike():
    """Somewhere any two differ by more than the width of the pen."""
    clouds = {character: samples(between_bars(character)[:-1]) for character in PRINTABLE}
    trees = {character: KDTree(cloud) for character, cloud in clouds.items()}
    for a, b in combinations(PRINTABLE, 2):
        apart = max(trees[a].query(clouds[b])[0].max(), trees[b].query(clouds[a])[0].max())
        assert apart > 0.5, (a, b)


def test_bowls_are_round():
    (stroke,) = letter_strokes("O")
    step = np.diff(stroke, axis=0)
    assert np.linalg.norm(step, axis=1).sum() == pytest.approx(2 * np.pi * 3 + 2 * 4, rel=1e-3)
    turn = np.diff(np.unwrap(np.arctan2(step[:, 1], step[:, 0])))
    assert np.abs(turn).max() < np.radians(15) and (stroke[0] == stroke[-1]).all()
    (large,) = letter_strokes("O", 100.0)
    assert len(large) > 2 * len(stroke)


@pytest.mark.parametrize("align", ["left", "center", "right"])
@pytest.mark.parametrize("text", ["Delta", "Delta Lab\ndraws", "g", ".", "a\n\nb"])
def test_text_is_in_the_middle_of_the_sheet(text, align):
    left, bottom, right, top = box(letter_strokes(text, align=align))
    assert left == pytest.approx(-right) and bottom == pytest.approx(-top)


@given(st.sampled_from([0.5, 3.0, 25.0, 200.0]))
def test_the_size_is_the_height_of_capitals(size):
    _, bottom, _, top = box(letter_strokes("HI", size))
    assert top - bottom == pytest.approx(size)
    assert width("Delta") * size / 10 == pytest.approx(np.ptp(np.concatenate(letter_strokes("Delta", size))[:, 0]))


@given(st.text(st.sampled_from([*PRINTABLE, " "]), min_size=1, max_size=20), st.sampled_from(PRINTABLE))
def test_text_grows_by_every_character(text, character):
    text = f"I{text}"
    assert width(text + character) >= width(f"{text}I") - 1e-9 > width(text.rstrip())
    assert len(letter_strokes(text + character)) == len(letter_strokes(text)) + len(letter_strokes(character))


def test_spacing_and_spaces():
    assert width("II") == pytest.approx(2.0)
    assert np.ptp(np.concatenate(letter_strokes("II", 20.0, spacing=0.5))[:, 0]) == pytest.approx(10.0)
    assert width("I I") == pytest.approx(8.0) and width("I\tI") == width("I\xa0I") == width("I I")


def test_lines_are_below_one_another_and_aligned():
    sides: list[tuple[Align, int]] = [("left", 0), ("right", 2)]
    for align, side in sides:
        strokes = letter_strokes("H\nlong", align=align)
        upper, lower = strokes[:3], strokes[3:]
        assert box(upper)[side] == pytest.approx(box(lower)[side])
    upper, lower = letter_strokes("HHH\nI")[:9], letter_strokes("HHH\nI")[9:]
    assert sum(box(upper)[0::2]) == pytest.approx(sum(box(lower)[0::2]))
    assert box(upper)[1] - box(lower)[1] == pytest.approx(17.0)
    first, second = letter_strokes("I\r\nI", 20.0, line_pitch=2.0)
    assert first[:, 1].min() - second[:, 1].min() == pytest.approx(40.0) and first[0, 0] == second[0, 0]


def test_accents_stand_free_over_the_letter():
    for letter, accented, marks in [("A", "Ä", 2), ("u", "ü", 2), ("e", "é", 1), ("n", "ñ", 1), ("E", "Ê", 1)]:
        plain, whole = between_bars(letter)[:-1], between_bars(accented)[:-1]
        assert len(whole) == len(plain) + marks
        assert box(list(whole[len(plain) :]))[1] > box(list(plain))[3] + 1.0
        middle = sum(box(list(whole[len(plain) :]))[0::2]) / 2
        assert middle == pytest.approx(sum(box(list(whole[: len(plain)]))[0::2]) / 2, abs=0.2)
    assert len(letter_strokes("ï")) == 3  # without the dot of the i


def test_ways_to_write_the_same_text():
    for same, text in [("A\N{COMBINING DIAERESIS}", "Ä"), ("“it’s” – so", '"it\'s" - so'), ("a\rb", "a\nb")]:
        for stroke, wanted in zip(letter_strokes(same), letter_strokes(text), strict=True):
            np.testing.assert_array_equal(stroke, wanted)


def test_unknown_characters_are_boxes_and_named():
    assert unknown_characters("Delta → 日本 Lab, → ü\n") == "→日本"
    assert unknown_characters("\x07q\N{COMBINING LONG SOLIDUS OVERLAY}") == "\x07\N{COMBINING LONG SOLIDUS OVERLAY}"
    for unknown in "→日\x07ạ":
        (stroke,) = letter_strokes(unknown)
        assert len(stroke) == 5 and (stroke[0] == stroke[-1]).all()


@pytest.mark.parametrize(
    ("text", "options", "complaint"),
    [
        ("", {}, "no letter to draw"),
        (" \n\t", {}, "no letter to draw"),
        ("x" * 5001, {}, "longer than 5000 characters"),
        ("x", {"size_mm": 0.0}, "a size above 0"),
        ("x", {"size_mm": np.nan}, "a size above 0"),
        ("x", {"spacing": -1.0}, "a size above 0"),
        ("x", {"line_pitch": np.inf}, "a size above 0"),
        ("x", {"align": "middle"}, "not 'middle'"),
    ],
)
def test_refusals(text, options, complaint):
    with pytest.raises(DrawingError, match=complaint):
        letter_strokes(text, **options)


@given(st.text(min_size=1, max_size=20))
def test_any_text_is_drawn_or_refused(text):
    try:
        strokes = letter_strokes(text)
    except DrawingError:
        assert not text.strip()
        return
    assert all(len(stroke) >= 2 and np.isfinite(stroke).all() for stroke in strokes)
