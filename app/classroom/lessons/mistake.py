"""What is wrong in a lesson file, and where."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from pathlib import Path

from app.errors import UserMistake


class LessonMistake(UserMistake):
    """One mistake in one line of a lesson file."""

    def __init__(self, path: Path, line: int, reason: str) -> None:
        super().__init__(path, line, reason)
        self.path, self.line, self.reason = path, line, reason
        """The reason is one sentence."""

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.reason}"


class Complaints:
    """All mistakes of one file, as they are found."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._found: dict[tuple[int, str], LessonMistake] = {}
        self._notes: dict[tuple[int, str], LessonMistake] = {}

    def add(self, line: int, reason: str) -> None:
        self._found.setdefault((line, reason), LessonMistake(self.path, line, reason))

    def note(self, line: int, text: str) -> None:
        """Not wrong, but worth a look."""
        self._notes.setdefault((line, text), LessonMistake(self.path, line, text))

    def add_new(self, others: Complaints) -> None:
        """Take over what others found in lines without a complaint: one sentence a line is enough."""
        lines = {line for line, _ in self._found}
        for mistake in others.found:
            if mistake.line not in lines:
                self.add(mistake.line, mistake.reason)

    @property
    def found(self) -> list[LessonMistake]:
        """In the order of the lines."""
        return sorted(self._found.values(), key=lambda mistake: mistake.line)

    @property
    def notes(self) -> list[LessonMistake]:
        return sorted(self._notes.values(), key=lambda note: note.line)

    def raise_first(self) -> None:
        """Raise the first one, if there is any."""
        for mistake in self.found[:1]:
            raise mistake


def nearest(word: str, known: Iterable[str]) -> str:
    """The end of a sentence about an unknown word: what it may have been meant to be, or what there is."""
    names = sorted(known)
    if close := difflib.get_close_matches(word, names, n=1, cutoff=0.6):
        return f"did you mean {close[0]}?"
    if len(names) == 1:
        return f"there is {names[0]}."
    return f"there are {', '.join(names)}." if len(names) <= 12 else "see deltalab lessons facts."
