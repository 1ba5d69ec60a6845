"""All lessons of a folder, as they are on disk now. A broken one is listed with its reason and harms nothing else."""

from __future__ import annotations

from pathlib import Path

from app.classroom.lessons.lesson import Lesson
from app.classroom.lessons.markdown import PICTURES
from app.classroom.lessons.mistake import LessonMistake
from app.classroom.lessons.read import LessonFile, read_lesson
from app.classroom.lessons.render import forget_rendered

Stamp = tuple[int, int]
"""When a file was changed (ns), and its size in bytes."""

REMEMBERED = 2000
"""Personal lessons that are kept."""


class Course:
    """Lessons by key, in teaching order. Used by one thread."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.files: dict[str, LessonFile] = {}
        self.broken: dict[str, LessonMistake] = {}
        """Key -> its first mistake."""
        self._stamps: dict[Path, Stamp] = {}
        self._personal: dict[tuple[str, int], Lesson] = {}
        self.refresh()

    def refresh(self) -> bool:
        """Read again what has changed on disk; whether anything has."""
        stamps = self._look()
        changed = {path for path in stamps.keys() | self._stamps.keys() if stamps.get(path) != self._stamps.get(path)}
        self._stamps = stamps
        if any(path.suffix in PICTURES for path in changed):
            forget_rendered()
        names_changed = {path for path in changed if path.suffix == ".md"}
        for path in names_changed:
            self._read(path, gone=path not in stamps)
        self.files = dict(sorted(self.files.items()))
        self.broken = dict(sorted(self.broken.items()))
        return bool(changed)

    def lesson(self, key: str, seed: int) -> Lesson:
        """A lesson with one student's numbers, which may have to be computed first.

        Raises:
            LessonMistake: where that fails, for this student at least.
            KeyError: where there is no such lesson that is whole.
        """
        lesson = self._personal.get((key, seed))
        if lesson is None:
            lesson = self.files[key].personal(seed)
            self._keep(key, seed, lesson)
        return lesson

    def _keep(self, key: str, seed: int, lesson: Lesson) -> None:
        while len(self._personal) >= REMEMBERED:
            del self._personal[next(iter(self._personal))]
        self._personal[key, seed] = lesson

    def _read(self, path: Path, gone: bool) -> None:
        key = path.stem
        self.files.pop(key, None)
        self.broken.pop(key, None)
        self._personal = {mine: lesson for mine, lesson in self._personal.items() if mine[0] != key}
        if gone:
            return
        try:
            self.files[key] = read_lesson(path)
        except LessonMistake as mistake:
            self.broken[key] = mistake

    def _look(self) -> dict[Path, Stamp]:
        stamps = {}
        for path in self.folder.glob("[0-9][0-9]-*"):
            if path.suffix == ".md" or path.suffix in PICTURES:
                try:
                    found = path.stat()
                except OSError:  # it has gone meanwhile
                    continue
                stamps[path] = (found.st_mtime_ns, found.st_size)
        return stamps
