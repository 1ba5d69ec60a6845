"""All lessons of the server, read when the first page asks for them, and again when their files change.

Numbers of a student are computed in a worker: for some lessons that takes a second.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from typing import TYPE_CHECKING

from app.recent import Recent
from app.signal import Signal

if TYPE_CHECKING:
    from app.classroom.lessons.course import Course
    from app.classroom.lessons.lesson import Lesson
    from app.classroom.lessons.mistake import LessonMistake
    from app.classroom.lessons.read import LessonFile
    from app.classroom.outline import Outline

LOOK_EVERY_S = 1.0
REMEMBERED = 1000
"""Lessons with a student's numbers."""


class Library:
    """One a server, on its event loop."""

    def __init__(self, read: Callable[[], Course], pool: Executor) -> None:
        """`read` reads all lessons, on another thread; `pool` computes."""
        self.changed: Signal[None] = Signal()
        """Files have changed."""
        self.course: Course | None = None
        """None until it has been read."""
        self._read_course = read
        self._pool = pool
        self._opening: asyncio.Task[None] | None = None
        self._watching: asyncio.Task[None] | None = None
        self._personal: Recent[tuple[str, int], tuple[LessonFile, Lesson]] = Recent(REMEMBERED)
        self._outline: Outline = {}

    @property
    def files(self) -> Mapping[str, LessonFile]:
        return {} if self.course is None else self.course.files

    @property
    def broken(self) -> Mapping[str, LessonMistake]:
        return {} if self.course is None else self.course.broken

    def outline(self) -> Outline:
        """The course in numbers, for the classroom."""
        return self._outline

    async def opened(self) -> None:
        """Wait until all lessons have been read."""
        if self._opening is None:
            self._opening = asyncio.create_task(self._read())
        await asyncio.shield(self._opening)

    def close(self) -> None:
        for task in (self._opening, self._watching):
            if task is not None:
                task.cancel()

    def known(self, key: str, seed: int) -> Lesson | None:
        """A lesson with a student's numbers, if it need not be computed."""
        file = self.files.get(key)
        if file is None:
            return None
        if not file.recipe.names:
            return file.outline
        kept = self._personal.get((key, seed))
        return kept[1] if kept is not None and kept[0] is file else None

    async def fetch(self, key: str, seed: int) -> Lesson:
        """The same, computed if need be.

        Raises:
            UserMistake: there is no such lesson, or a number of it cannot be computed.
        """
        from app.errors import UserMistake
        from app.ui.lessons.jobs import personal_lesson

        if (known := self.known(key, seed)) is not None:
            return known
        file = self.files.get(key)
        if file is None:
            raise UserMistake("There is no such lesson, or it cannot be read.")
        lesson = await asyncio.get_running_loop().run_in_executor(self._pool, personal_lesson, file.path, seed)
        if isinstance(lesson, str):
            raise UserMistake(lesson)
        self._personal.put((key, seed), (file, lesson))
        return lesson

    def look(self) -> None:
        """Read again what has changed on disk."""
        if self.course is not None and self.course.refresh():
            self._note_outline()
            self.changed.emit(None)

    async def _read(self) -> None:
        self.course = await asyncio.to_thread(self._read_course)
        self._note_outline()
        self._watching = asyncio.create_task(self._watch())

    async def _watch(self) -> None:
        while True:
            await asyncio.sleep(LOOK_EVERY_S)
            self.look()

    def _note_outline(self) -> None:
        from app.classroom.outline import outline_of

        assert self.course is not None
        self._outline = outline_of(self.course)
