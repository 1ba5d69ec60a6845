"""The course follows what happens to its folder."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from app.classroom.lessons.course import Course
from app.classroom.lessons.mistake import LessonMistake
from app.classroom.lessons.numbers import Varied
from tests.support.small_lesson import WHOLE, write_lesson

BROKEN = WHOLE.replace("minutes = 10", "minutes = 100")
SOMETIMES_OUT_OF_REACH = WHOLE.replace("from = -60\nto = 60\nstep = 5", "choose = [0, 900]")


def change(path: Path, source: str) -> None:
    """Write it, surely later than before."""
    before = path.stat().st_mtime_ns
    path.write_text(source)
    os.utime(path, ns=(before + 1_000_000, before + 1_000_000))


def test_lessons_come_in_order_and_broken_ones_apart(tmp_path: Path) -> None:
    for name in ("02-b", "01-a", "10-c"):
        write_lesson(tmp_path, name=name)
    write_lesson(tmp_path, BROKEN, name="03-broken")
    (tmp_path / "README.md").write_text("no lesson")
    course = Course(tmp_path)
    assert list(course.files) == ["01-a", "02-b", "10-c"]
    assert [mistake.reason[:25] for mistake in course.broken.values()] == ["The steps take 10 minutes"]


def test_changes_on_disk_are_seen(tmp_path: Path) -> None:
    path = write_lesson(tmp_path)
    course = Course(tmp_path)
    kept = course.lesson("01-small", 3)
    assert not course.refresh() and course.lesson("01-small", 3) is kept
    change(path, WHOLE.replace('"Small"', '"Smaller"'))
    assert course.refresh() and course.lesson("01-small", 3).title == "Smaller"
    change(path, BROKEN)
    assert course.refresh() and list(course.broken) == ["01-small"] and not course.files
    change(path, WHOLE)
    assert course.refresh() and list(course.files) == ["01-small"] and not course.broken
    write_lesson(tmp_path, name="02-next")
    assert course.refresh() and list(course.files) == ["01-small", "02-next"]
    path.unlink()
    assert course.refresh() and list(course.files) == ["02-next"]
    assert not course.refresh()


def test_a_picture_that_appears_is_a_change(tmp_path: Path) -> None:
    write_lesson(tmp_path)
    course = Course(tmp_path)
    (tmp_path / "01-leg.svg").write_text("<svg/>")
    assert course.refresh() and not course.refresh()


def test_numbers_that_fail_for_one_student_leave_the_lesson_to_the_others(tmp_path: Path) -> None:
    write_lesson(tmp_path, SOMETIMES_OUT_OF_REACH)
    course = Course(tmp_path)
    good, bad = (
        next(seed for seed in range(50) if Varied("x", (0, 900)).draw(seed, "01-small") == x) for x in (0, 900)
    )
    with pytest.raises(LessonMistake, match="cannot be computed with x = 900"):
        course.lesson("01-small", bad)
    assert course.lesson("01-small", good).title == "Small"


def test_a_folder_that_is_not_there_has_no_lessons(tmp_path: Path) -> None:
    assert Course(tmp_path / "none").files == {}
