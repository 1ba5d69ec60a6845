"""What the lesson panel says, as HTML: who sees what, words beside every colour, nothing of a student's unescaped."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path

import pytest

from app.ui.lessons.desk import LessonDesk
from app.ui.lessons.open_step import OpenStep
from app.ui.panels.lessons import list_view, step_view
from app.ui.panels.lessons.markup import figure
from tests.support.classroom import TEACHER, a_class, joined, with_teacher
from tests.support.lesson_scene import FIRST, Scene

ONE = "01-first"
VOID = {"br", "img", "input", "hr"}


def play(folder: Path, act: Callable[[Scene, LessonDesk], None], **options: object) -> None:
    async def scene() -> None:
        stage = Scene(folder, **options)  # type: ignore[arg-type]
        act(stage, await stage.open())
        stage.close()

    asyncio.run(scene())


def opened(desk: LessonDesk) -> OpenStep:
    assert desk.open_step is not None, desk.problem
    return desk.open_step


class Balanced(HTMLParser):
    """Fails where a tag is closed that was not opened, or the other way round."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self._open: list[str] = []
        self.feed(page)
        assert not self._open, f"never closed: {self._open}"

    def handle_starttag(self, tag: str, attrs: object) -> None:
        if tag not in VOID:
            self._open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self._open and self._open.pop() == tag, f"</{tag}> closes nothing"


def all_of(desk: LessonDesk, *, instructor: bool = False) -> str:
    """The whole page of the open step."""
    step = opened(desk)
    assert desk.lesson is not None
    stretches = [
        step_view.head(desk.lesson, desk.map.dots(*desk.place)),
        step_view.text(step, instructor=instructor),
        *(view(step) for view in (step_view.predict, step_view.act, step_view.checks)),
        *(view(step) for view in (step_view.explain, step_view.more)),
        step_view.helps(step, asking=False),
        step_view.foot(step, desk.why_not_next, desk.problem),
    ]
    page = "".join(stretches)
    Balanced(page)
    return page


def test_a_step_shows_what_is_due_and_no_more(tmp_path: Path):
    def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        page = all_of(desk)
        assert 'data-lesson="predict"' in page and "Ask the class" not in page
        for later in ("It stands at", 'data-lesson="explain"', "Yes, down.", "Where is it?", "And twice?"):
            assert later not in page
        opened(desk).predict(1)
        page = all_of(desk)
        assert 'data-lesson="predict"' not in page and "It stands at" in page and "Not up." not in page
        scene.act()
        page = all_of(desk)
        assert "Not up." in page and "✗ Not yet." in page and 'data-lesson="explain"' in page
        opened(desk).explain(-40.0)
        assert "Mind the sign." in all_of(desk) and 'aria-disabled="true"' in all_of(desk)
        opened(desk).explain(40.0)
        page = all_of(desk)
        assert "Right, 40." in page and 'data-lesson="more"' in page and 'data-lesson="redo"' in page

    play(tmp_path, act)


def test_check_marks_have_words_values_and_on_request_advice(tmp_path: Path):
    def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        step = opened(desk)
        step.predict(2)
        scene.facts.tell(conditioning=2.0)
        step.look()
        marks = step_view.checks(step)
        assert ">open<" in marks and ">done<" in marks and ">0 mm<" in marks and "Because it is" in marks
        assert "Move it to the right." not in marks
        step.ask()
        assert "Move it to the right." in step_view.checks(step)
        scene.facts.tell(geometry_rf=99.0)
        step.look()
        assert "A dimension by its symbol" in step_view.checks(step) and "Set up again" in step_view.checks(step)

    play(tmp_path, act)


def test_hints_are_asked_for_twice(tmp_path: Path):
    def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        step = opened(desk)
        assert "I need a hint (1 of 3)" in step_view.helps(step, asking=False)
        assert "are counted" in step_view.helps(step, asking=True)
        step.take_hint()
        page = step_view.helps(step, asking=False)
        assert "Where is it?" in page and "To the right." not in page and "(2 of 3)" in page

    play(tmp_path, act)


def test_the_instructor_sees_the_notes(tmp_path: Path):
    def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        assert "Ask the class." in all_of(desk, instructor=True)

    play(tmp_path, act, classroom=with_teacher(a_class()), browser=TEACHER)


def test_who_is_in_a_class_finds_his_own_code_and_nobody_elses(tmp_path: Path):
    classroom = a_class()
    ada, ben = joined(classroom, "Ada & <b>"), joined(classroom, "Ben")

    def act(scene: Scene, desk: LessonDesk) -> None:
        page = list_view.mine(desk.map, "")
        Balanced(page)
        assert ada.own_code in page and ben.own_code not in page
        assert "Ada &amp; &lt;b&gt;" in page

    play(tmp_path, act, classroom=classroom, browser="Ada & <b>")


def test_the_list_names_what_is_broken_and_what_to_try_again(tmp_path: Path):
    def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        opened(desk).predict(2)
        scene.act()
        opened(desk).explain(1.0)
        opened(desk).explain(40.0)
        (tmp_path / "02-second.md").write_text("+++\ntitle = '<script>'\nstrange = 1\n+++\n")
        scene.library.look()
        page = list_view.course(desk.map, "") + list_view.mine(desk.map, "")
        Balanced(page)
        assert "1 of 2 steps" in page and "02-second" in page and "Cannot be read. Line" in page
        assert "1.1 Move it" in page and f'data-value="{ONE} 1"' in page and "<script>" not in page

    play(tmp_path, act)


def test_the_end_of_a_lesson_sums_it_up(tmp_path: Path):
    def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        opened(desk).predict(2)
        opened(desk).take_hint()
        scene.act()
        opened(desk).explain(40.0)
        desk.next()
        opened(desk).explain(1)
        desk.next()
        assert desk.lesson is not None and desk.screen == "end"
        page = list_view.end(desk.map, desk.lesson, "")
        Balanced(page)
        assert "2 of 2 questions right at the first try" in page and "1 hint." in page and "Next: Numbers" in page

    play(tmp_path, act)


def test_an_authors_html_stays_text(tmp_path: Path):
    def act(scene: Scene, desk: LessonDesk) -> None:
        (tmp_path / f"{ONE}.md").write_text(FIRST.replace("Some text.", "Some <script>alert(1)</script> text."))
        scene.library.look()
        desk.go(ONE)
        assert "<script>" not in all_of(desk) and "&lt;script&gt;" in all_of(desk)

    play(tmp_path, act)


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (-12.3456, "mm", "−12.35 mm"),
        (float("nan"), "mm", "nothing yet"),
        (None, "", "nothing yet"),
        (True, "", "yes"),
        ("<b>", "", "&lt;b&gt;"),
        (2.0, "", "2"),
    ],
)
def test_facts_are_shown_as_people_read_them(value: float | bool | str | None, unit: str, text: str):
    assert figure(value, unit) == text
