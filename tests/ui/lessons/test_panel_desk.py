"""A student's way through a course: order, answers, the watched act, hints, pace, redo, hot reload. No page."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from pathlib import Path

import pytest

from app.errors import UserMistake
from app.ui.lessons.answers import read_answer
from app.ui.lessons.desk import LessonDesk
from app.ui.lessons.examiner import LOOKS_TO_PASS
from app.ui.lessons.open_step import OpenStep
from tests.support.classroom import TEACHER, a_class, joined, with_teacher
from tests.support.lesson_scene import FIRST, Scene

ONE, TWO = "01-first", "02-second"


def play(folder: Path, act: Callable[[Scene, LessonDesk], Awaitable[None]], **options: object) -> None:
    """Run a scene on an event loop of its own."""

    async def scene() -> None:
        stage = Scene(folder, **options)  # type: ignore[arg-type]
        await act(stage, await stage.open())
        stage.close()

    asyncio.run(scene())


def opened(desk: LessonDesk) -> OpenStep:
    assert desk.open_step is not None, desk.problem
    return desk.open_step


async def until(condition: Callable[[], object]) -> None:
    for _ in range(500):
        if condition():
            return
        await asyncio.sleep(0.01)
    raise AssertionError("it never came")


def finish_first_step(scene: Scene, desk: LessonDesk) -> None:
    desk.go(ONE, 1)
    opened(desk).predict(2)
    scene.act()
    opened(desk).explain(40.0)


def test_a_step_is_set_up_in_order_and_with_its_robot(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        assert scene.facts.set_before == ["robot", "geometry.rf", "pose.x"]
        assert scene.facts.known["geometry.rf"] == 130 and desk.place == (ONE, 1)
        assert desk.map.progress.lesson == ONE

    play(tmp_path, act)


def test_predict_act_explain_come_in_this_order_and_only_once(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        step = opened(desk)
        step.explain(40.0)
        scene.act()
        assert step.standing.phase == "predict" and not step.standing.work.acted
        step.predict(1)
        step.predict(2)
        assert step.standing.work.prediction == 1 and not step.standing.shows_prediction
        step.explain(40.0)
        assert step.standing.phase == "act"
        scene.act()
        assert step.standing.phase == "explain" and step.standing.shows_prediction
        step.answer_more(80.0)
        assert step.more_grade is None
        step.explain(-40.0)
        assert step.grade is not None and not step.grade.right and "sign" in step.grade.feedback
        step.explain(40.0)
        step.explain(1.0)
        assert step.standing.done and step.standing.work.answer == 40.0
        step.answer_more(80.0)
        assert step.more_grade is not None and step.more_grade.right

    play(tmp_path, act)


def test_all_checks_must_hold_at_once_but_those_that_stay_met(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        step = opened(desk)
        step.predict(2)
        scene.facts.tell(conditioning=2.0)
        step.look()
        scene.facts.tell(conditioning=9.0)
        step.look()
        assert [verdict.met for verdict in step.examiner.verdicts] == [False, True]
        scene.facts.tell(pose_x=40.0)
        step.look()
        scene.facts.tell(pose_x=0.0)
        step.look()
        assert not step.standing.work.acted, "it only passed through"
        scene.facts.tell(pose_x=41.0)
        for look in range(LOOKS_TO_PASS):
            assert not step.standing.work.acted, look
            step.look()
        assert step.standing.work.acted

    play(tmp_path, act)


def test_nothing_counts_while_something_computes(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        step = opened(desk)
        step.predict(2)
        scene.facts.busy = True
        scene.act()
        assert not step.standing.work.acted and not step.standing.work.checks
        scene.facts.busy = False
        scene.act()
        assert step.standing.work.acted

    play(tmp_path, act)


def test_nothing_counts_while_the_task_is_not_the_same(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        step = opened(desk)
        step.predict(2)
        scene.facts.tell(geometry_rf=200.0)
        scene.act()
        assert step.examiner.astray == ("geometry.rf",) and not step.standing.work.acted
        step.set_up_again()
        assert scene.facts.known["geometry.rf"] == 130 and scene.facts.known["pose.x"] == 0
        scene.act()
        assert step.examiner.astray == () and step.standing.work.acted

    play(tmp_path, act)


def test_the_page_looks_by_itself_when_something_changes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("app.ui.lessons.open_step.LOOK_EVERY_S", 0.005)

    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        opened(desk).predict(2)
        looks: list[None] = []
        desk.marked.connect(looks.append)
        for k in range(1000):
            scene.facts.tell(conditioning=2.0, pose_x=40.0 - 0.001 * k)
        await until(lambda: opened(desk).standing.work.acted)
        assert len(looks) < 5, "a thousand changes at once are one look, and one more to be sure"

    play(tmp_path, act)


def test_the_next_step_is_locked_until_this_one_is_done(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        desk.next()
        desk.go(ONE, 2)
        assert desk.place == (ONE, 1) and desk.problem
        assert [dot for _, dot in desk.map.dots(ONE, 1)] == ["here", "locked"]
        finish_first_step(scene, desk)
        desk.next()
        assert desk.place == (ONE, 2) and not desk.problem
        opened(desk).explain(1)
        desk.next()
        assert desk.screen == "end" and desk.map.share(ONE) == (2, 2)
        desk.back()
        assert desk.place == (ONE, 2)
        desk.leave()
        assert desk.screen == "list" and desk.lesson is None

    play(tmp_path, act)


@pytest.mark.parametrize(("key", "number"), [("nowhere", 1), (ONE, 0), (ONE, 99), ("", 1), ("../01-first", 1)])
def test_places_that_are_none_open_nothing(tmp_path: Path, key: str, number: int):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(key, number)
        desk.redo(key, number)
        await asyncio.sleep(0)
        await until(lambda: not desk.fetching)
        assert desk.open_step is None and desk.problem

    play(tmp_path, act)


def test_hints_come_one_after_the_other_and_are_counted(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        for count in (1, 2, 3, 3):
            opened(desk).take_hint()
            assert opened(desk).standing.work.hints == count

    play(tmp_path, act)


def test_a_step_is_tried_again_with_other_numbers(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(TWO)
        await until(lambda: desk.open_step)
        first = opened(desk).step.explain
        assert first is not None and first.number is not None
        desk.redo(TWO, 1)
        assert "Finish" in desk.problem, "what is not done is not redone"
        opened(desk).explain(-1.0)
        opened(desk).explain(first.number.answer)
        assert opened(desk).standing.phase == "done" and desk.map.redo_list() == ((TWO, 1),)
        desk.redo(TWO, 1)
        await until(lambda: opened(desk).standing.phase == "explain")
        again = opened(desk).step.explain
        assert again is not None and again.number is not None and again.number.answer != first.number.answer
        assert not desk.why_not_next, "the way on stays open"
        opened(desk).explain(again.number.answer)
        assert desk.map.redo_list() == ()

    play(tmp_path, act)


def test_a_student_who_comes_back_finds_his_place_and_keeps_what_is_there(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        finish_first_step(scene, desk)
        desk.close()
        scene.facts.set_before.clear()
        again = LessonDesk(scene.library, scene.classroom, scene.browser, scene.facts)
        again.begin()
        assert again.place == (ONE, 1) and opened(again).standing.done
        assert scene.facts.set_before == [] and scene.facts.known["pose.x"] == 40.0
        scene.facts.tell(robot="par4")
        third = LessonDesk(scene.library, scene.classroom, scene.browser, scene.facts)
        third.begin()
        assert scene.facts.known["robot"] == "delta3", "another robot is another task"
        fourth = LessonDesk(scene.library, scene.classroom, scene.browser, scene.facts)
        fourth.begin(come_back=False)
        assert fourth.screen == "list"
        again.close()
        third.close()
        fourth.close()

    play(tmp_path, act)


def test_an_address_opens_a_lesson_at_once(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.begin("01")
        assert desk.place == (ONE, 1)
        desk.leave()
        desk.begin("<script>", come_back=False)
        assert desk.open_step is None and "no lesson" in desk.problem

    play(tmp_path, act)


def test_what_cannot_be_set_up_is_said(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        scene.facts.refuses = "geometry.rf"
        desk.go(ONE)
        assert "geometry.rf is stuck" in opened(desk).problem

    play(tmp_path, act)


def test_what_was_not_saved_is_not_shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)

        def refuse(*_: object) -> None:
            raise UserMistake("The disk is full.")

        monkeypatch.setattr(scene.classroom, "record", refuse)
        opened(desk).predict(2)
        assert opened(desk).standing.phase == "predict" and opened(desk).problem == "The disk is full."
        monkeypatch.undo()
        opened(desk).predict(2)
        assert opened(desk).standing.phase == "act" and not opened(desk).problem

    play(tmp_path, act)


def test_the_instructor_says_how_far_and_takes_everybody_along(tmp_path: Path):
    classroom = with_teacher(a_class())
    joined(classroom, "Ada")

    async def act(scene: Scene, desk: LessonDesk) -> None:
        classroom.set_pace(TEACHER, "up_to", ONE, 1)
        finish_first_step(scene, desk)
        desk.next()
        assert desk.place == (ONE, 1) and "up to step 1 of lesson 1" in desk.problem
        desk.go(TWO)
        assert desk.place == (ONE, 1)
        classroom.set_pace(TEACHER, "all_at", TWO, 1)
        await until(lambda: desk.place == (TWO, 1))
        classroom.set_pace(TEACHER, "all_at", ONE, 2)
        assert desk.place == (ONE, 2), "also to a step that is not unlocked yet"

    play(tmp_path, act, classroom=classroom, browser="Ada")


def test_the_instructor_himself_goes_where_he_likes(tmp_path: Path):
    classroom = with_teacher(a_class())

    async def act(scene: Scene, desk: LessonDesk) -> None:
        classroom.set_pace(TEACHER, "all_at", ONE, 1)
        desk.go(ONE, 2)
        assert desk.place == (ONE, 2) and not desk.why_not_next

    play(tmp_path, act, classroom=classroom, browser=TEACHER)


def test_a_visitor_of_a_class_joins_first_and_is_then_where_he_wanted(tmp_path: Path):
    classroom = a_class()

    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.begin("01")
        desk.go(ONE)
        assert desk.open_step is None and "Join" in desk.problem
        joined(classroom, "Ada")
        assert desk.place == (ONE, 1)

    play(tmp_path, act, classroom=classroom, browser="Ada")


def test_who_is_removed_sees_the_list_again(tmp_path: Path):
    classroom = with_teacher(a_class())
    ada = joined(classroom, "Ada")

    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        classroom.remove(TEACHER, ada.id)
        assert desk.open_step is None and desk.screen == "list"

    play(tmp_path, act, classroom=classroom, browser="Ada")


def test_two_students_see_other_numbers_and_nothing_of_each_other(tmp_path: Path):
    classroom = a_class()
    joined(classroom, "Ada")
    joined(classroom, "Ben")

    async def act(scene: Scene, desk: LessonDesk) -> None:
        other = LessonDesk(scene.library, classroom, "Ben", scene.facts)
        news: list[None] = []
        other.changed.connect(news.append)
        desk.go(TWO)
        await until(lambda: desk.open_step)
        assert not news
        other.go(TWO)
        await until(lambda: other.open_step)
        assert desk.lesson is not None and other.lesson is not None
        assert desk.lesson.steps[0].text != other.lesson.steps[0].text
        other.close()

    play(tmp_path, act, classroom=classroom, browser="Ada")


def test_a_changed_file_is_shown_anew_at_the_same_place(tmp_path: Path):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        finish_first_step(scene, desk)
        path = tmp_path / f"{ONE}.md"
        path.write_text(FIRST.replace("Some text.", "Another text."))
        scene.library.look()
        await until(lambda: not desk.fetching)
        assert "Another text." in opened(desk).step.text and opened(desk).standing.done
        path.write_text("+++\nnonsense")
        scene.library.look()
        assert desk.place == (ONE, 1) and "roken" in desk.problem
        assert ONE in scene.library.broken and TWO in scene.library.files
        path.write_text(FIRST)
        scene.library.look()
        await until(lambda: not desk.fetching)
        assert not desk.problem and "Some text." in opened(desk).step.text

    play(tmp_path, act)


@pytest.mark.parametrize(
    ("typed", "value"),
    [("12.5", 12.5), (" −3 ", -3.0), ("12,5", 12.5), ("1e3", 1000.0), ("40 mm", 40.0), (".5", 0.5), ("+2", 2.0)],
)
def test_numbers_are_read_as_people_write_them(tmp_path: Path, typed: str, value: float):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        question = opened(desk).step.explain
        assert question is not None and read_answer(question, typed) == value

    play(tmp_path, act)


@pytest.mark.parametrize("typed", ["", "many", "1e999", "nan", "inf", "1 or 2", "<b>1</b>", "--1"])
def test_what_is_no_number_is_asked_for_again(tmp_path: Path, typed: str):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        for question in (opened(desk).step.explain, opened(desk).step.predict):
            assert question is not None
            with pytest.raises(UserMistake):
                read_answer(question, typed)

    play(tmp_path, act)


@pytest.mark.parametrize("typed", ["0", "3", "1.5", "-1"])
def test_an_option_must_be_one_of_them(tmp_path: Path, typed: str):
    async def act(scene: Scene, desk: LessonDesk) -> None:
        desk.go(ONE)
        question = opened(desk).step.predict
        assert question is not None
        with pytest.raises(UserMistake):
            read_answer(question, typed)

    play(tmp_path, act)
