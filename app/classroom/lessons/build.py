"""From a document and a student's numbers to a lesson."""

from __future__ import annotations

import re
from pathlib import Path

from app.classroom.lessons.build_check import act_of
from app.classroom.lessons.build_play import play_of
from app.classroom.lessons.build_question import question_of
from app.classroom.lessons.build_step import setup_of
from app.classroom.lessons.document import Document, Part, Section
from app.classroom.lessons.fill import Fill, Numbers
from app.classroom.lessons.lesson import Lesson, Question, Step
from app.classroom.lessons.lists import numbered
from app.classroom.lessons.mistake import Complaints, nearest
from app.classroom.lessons.numbers import Recipe, read_recipe
from app.classroom.lessons.table import Table
from app.robots import ROBOTS

SECTIONS = (
    "Predict",
    "Act",
    "Explain",
    "One more",
    "Hints",
    "Common errors",
    "Safety",
    "Instructor",
    "Solution",
    "Wrong solution",
)
PAPERS = ("par4", "delta3", "linear", "fivebar")
HINTS = 3
FILE_NAME = re.compile(r"(\d\d)-[a-z0-9]+(-[a-z0-9]+)*")


def read_front(document: Document, complaints: Complaints) -> Recipe:
    """How the lesson's numbers come about."""
    return read_recipe(Table.of(document.front, Fill({}), complaints))


def build(path: Path, document: Document, numbers: Numbers, complaints: Complaints) -> Lesson:
    """The lesson; after complaints, as much of it as can be understood."""
    fill = Fill(numbers)
    front = Table.of(document.front, fill, Complaints(path))  # broken TOML was complained about with the recipe
    front.table("vary")
    front.table("derive")
    head = Table(front.rest(), document.front, fill, complaints)
    robot = head.word("robot")
    if robot and robot not in ROBOTS:
        head.complain(f"There is no robot {robot}: {nearest(robot, ROBOTS)}", "robot")
    papers = head.words("papers", ())
    for paper in papers:
        if paper not in PAPERS:
            head.complain(f"There is no paper {paper}: {nearest(paper, PAPERS)}", "papers")
    numbered_name = FILE_NAME.fullmatch(path.stem)
    if numbered_name is None:
        complaints.add(1, f"A lesson's file is named like 02-inverse.md, not {path.name}.")
    if not document.parts:
        complaints.add(1, "This lesson has no steps: each begins with ## and its title.")
    lesson = Lesson(
        key=path.stem,
        number=int(numbered_name[1]) if numbered_name else 0,
        title=head.word("title"),
        minutes=head.number("minutes"),
        robot=robot,
        goals=head.words("goals"),
        needs=head.words("needs", ()),
        papers=papers,
        hardware=head.flag("hardware", False),
        intro=fill.text(document.intro.passage.text),
        steps=tuple(_step(number, part, fill, complaints) for number, part in enumerate(document.parts, 1)),
        path=path,
    )
    head.close("vary", "derive")
    for block in document.intro.blocks:
        complaints.add(block.line - 1, "TOML belongs into a step: the introduction is text only.")
    return lesson


def _step(number: int, part: Part, fill: Fill, complaints: Complaints) -> Step:
    sections = _by_title(part, complaints)
    setup = setup_of(part.top, fill, complaints)
    act = sections.get("Act")
    return Step(
        number=number,
        title=fill.text(part.top.title),
        minutes=setup.minutes,
        text=fill.text(part.top.passage.text),
        tab=setup.tab,
        settings=setup.settings,
        may_change=setup.may_change,
        predict=_question(sections.get("Predict"), fill, complaints),
        act=act_of(act, fill, complaints) if act else None,
        explain=_question(sections.get("Explain"), fill, complaints),
        more=_question(sections.get("One more"), fill, complaints),
        hints=_hints(sections.get("Hints"), fill, complaints),
        errors=_text(sections.get("Common errors"), fill, complaints),
        safety=_text(sections.get("Safety"), fill, complaints),
        notes=_text(sections.get("Instructor"), fill, complaints),
        solution=play_of(sections["Solution"], fill, complaints) if "Solution" in sections else None,
        wrong=play_of(sections["Wrong solution"], fill, complaints) if "Wrong solution" in sections else None,
        line=part.top.line,
    )


def _by_title(part: Part, complaints: Complaints) -> dict[str, Section]:
    sections: dict[str, Section] = {}
    for section in part.sections:
        if section.title not in SECTIONS:
            complaints.add(section.line, f"There is no section {section.title}: {nearest(section.title, SECTIONS)}")
        elif section.title in sections:
            complaints.add(section.line, f"This step has two sections {section.title}: leave one of them out.")
        else:
            sections[section.title] = section
    return sections


def _question(section: Section | None, fill: Fill, complaints: Complaints) -> Question | None:
    return question_of(section, fill, complaints) if section else None


def _text(section: Section | None, fill: Fill, complaints: Complaints) -> str:
    if section is None:
        return ""
    for block in section.blocks:
        complaints.add(block.line - 1, f"{section.title} is text only: leave this block out.")
    text = fill.text(section.passage.text)
    if not text.strip():
        complaints.add(section.line, f"{section.title} is empty: write something or leave it out.")
    return text


def _hints(section: Section | None, fill: Fill, complaints: Complaints) -> tuple[str, ...]:
    if section is None:
        return ()
    _text(section, Fill({}), complaints)
    hints = numbered(section.passage)
    if len(hints) != HINTS:
        reason = f"Hints are a numbered list of three, a question, a hint and the worked step, not {len(hints)}."
        complaints.add(section.line, reason)
    return tuple(fill.text(hint) for hint in hints)
