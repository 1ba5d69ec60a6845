"""Every lesson of the course played: each solution passes, and no wrong one does."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.classroom.lessons.read import read_lesson
from app.resources import lessons_dir
from app.ui.lessons.play import play

FILES = sorted(lessons_dir().glob("[0-9][0-9]-*.md"))
SEED = 3


def test_there_is_a_course():
    assert len(FILES) >= 16


@pytest.mark.long
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_lesson_can_be_passed_and_failed(path: Path):
    assert play(read_lesson(path).personal(SEED)) == []
