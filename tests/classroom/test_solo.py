"""Everybody works alone: names by browser, and the instructor's PIN."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.classroom import solo
from app.classroom.classroom import Classroom
from app.classroom.errors import ClassroomRefusal
from app.classroom.events import opened, predicted
from app.classroom.names import LONGEST_NAME
from app.classroom.opening import open_classroom
from app.classroom.people import TRIES, TRIES_OF_ALL
from tests.support.classroom import Clock


def test_everybody_has_a_name_of_his_own_and_keeps_it():
    people = Classroom.in_memory()
    assert [people.person(key).name for key in "abcab"] == ["Guest 1", "Guest 2", "Guest 3", "Guest 1", "Guest 2"]
    assert len({people.person(key).key for key in "abcab"}) == 3


@pytest.mark.parametrize(
    ("typed", "kept"), [("  Ada   L ", "Ada L"), ("", "Guest 1"), ("\u202e", "Guest 1"), ("x" * 99, "x" * LONGEST_NAME)]
)
def test_a_name_without_a_letter_changes_nothing(typed: str, kept: str):
    people = Classroom.in_memory()
    assert people.rename("a", typed).name == kept == people.person("a").name


def test_only_the_pin_makes_an_instructor_who_then_stays_one():
    people = Classroom.in_memory(pin="0471")
    assert "not the PIN" in people.prove("a", "471") and not people.person("a").instructor
    assert people.prove("a", " 0471 ") == ""
    assert people.rename("a", "Ms Ng").instructor and not people.person("b").instructor
    assert people.is_instructor("a") and not people.is_instructor("b")


def test_wrong_pins_are_limited_by_browser_for_a_minute():
    clock = Clock()
    people = Classroom.in_memory(pin="0471", clock=clock)
    for _ in range(TRIES):
        assert "not the PIN" in people.prove("a", "1111")
    assert "Too many" in people.prove("a", "0471"), "the right one too: else the limit would be of no use"
    assert people.prove("b", "0471") == ""
    clock.now += 61.0
    assert people.prove("a", "0471") == ""


def test_new_browsers_give_no_more_than_the_tries_of_all():
    people = Classroom.in_memory(pin="0471", clock=Clock())
    for number in range(TRIES_OF_ALL):
        assert "not the PIN" in people.prove(f"browser {number}", "1111")
    assert "Too many" in people.prove("another", "0471")


def test_without_a_pin_nobody_is_the_instructor():
    assert "no instructor" in Classroom.in_memory().prove("a", "")


def test_work_is_there_after_a_restart_and_a_mere_visit_leaves_nothing(tmp_path: Path):
    file = tmp_path / "alone.sqlite3"
    people = Classroom.in_file(file, in_class=False)
    ada = people.member("a")
    assert ada is not None and people.member("visitor") is not None
    people.record(ada, opened("01-meet", 1))
    people.record(ada, predicted("01-meet", 1, 2))
    people.rename("a", "Ada")
    people.close()
    again = Classroom.in_file(file, in_class=False)
    assert again.member("a") == ada.__class__(ada.id, "Ada", ada.seed)
    assert again.progress(ada).of("01-meet", 1).prediction == 2
    assert [row.name for row in again.everybody] == ["Ada"]
    again.close()


def test_visitors_who_do_something_do_not_fill_the_disk(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(solo, "LARGEST", 5)
    people = Classroom.in_memory()
    for number in range(5):
        people.record(people.member(str(number)), opened("01-meet", 1))  # type: ignore[arg-type]
    with pytest.raises(ClassroomRefusal, match="no more"):
        people.record(people.member("one more"), opened("01-meet", 1))  # type: ignore[arg-type]


def test_a_file_in_use_is_no_reason_not_to_learn_alone(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    first = open_classroom(None, in_class=False)
    second = open_classroom(None, in_class=False)
    assert first.notice == "" and "not kept" in second.notice and "Another Delta Lab" in second.notice
    member = second.member("a")
    assert member is not None
    second.record(member, opened("01-meet", 1))
    first.close()
    second.close()
