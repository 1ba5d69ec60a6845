"""What a lesson file says is what the lesson holds; whatever a file holds, reading it never fails otherwise."""

from __future__ import annotations

import contextlib
import math
import pickle
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.classroom.lessons.lesson import Press, Relation, Set, Setting
from app.classroom.lessons.mistake import LessonMistake
from app.classroom.lessons.read import mistakes_in, read_lesson
from app.robots import make_robot
from tests.support.small_lesson import WHOLE, write_lesson

LINES = [f"{line}\n" for line in WHOLE.split("\n")]
TOKENS = [
    "<<x>>",
    "<<",
    "```",
    "```toml\n",
    "+++\n",
    "## A\n",
    "### Act\n",
    "$",
    "$$\n",
    "[[check]]\n",
    "- [x] a\n",
    "> b\n",
]
TOKENS += [
    "[set]\n",
    'is = "',
    "= {",
    "1. c\n",
    "\x00",
    "\u2028",
    "\t",
    "<b>",
    "![a](b.svg)",
    "[a](b)",
    "'''",
    "1e999",
    "é",
    "[" * 40,
]
VALUES = ["3", "-1", '"x"', "true", "[]", '[1, "a"]', "{ a = 1 }", "{}", "inf", "nan", "1979-05-27", '""', '"<<q>>"']
VALUES += ['"<<leg>>"', "[[1]]", "1e400", "9" * 40]
KEYS = [row for row, line in enumerate(LINES) if " = " in line]
robust = settings(
    max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
)


def test_a_lesson_is_read(tmp_path: Path) -> None:
    lesson = read_lesson(write_lesson(tmp_path)).personal(seed=4)
    first, second = lesson.steps
    assert (lesson.key, lesson.number, lesson.title, lesson.minutes) == ("01-small", 1, "Small", 10)
    assert (first.title, first.tab, first.may_change) == ("First step", "Robot", {"pose", "joint"})
    assert second.settings == () and second.may_change is None and second.act is None
    assert first.hints == ("A question?", "A hint.", "The worked step.")
    assert first.safety == "Mind your fingers."
    assert [name for name in ("predict", "act", "explain", "more") if getattr(second, name)] == ["explain"]


def test_options_have_texts_and_feedback(tmp_path: Path) -> None:
    predict = read_lesson(write_lesson(tmp_path)).outline.steps[0].predict
    assert predict is not None and predict.text == "Which way?"
    assert [(one.text, one.right, one.feedback) for one in predict.choices] == [
        ("Up.", False, "Not up."),
        ("Down, since\nit falls.", True, "Yes, down.\nAlways."),
    ]


def test_a_students_numbers_are_everywhere_the_same(tmp_path: Path) -> None:
    step = read_lesson(write_lesson(tmp_path)).personal(seed=4).steps[0]
    assert step.act and step.explain and step.explain.number and step.solution and step.wrong
    x = step.act.checks[0].is_
    assert isinstance(x, int)
    assert step.settings == (Setting("robot", "par4"), Setting("pose.x", x), Setting("pose.y", 0))
    assert step.text == f"A prompt with {x}." and step.act.text == f"Move it to {x}."
    assert step.act.checks[0].says == f"It stands at {x} mm."
    assert step.solution.deeds == (Set("pose.x", x), Press("jog")) and step.wrong.deeds == (Set("pose.y", 40),)
    leg = int(step.explain.text[15])
    q = math.degrees(make_robot("par4").solve(1e-3 * x, 0.02, -0.32, 0.0)[leg - 1])
    assert step.explain.number.answer == step.solution.explain == pytest.approx(q)
    assert step.explain.number.near[0].value == pytest.approx(-q)
    assert step.explain.number.right == f"Right, ${q:.1f}$."


def test_checks_are_read(tmp_path: Path) -> None:
    act = read_lesson(write_lesson(tmp_path)).outline.steps[0].act
    assert act is not None
    place, overshoot, reach = act.checks
    assert (place.unit, place.within, place.ever, place.at_most) == ("mm", 2, False, None)
    assert overshoot.at_most == Relation("kept.overshoot", 0.5, 0.0) and overshoot.ever and overshoot.if_not == "Less."
    assert reach.is_ is True
    assert [check.line for check in act.checks] == [row for row, text in enumerate(LINES, 1) if text == "[[check]]\n"]


def test_an_outline_needs_no_numbers(tmp_path: Path) -> None:
    """A formula that is out of reach breaks the student's lesson, and not the list of lessons."""
    file = read_lesson(write_lesson(tmp_path, WHOLE.replace("z = -320", "z = -3200")))
    assert file.outline.title == "Small"
    with pytest.raises(LessonMistake, match="q cannot be computed with x = "):
        file.personal(seed=1)


def test_a_lesson_and_its_mistakes_can_be_sent_to_another_process(tmp_path: Path) -> None:
    lesson = read_lesson(write_lesson(tmp_path)).personal(seed=1)
    assert pickle.loads(pickle.dumps(lesson)) == lesson
    mistake = pickle.loads(pickle.dumps(LessonMistake(tmp_path, 3, "Why.")))
    assert (mistake.path, mistake.line, mistake.reason) == (tmp_path, 3, "Why.")


def assert_only_mistakes(path: Path, content: bytes) -> None:
    path.write_bytes(content)
    rows = max(1, content.count(b"\n") + 1)
    assert all(1 <= mistake.line <= rows and mistake.reason.endswith((".", "?", ")")) for mistake in mistakes_in(path))
    with contextlib.suppress(LessonMistake):
        read_lesson(path).personal(seed=1)


@robust
@given(
    content=st.binary(max_size=300)
    | st.lists(st.sampled_from(TOKENS), max_size=12).map(lambda all: "".join(all).encode())
)
def test_whatever_a_file_holds_reading_it_tells_mistakes_only(tmp_path: Path, content: bytes) -> None:
    assert_only_mistakes(tmp_path / "01-any.md", content)


@robust
@given(
    edits=st.lists(
        st.tuples(
            st.integers(0, len(LINES) - 1), st.integers(0, 60), st.integers(0, 12), st.sampled_from(["", *TOKENS])
        ),
        min_size=1,
        max_size=4,
    )
)
def test_a_damaged_lesson_tells_mistakes_only(tmp_path: Path, edits: list[tuple[int, int, int, str]]) -> None:
    rows = list(LINES)
    for row, at, length, text in edits:
        rows[row] = rows[row][:at] + text + rows[row][at + length :]
    assert_only_mistakes(tmp_path / "01-any.md", "".join(rows).encode())


@robust
@given(st.lists(st.tuples(st.sampled_from(KEYS), st.sampled_from(VALUES)), min_size=1, max_size=3))
def test_a_value_of_any_kind_tells_mistakes_only(tmp_path: Path, edits: list[tuple[int, str]]) -> None:
    rows = list(LINES)
    for row, value in edits:
        rows[row] = f"{rows[row].partition(' = ')[0]} = {value}\n"
    assert_only_mistakes(tmp_path / "01-any.md", "".join(rows).encode())
