"""`deltalab lessons`: check lesson files, begin a new one, list what lessons may read, set, press and compute."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from app.errors import UserMistake
from app.resources import lessons_dir


@dataclass(frozen=True)
class Check:
    """Look for mistakes in lesson files, and play their solutions."""

    files: Annotated[tuple[Path, ...], tyro.conf.Positional, tyro.conf.arg(metavar="FILE")] = field(
        default_factory=tuple
    )
    """Lesson files; without any, those that came with Delta Lab."""
    structure_only: Annotated[bool, tyro.conf.FlagCreatePairsOff] = False
    """Play no solutions."""


@dataclass(frozen=True)
class New:
    """Write a template for a new lesson, a lesson that already works."""

    title: Annotated[tyro.conf.Positional[str], tyro.conf.arg(metavar="TITLE")]
    """Its title, from which the file gets its name."""
    folder: Path = Path("lessons")
    """Folder to write to."""


@dataclass(frozen=True)
class Facts:
    """List the facts, actions and formulas that lessons can use."""

    about: Annotated[str, tyro.conf.Positional, tyro.conf.arg(metavar="WORD")] = ""
    """Only lines with this word."""


def check(command: Check) -> None:
    """A line for each lesson that is fine; a line for each mistake of one that is not."""
    from app.classroom.lessons.read import inspected

    broken = 0
    files = command.files or tuple(_near(path) for path in sorted(lessons_dir().glob("[0-9][0-9]-*.md")))
    if not files:
        raise UserMistake("There are no lessons to check: name a file, or write one with deltalab lessons new.")
    for path in files:
        found = inspected(path)
        complaints = [str(mistake) for mistake in found.found]
        if not complaints and not command.structure_only:
            complaints = _played(path)
        broken += bool(complaints)
        lines = complaints or [f"{path}: fine, {_summary(path)}."]
        print(*lines, *(f"{note} (A note only.)" for note in found.notes), sep="\n", flush=True)
    if broken:
        several = "lesson needs" if broken == 1 else "lessons need"
        raise UserMistake(f"{broken} {several} mending: each line above says where and what is wrong.")


def _near(path: Path) -> Path:
    """As one would type it here."""
    return path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path


def _played(path: Path) -> list[str]:
    """What is wrong with the solutions, played for one student."""
    from app.classroom.lessons.read import read_lesson
    from app.ui.lessons.play import play

    lesson = read_lesson(path).personal(seed=0)
    return [complaint if complaint.startswith(str(path)) else f"{path}: {complaint}" for complaint in play(lesson)]


def _summary(path: Path) -> str:
    from app.classroom.lessons.read import read_lesson

    lesson = read_lesson(path).outline
    checks = sum(len(step.act.checks) for step in lesson.steps if step.act)
    return f"{len(lesson.steps)} steps, {checks} checks, {lesson.minutes:g} minutes"


def new(command: New) -> None:
    """Write the template beside the other lessons."""
    from app.classroom.lessons.template import write_template

    path = write_template(command.title, command.folder)
    print(f"{path}: a lesson that works; change it step by step, with deltalab lessons check {path}.")


def facts(command: Facts) -> None:
    """The catalogue, as tables of plain text."""
    from app.classroom.lessons.listing import listing

    lines = [line for line in listing() if command.about.lower() in line.lower()]
    if not lines:
        raise UserMistake(f"Nothing is said about {command.about!r}: try a shorter word.")
    print("\n".join(lines))
