"""What a test plays: the worked solution, and the wrong one."""

from __future__ import annotations

from app.classroom.lessons.build_step import complain_value
from app.classroom.lessons.catalogue import PRESSES
from app.classroom.lessons.document import Section
from app.classroom.lessons.fill import Fill
from app.classroom.lessons.lesson import Deed, Play, Press, Set
from app.classroom.lessons.mistake import Complaints, nearest
from app.classroom.lessons.table import Table


def play_of(section: Section, fill: Fill, complaints: Complaints) -> Play:
    """From a section Solution or Wrong solution; its text is for the author alone."""
    if len(section.blocks) != 1:
        complaints.add(section.line, f"{section.title} needs one toml block, not {len(section.blocks)}.")
        return Play(line=section.line)
    table = Table.of(section.blocks[0], fill, complaints)
    answers = {key: table.number(key) for key in ("predict", "explain", "more") if key in table}
    deeds = tuple(_deed(one) for one in table.tables("do"))
    table.close("predict", "explain", "more")
    return Play(deeds, **answers, line=section.line)


def _deed(table: Table) -> Deed:
    if "press" in table:
        name = table.word("press")
        if name and name not in PRESSES:
            table.complain(f"There is no action {name}: {nearest(name, PRESSES)}", "press")
        table.close("set", "to")
        return Press(name)
    fact, value = table.word("set"), table.value("to")
    complain_value(table, fact, value, "set" if "to" not in table else "to", writable=True)
    table.close("press")
    return Set(fact, value)
