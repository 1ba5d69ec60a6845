"""What takes too long for the event loop: a student's numbers."""

from __future__ import annotations

from pathlib import Path

from app.classroom.lessons.lesson import Lesson
from app.classroom.lessons.mistake import LessonMistake
from app.classroom.lessons.read import read_lesson


def personal_lesson(path: Path, seed: int) -> Lesson | str:
    """A lesson with one student's numbers, or why there is none."""
    try:
        return read_lesson(path).personal(seed)
    except LessonMistake as mistake:
        return f"This lesson is broken in line {mistake.line}: {mistake.reason}"
