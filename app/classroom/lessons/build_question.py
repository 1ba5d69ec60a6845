"""Questions: options with feedback, or a number."""

from __future__ import annotations

from app.classroom.lessons.document import Section
from app.classroom.lessons.fill import Fill
from app.classroom.lessons.lesson import Choice, Near, NumberAnswer, Question
from app.classroom.lessons.lists import Option, options
from app.classroom.lessons.mistake import Complaints, nearest
from app.classroom.lessons.table import Table
from app.classroom.lessons.units import UNITS


def question_of(section: Section, fill: Fill, complaints: Complaints) -> Question:
    """From a section Predict, Explain or One more."""
    text, found = options(section.passage)
    if bool(found) == bool(section.blocks) or len(section.blocks) > 1:
        complaints.add(
            section.line,
            f"{section.title} needs either options, a list with - [ ] and - [x], or one toml block with answer = ...",
        )
    if not text.strip():
        complaints.add(section.line, f"{section.title} asks nothing: write its question.")
    if found:
        _complain_options(found, section, complaints)
    choices = tuple(Choice(fill.text(one.text), one.right, fill.text(one.feedback)) for one in found)
    number = _number(Table.of(section.blocks[0], fill, complaints)) if section.blocks else None
    return Question(fill.text(text), choices, number)


def _complain_options(found: tuple[Option, ...], section: Section, complaints: Complaints) -> None:
    right = sum(option.right for option in found)
    if right == 0:
        complaints.add(section.line, f"{section.title} has no right option: mark one with - [x].")
    elif right == len(found):
        complaints.add(section.line, f"{section.title} has no wrong option: mark at least one with - [ ].")
    for option in found:
        if not option.boxed:
            complaints.add(option.line, "Each option begins with - [ ] or - [x].")
        elif not option.text:
            complaints.add(option.line, "This option is empty: write it behind its box.")
        elif not option.feedback:
            complaints.add(option.line, "This option has no feedback: say why under it, in a line that begins with >.")


def _number(table: Table) -> NumberAnswer:
    answer, unit, within = table.number("answer"), table.word("unit", ""), table.number("within")
    if unit and unit not in UNITS:
        table.complain(f"There is no unit {unit}: {nearest(unit, UNITS)}", "unit")
    if within < 0.0:
        table.complain("within must not be negative.", "within")
    source = table.source("answer")
    if source is not None and source.unit not in (None, unit):
        table.complain(f"The answer is in {source.unit or 'no unit'}, not in {unit or 'no unit'}.", "unit")
    elif source is None and table.fill.numbers:
        table.complaints.note(table.line("answer"), "This answer is a constant: could the robot compute it?")
    right, wrong = table.word("right"), table.word("wrong")
    near = tuple(_near(one, within) for one in table.tables("near"))
    table.close()
    for index, one in enumerate(near):
        if abs(one.value - answer) <= within:
            table.tables("near")[index].complain("This known error is so near to the answer that it counts as right.")
    return NumberAnswer(answer, unit, within, right, wrong, near)


def _near(table: Table, within: float) -> Near:
    near = Near(table.number("value"), table.number("within", within), table.word("says"))
    table.close()
    return near
