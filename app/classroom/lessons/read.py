"""Read lesson files: quickly for the course, thoroughly for their authors."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from app.classroom.lessons.build import build, read_front
from app.classroom.lessons.document import Document, split
from app.classroom.lessons.fill import Fill, Numbers
from app.classroom.lessons.inspect_steps import inspect_lesson, note_length
from app.classroom.lessons.inspect_text import inspect_marks, inspect_texts
from app.classroom.lessons.lesson import Lesson
from app.classroom.lessons.mistake import Complaints, LessonMistake
from app.classroom.lessons.numbers import Recipe

SEEDS = range(4)
"""Students for whom a lesson is tried."""

LARGEST = 300_000
"""Bytes of a lesson file."""


@dataclass(frozen=True)
class LessonFile:
    """A lesson before it has a student's numbers."""

    path: Path
    document: Document
    recipe: Recipe
    outline: Lesson
    """Everything that does not depend on the student; derived numbers in it are NaN."""

    @property
    def key(self) -> str:
        return self.outline.key

    @property
    def title(self) -> str:
        return self.outline.title

    def personal(self, seed: int) -> Lesson:
        """The lesson with one student's numbers; some lessons take seconds to compute them.

        Raises:
            LessonMistake: where a number cannot be computed.
        """
        if not self.recipe.names:
            return self.outline
        complaints = Complaints(self.path)
        numbers = self.recipe.computed(self.recipe.drawn(seed, self.key), complaints)
        lesson = build(self.path, self.document, numbers, complaints)
        complaints.raise_first()
        return lesson


def read_lesson(path: Path) -> LessonFile:
    """A lesson, its structure checked; no number is computed and no equation looked at.

    Raises:
        LessonMistake: the first mistake.
    """
    complaints = Complaints(path)
    lesson = _read(path, complaints)
    complaints.raise_first()
    assert lesson is not None, "without a complaint there is a lesson"
    return lesson


def mistakes_in(path: Path) -> list[LessonMistake]:
    """Every mistake of a lesson file, for several students, in the order of the lines."""
    return inspected(path).found


def inspected(path: Path) -> Complaints:
    """Every mistake, and what is worth a look."""
    complaints = Complaints(path)
    file = _read(path, complaints)
    if file is None:
        return complaints
    note_length(file.outline, complaints)
    for number, drawn in enumerate(_students(file)):
        mine = Complaints(path)
        numbers = file.recipe.computed(drawn, mine)
        inspect_lesson(build(file.path, file.document, numbers, mine), mine)
        if number == 0:
            inspect_texts(file.document, Fill(numbers), mine)
        complaints.add_new(mine)
    return complaints


def _students(file: LessonFile) -> list[Numbers]:
    """Drawn numbers of several students, of which each may show another mistake."""
    if not file.recipe.names:
        return [{}]
    return [*(file.recipe.drawn(seed, file.key) for seed in SEEDS), *file.recipe.extremes()]


def _read(path: Path, complaints: Complaints) -> LessonFile | None:
    source = _source(path, complaints)
    if source is None:
        return None
    document = split(source, complaints)
    recipe = read_front(document, complaints)
    inspect_marks(document, recipe.names, complaints)
    outline = build(path, document, recipe.drawn(SEEDS[0], path.stem), complaints)
    inspect_lesson(outline, complaints)
    return LessonFile(path, document, recipe, outline)


def _source(path: Path, complaints: Complaints) -> str | None:
    """Text of a file; None after a complaint."""
    try:
        content = path.read_bytes()
    except OSError as error:
        complaints.add(1, f"This file cannot be read: {(error.strerror or 'unknown reason').lower()}.")
        return None
    if len(content) > LARGEST:
        complaints.add(1, f"This file is larger than {LARGEST // 1000} kB, which no lesson is.")
        return None
    try:
        return content.decode().removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        complaints.add(line, "This file is not written in UTF-8: save it so.")
        return None
