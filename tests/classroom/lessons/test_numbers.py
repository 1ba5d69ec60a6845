"""A student's own numbers: always the same for one, well spread over many."""

from __future__ import annotations

import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from app.classroom.lessons.fill import Fill
from app.classroom.lessons.numbers import Varied, written
from app.classroom.lessons.read import read_lesson
from tests.support.small_lesson import WHOLE, write_lesson

VARIED = Varied("x", tuple(range(-60, 61, 5)))


def test_the_same_student_draws_the_same_everywhere() -> None:
    """Python's own hash of a text differs from one process to the next."""
    code = (
        "from app.classroom.lessons.numbers import Varied as V; print(V('x', tuple(range(-60, 61, 5))).draw(7, '01-a'))"
    )
    elsewhere = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert int(elsewhere) == VARIED.draw(7, "01-a") == 0


def test_draws_are_spread_evenly() -> None:
    counts = Counter(VARIED.draw(seed, "01-a") for seed in range(2500))
    assert set(counts) == set(VARIED.values)
    assert 60 < min(counts.values()) <= max(counts.values()) < 150, "100 of each are expected"


def test_lessons_and_names_draw_apart() -> None:
    other_name = Varied("y", VARIED.values)
    pairs = {
        (VARIED.draw(seed, "01-a"), VARIED.draw(seed, "02-b"), other_name.draw(seed, "01-a")) for seed in range(60)
    }
    assert len(pairs) > 50


@pytest.mark.parametrize(
    ("range_", "values"),
    [
        ("from = 1\nto = 4\nstep = 1", {"1", "2", "3", "4"}),
        ("from = 0.1\nto = 0.4\nstep = 0.1", {"0.1", "0.2", "0.3", "0.4"}),
        ("from = 0\nto = 10\nstep = 4", {"0", "4", "8"}),
        ('choose = ["Up", "Down"]', {"Up", "Down"}),
    ],
)
def test_what_is_drawn(tmp_path: Path, range_: str, values: set[str]) -> None:
    source = WHOLE.replace("from = -60\nto = 60\nstep = 5", range_).replace('x = "<<x>>"', "x = 1")
    file = read_lesson(write_lesson(tmp_path, source.replace('"<<x>>"', "1")))
    assert {file.personal(seed).intro for seed in range(60)} == {f"Welcome to $x = {value}$ mm." for value in values}


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (3, None, "3"),
        (0.1 + 0.2, None, "0.3"),
        (-0.04, 1, "0.0"),
        (-12.345, 2, "-12.35"),
        (2.0, 0, "2"),
        ("up", None, "up"),
    ],
)
def test_numbers_are_written(value: float | str, digits: int | None, text: str) -> None:
    assert written(value, digits).text == text


def test_a_text_of_one_mark_becomes_the_number() -> None:
    fill = Fill({"x": written(2.5, 2)})
    assert fill.value({"q<<x>>": ["<<x>>", " << x >> ", "x = <<x>>", "<<y>>"]}) == {
        "q2.50": [2.5, 2.5, "x = 2.50", "<<y>>"]
    }
