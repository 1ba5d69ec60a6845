"""A student's page as lessons see it: facts to read and set, actions, and what was measured."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TYPE_CHECKING

from app.classroom.events import Plot
from app.classroom.lessons.catalogue import FACTS, PRESSES, fact_kind
from app.classroom.lessons.lesson import Step, Value
from app.errors import UserMistake
from app.robots import GeometryError
from app.signal import Signal
from app.ui.desks import Desks
from app.ui.lessons.facts.field import Field
from app.ui.lessons.facts.fields import Fields
from app.ui.session import Session

if TYPE_CHECKING:
    from app.ui.lessons.facts.link import LinkFacts
    from app.ui.lessons.presses import Press

TYPES: Mapping[str, tuple[type, ...]] = {"number": (int, float), "word": (str,), "flag": (bool,)}
WANTED = {"number": "a number", "word": "a word", "flag": "true or false"}


class Apparatus:
    """Of one session. Reading costs some microseconds; what is not there yet is None, or NaN."""

    def __init__(
        self,
        session: Session,
        desks: Desks,
        show_tab: Callable[[str], None] = lambda label: None,
        front: Callable[[], str] | None = None,
    ) -> None:
        """
        Args:
            show_tab: brings a tab to the front.
            front: label of the tab in front; None: the one that was shown last.
        """
        self.changed: Signal[None] = desks.changed
        """Something may have changed."""
        self.exported = False
        """Whether the student has saved the report."""
        self._desks = desks
        self._show_tab = show_tab
        self._shown = "Robot"
        self._front = front or (lambda: self._shown)
        self._fields = Fields(desks, {"tab": self._own, "report": self._own, "link": self._table, "twin": self._table})
        self._link_facts: LinkFacts | None = None
        self._presses: Mapping[str, Press] | None = None
        self._pending: list[Press] = []

    @property
    def busy(self) -> bool:
        """Something still computes."""
        return self._desks.staff.busy

    @property
    def waits(self) -> bool:
        """What was pressed has not ended yet."""
        self._pending = [press for press in self._pending if not press.done()]
        return bool(self._pending)

    def value(self, fact: str) -> Value | None:
        """What a fact is now; None also for a fact that does not exist."""
        field = self._fields.of(fact)
        read = field.read.get(fact)
        if read is not None:
            return read()
        prefix, point, rest = fact.rpartition(".")
        each = field.read_each.get(prefix + point)
        return None if each is None else each(rest)

    def knows(self, fact: str) -> bool:
        """Whether a fact can be read."""
        field = self._fields.of(fact)
        return fact in field.read or _stem(fact) in field.read_each

    def can_set(self, fact: str) -> bool:
        """Whether a fact can be set."""
        field = self._fields.of(fact)
        return fact in field.write or _stem(fact) in field.write_each

    @property
    def actions(self) -> Collection[str]:
        """What can be pressed."""
        return self._all_presses().keys()

    def set(self, fact: str, value: Value) -> None:
        """As a panel would.

        Raises:
            UserMistake: why it cannot be.
        """
        _check(fact, value)
        field = self._fields.of(fact)
        write, each = field.write.get(fact), None
        prefix, point, rest = fact.rpartition(".")
        if write is None:
            each = field.write_each.get(prefix + point)
        try:
            if write is not None:
                write(value)
            elif each is not None:
                each(rest, value)
            else:
                raise UserMistake(f"{fact} cannot be set: set something that it follows from.")
        except GeometryError as mistake:
            raise UserMistake(str(mistake)) from mistake

    def press(self, name: str) -> None:
        """Begin an action; `waits` tells when it has ended.

        Raises:
            UserMistake: why it cannot be.
        """
        if name not in PRESSES:
            raise UserMistake(f"There is no action {name!r}.{_advice(name, PRESSES)}")
        press = self._all_presses()[name]
        press.begin()
        self._pending.append(press)

    def press_again(self) -> None:
        """Begin anew what has not ended: it was interrupted."""
        for press in self._pending:
            press.begin()

    def give_up(self) -> None:
        """Wait for nothing any more."""
        self._pending.clear()

    def note_export(self) -> None:
        """The student has saved the report."""
        self.exported = True
        self.changed.emit(None)

    def evidence(self, step: Step) -> list[Plot]:
        """Small plots of what the step's checks are about, for the report."""
        from app.ui.lessons.evidence import plots_for

        return plots_for(self._desks, step)

    def _all_presses(self) -> Mapping[str, Press]:
        if self._presses is None:
            from app.ui.lessons.link_presses import LinkPresses
            from app.ui.lessons.presses import Press, desk_presses

            link = LinkPresses(self._desks, self._link)
            self._presses = {**desk_presses(self._desks), **link.table(), "export": Press(self.note_export)}
        return self._presses

    @property
    def _link(self) -> LinkFacts:
        if self._link_facts is None:
            from app.ui.lessons.facts.link import LinkFacts

            self._link_facts = LinkFacts(self._desks)
        return self._link_facts

    def _table(self) -> Field:
        return self._link.field()

    def _own(self) -> Field:
        return Field(
            {"tab": lambda: self._front(), "report.exported": lambda: self.exported},
            {"tab": self._bring, "report.exported": self._set_exported},
        )

    def _bring(self, label: str) -> None:
        self._shown = label
        self._show_tab(label)

    def _set_exported(self, exported: bool) -> None:
        self.exported = exported
        self.changed.emit(None)


def _stem(fact: str) -> str:
    """Up to the last point: what stands before the `*` of a pattern."""
    prefix, point, _ = fact.rpartition(".")
    return prefix + point


def _check(fact: str, value: Value) -> None:
    """Raises UserMistake for what no fact can be set to."""
    kind = fact_kind(fact)
    if kind is None:
        raise UserMistake(f"There is no fact {fact!r}.{_advice(fact, FACTS)}")
    if not kind.writable:
        raise UserMistake(f"{fact} cannot be set: set something that it follows from.")
    fits = isinstance(value, TYPES[kind.kind]) and isinstance(value, bool) == (kind.kind == "flag")
    if not fits or value != value:
        raise UserMistake(f"{fact} cannot be {value!r}: give {WANTED[kind.kind]}.")
    if kind.options and value not in kind.options:
        raise UserMistake(f"{fact} cannot be {value!r}: choose one of {', '.join(kind.options)}.")


def _advice(name: str, known: Iterable[str]) -> str:
    close = difflib.get_close_matches(name, list(known), n=1)
    return f" Did you mean {close[0]!r}?" if close else ""
