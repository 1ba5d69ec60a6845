"""A student's report: complete, safe to open, with plots."""

from __future__ import annotations

import math
import pickle
import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.classroom.classroom import Classroom
from app.classroom.events import acted, checked, explained, hint, more, opened, predicted, redo
from app.classroom.lessons.lesson import Act, Check, Choice, Lesson, NumberAnswer, Question, Step
from app.classroom.report import deeds_of, report_from, report_html, report_markdown
from app.classroom.report.chart import chart_svg
from app.classroom.report.data import Answer, CheckMark, Report
from app.classroom.report.words import duration
from app.classroom.ticks import tick_words, ticks, widened
from tests.support.classroom import LESSON, a_class, joined

SVG = "{http://www.w3.org/2000/svg}"
EVIL = '<img src=x onerror="x()">'
PLOT = {
    "title": f"Step {EVIL}",
    "x_label": "time in s",
    "y_label": "angle in deg",
    "series": [
        {"label": "set-point", "x": [0, 1, 2], "y": [10, 10, 10]},
        {"label": "measured & <b>", "x": [0, 0.5, 1, 1.5, 2], "y": [0, 8, None, 11, 10]},
    ],
}
CHOICES = (Choice("On a $line$", False, "No."), Choice("On a circle", True, "Yes."))
NUMBER = NumberAnswer(41.5, "deg", 0.5, "Right.", "Wrong.")


def _lesson(seed: int) -> Lesson:
    act = Act("Go.", (Check("pose.x", "mm", f"x = {seed % 7} mm"), Check("pose.y", "mm", "y = 0")))
    choose, compute = Question("?", CHOICES), Question("?", number=NUMBER)
    first = Step(1, "One leg", 4, "", predict=choose, act=act, explain=compute, more=choose)
    second = Step(2, "All legs", 10, "")
    title = "A circle & a sphere"
    return Lesson(LESSON, 2, title, 30, "par4", (), (), (), False, "", (first, second), Path("x.md"))


def lessons(key: str, seed: int) -> Lesson | None:
    return _lesson(seed) if key == LESSON else None


def report_after(classroom: Classroom, *events, name: str = EVIL) -> Report:
    ada = joined(classroom, name) if classroom.in_class else classroom.member("ada")
    assert ada is not None
    for event in events:
        classroom.record(ada, event)
    return report_from(pickle.loads(pickle.dumps(deeds_of(classroom, ada))), lessons)


WORK = (
    opened(LESSON, 1),
    predicted(LESSON, 1, 1),
    checked(LESSON, 1, 0),
    acted(LESSON, 1, [PLOT]),
    hint(LESSON, 1, 2),
    explained(LESSON, 1, -41.5, False),
    explained(LESSON, 1, 41.6, True),
    more(LESSON, 1, 2, True),
    opened(LESSON, 2),
)


def test_a_report_tells_what_was_done_in_the_words_of_the_lesson():
    report = report_after(a_class(), *WORK)
    (lesson,) = report.lessons
    one, two = lesson.steps
    assert (lesson.title, lesson.done, lesson.steps_of, report.steps_of) == ("A circle & a sphere", 1, 2, 3)
    assert one.done and not two.done
    assert one.prediction == Answer("On a $line$", False)
    assert [check.met for check in one.checks] == [True, True]
    assert one.answers == (Answer("-41.5 deg", False), Answer("41.6 deg", True))
    assert one.more == (Answer("On a circle", True),)
    assert (one.hints, one.attempts, len(one.plots)) == (2, 1, 1) and report.first_tries == (0, 1)


def test_the_latest_attempt_counts_with_its_own_numbers():
    report = report_after(a_class(), *WORK, redo(LESSON, 1), checked(LESSON, 1, 1), explained(LESSON, 1, 41.5, True))
    step = report.lessons[0].steps[0]
    assert step.answers == (Answer("41.5 deg", True),) and step.attempts == 2 and step.done
    assert [check.met for check in step.checks] == [False, True]
    first = report_after(a_class(), *WORK[:2]).lessons[0].steps[0].checks[0]
    assert isinstance(first, CheckMark) and first.text.startswith("x = ")


def test_a_lesson_that_is_gone_does_not_spoil_the_report():
    report = report_after(a_class(), opened("99-gone", 3), explained("99-gone", 3, 2, True), *WORK)
    assert [lesson.title for lesson in report.lessons] == ["A circle & a sphere", "99-gone"]
    assert report.lessons[1].steps[0].title == "Step 3" and report.lessons[1].steps[0].answers == (Answer("2", True),)
    assert "99-gone" in report_html(report)


