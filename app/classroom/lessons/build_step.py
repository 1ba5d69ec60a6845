"""What a step sets up."""

from __future__ import annotations

from typing import NamedTuple

from app.classroom.lessons.catalogue import FACTS, FactKind, fact_kind, namespace
from app.classroom.lessons.document import Section
from app.classroom.lessons.fill import Fill, Unknown
from app.classroom.lessons.lesson import Setting, Value
from app.classroom.lessons.mistake import Complaints, nearest
from app.classroom.lessons.table import Table
from app.classroom.lessons.toml_block import TomlBlock

NAMESPACES = frozenset(map(namespace, FACTS))
SORTS = {"number": "a number", "word": "a word in quotes", "flag": "true or false"}


class Setup(NamedTuple):
    """What stands in the block `toml setup`."""

    minutes: float
    tab: str = ""
    may_change: frozenset[str] | None = None
    settings: tuple[Setting, ...] = ()


def setup_of(section: Section, fill: Fill, complaints: Complaints) -> Setup:
    """From the block under a step's own heading."""
    for block in section.blocks:
        if block.label != "setup":
            complaints.add(block.line - 1, "Above a step's sections stands ```toml setup, and nothing else in TOML.")
    blocks = [block for block in section.blocks if block.label == "setup"]
    if len(blocks) != 1:
        complaints.add(section.line, f"This step needs one block ```toml setup with its minutes, not {len(blocks)}.")
        return Setup(0.0)
    return _setup(Table.of(blocks[0], fill, complaints), blocks[0])


def _setup(table: Table, block: TomlBlock) -> Setup:
    minutes, tab = table.number("minutes"), table.word("tab", "")
    if minutes <= 0.0:
        table.complain("minutes must be above 0.", "minutes")
    tabs = FACTS["tab"].options
    if tab and tab not in tabs:
        table.complain(f"There is no tab {tab}: {nearest(tab, tabs)}", "tab")
    may_change = frozenset(table.words("may_change")) if "may_change" in table else None
    for name in sorted(may_change or ()):
        if name not in NAMESPACES:
            table.complain(f"may_change lists namespaces, and there is none {name}: {_near(name)}", "may_change")
    below = table.table("set")
    settings = tuple(Setting(name, value) for name, value in below.flat())
    for setting in settings:
        complain_value(below, setting.fact, setting.value, setting.fact, writable=True)
    table.close()
    return Setup(minutes, tab, may_change, settings)


def _near(name: str) -> str:
    return nearest(namespace(name), NAMESPACES)


def complain_value(table: Table, fact: str, value: Value, key: str, writable: bool = False) -> None:
    """Complain if a fact is unknown, cannot be set, or cannot have this value."""
    kind = known(table, fact, key)
    if kind is None or isinstance(value, Unknown):
        return
    if writable and not kind.writable:
        table.complain(f"{fact} can only be read: set what it follows from.", key)
    elif not _fits(kind, value):
        table.complain(f"{fact} must be {SORTS[kind.kind]}, not {value!r}.", key)
    elif isinstance(value, str) and kind.options and value not in kind.options:
        table.complain(f"{fact} cannot be {value!r}: {nearest(value, kind.options)}", key)


def known(table: Table, fact: str, key: str) -> FactKind | None:
    """What is known about a fact, or a complaint."""
    kind = fact_kind(fact)
    if kind is None and fact:
        table.complain(f"There is no fact {fact}: {nearest(fact, FACTS)}", key)
    return kind


def _fits(kind: FactKind, value: Value) -> bool:
    if isinstance(value, bool):
        return kind.kind == "flag"
    return kind.kind == ("word" if isinstance(value, str) else "number")
