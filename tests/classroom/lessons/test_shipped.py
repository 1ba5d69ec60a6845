"""The lessons that come with Delta Lab: whole, in order, as long as a lesson may be. Another test plays them."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.classroom.lessons.build import PAPERS
from app.classroom.lessons.read import inspected, read_lesson
from app.resources import lessons_dir

FILES = sorted(lessons_dir().glob("[0-9][0-9]-*.md"))
FEWEST = 16
MINUTES = range(20, 41)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_lesson_has_no_mistakes(path: Path) -> None:
    found = inspected(path)
    assert [str(mistake) for mistake in (*found.found, *found.notes)] == []


def test_the_course_is_complete() -> None:
    lessons = [read_lesson(path).outline for path in FILES]
    assert [lesson.number for lesson in lessons] == list(range(1, len(lessons) + 1)) and len(lessons) >= FEWEST
    assert {lesson.title: lesson.minutes for lesson in lessons if lesson.minutes not in MINUTES} == {}
    assert {paper for lesson in lessons for paper in lesson.papers} == set(PAPERS)


def test_every_picture_is_shown_somewhere() -> None:
    texts = "".join(path.read_text() for path in FILES)
    pictures = [path.name for path in lessons_dir().iterdir() if path.suffix in (".svg", ".png")]
    assert [name for name in pictures if f"({name})" not in texts] == []