def test_it_works_alone_and_before_anything_was_done():
    empty = report_after(Classroom.in_memory())
    assert (
        "Guest 1" in report_html(empty) and "No lesson" in report_html(empty) and "No lesson" in report_markdown(empty)
    )
    assert report_after(Classroom.in_memory(), *WORK).lessons[0].steps[0].answers


class _Tags(HTMLParser):
    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.attributes: set[str] = set()
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}


def test_what_was_typed_is_text_and_nothing_is_loaded_from_elsewhere():
    page = report_html(report_after(a_class(), *WORK))
    found = _Tags(page)
    assert not found.tags & {"img", "script", "link", "iframe"} and {"svg", "math"} <= found.tags
    assert not found.attributes & {"src", "href", "onerror"}
    assert "&lt;img" in page and "time in s" in page and "41.6 deg" in page
    assert set(re.findall(r"https?://[^\"' <)]+", page)) <= {
        "http://www.w3.org/2000/svg",
        "http://www.w3.org/1998/Math/MathML",
    }


def test_markdown_has_the_same_and_its_plots_inside():
    from app.classroom.lessons.render import to_html

    text = report_markdown(report_after(a_class(), *WORK))
    assert "- Answer 2: 41.6 deg (right)" in text and "- [x] y = 0" in text and "data:image/svg+xml;base64," in text
    assert "\\<img" in text and "<img src=x" not in to_html(text.split("##")[0])


def test_a_chart_draws_every_line_with_its_gaps_and_names_them():
    chart = ET.fromstring(chart_svg(PLOT))
    lines = chart.findall(f".//{SVG}polyline")
    assert len(lines) == 3, "one line, and one that a gap divides"
    assert len({line.get("stroke") for line in lines}) == 2
    words = [text.text for text in chart.iter(f"{SVG}text")]
    assert {"time in s", "angle in deg", "set-point", "measured & <b>", f"Step {EVIL}"} <= set(words)


def _points(chart: str) -> list[tuple[float, float]]:
    line = ET.fromstring(chart).find(f".//{SVG}polyline")
    assert line is not None
    return [(float(x), float(y)) for x, y in (pair.split(",") for pair in (line.get("points") or "").split())]


def test_equal_axes_keep_a_circle_round():
    turns = [2.0 * math.pi * number / 60 for number in range(61)]
    series = {"label": "", "x": [30 * math.cos(a) for a in turns], "y": [5 + 30 * math.sin(a) for a in turns]}
    xs, ys = zip(*_points(chart_svg({"series": [series], "equal": True})), strict=True)
    assert max(xs) - min(xs) == pytest.approx(max(ys) - min(ys), rel=0.01)
    xs, ys = zip(*_points(chart_svg({"series": [series]})), strict=True)
    assert max(xs) - min(xs) > 1.5 * (max(ys) - min(ys))


NUMBERS = st.none() | st.floats(-1e12, 1e12)


@given(st.lists(st.tuples(NUMBERS, NUMBERS), max_size=8), st.booleans(), st.text(max_size=200))
def test_any_plot_can_be_drawn(points: list, equal: bool, label: str):
    xs, ys = [x for x, _ in points], [y for _, y in points]
    printable = "".join(character for character in label if character.isprintable())
    ET.fromstring(chart_svg({"equal": equal, "series": [{"label": printable, "x": xs, "y": ys}]}))


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [
        (0.0, 10.0, ["0", "2", "4", "6", "8", "10"]),
        (-0.06, 0.06, ["−0.050", "−0.025", "0.000", "0.025", "0.050"]),
        (0.0, 1.5, ["0.0", "0.5", "1.0", "1.5"]),
        (-300.0, -290.0, ["−300", "−298", "−296", "−294", "−292", "−290"]),
    ],
)
def test_axes_have_round_numbers(low: float, high: float, words: list[str]):
    assert tick_words(ticks(low, high)) == words


def test_a_flat_line_has_an_axis_too():
    assert widened([5.0, 5.0]) == (2.5, 7.5) and widened([]) == (-0.04, 1.04)


@pytest.mark.parametrize(
    ("seconds", "words"), [(0.0, "0 min"), (30.0, "under 1 min"), (95.0, "2 min"), (3700.0, "1 h 02 min")]
)
def test_times_are_readable(seconds: float, words: str):
    assert duration(seconds) == words
