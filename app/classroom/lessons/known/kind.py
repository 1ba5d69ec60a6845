"""What is known about one fact before anybody asks for its value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

Sort: TypeAlias = Literal["number", "word", "flag"]


@dataclass(frozen=True)
class FactKind:
    """One fact, or all facts whose names fit a pattern such as `joint.*`."""

    text: str
    """For authors, a phrase."""
    kind: Sort
    unit: str = ""
    """In which a number is read; empty where it has none."""
    other_units: tuple[str, ...] = ()
    """In which it is read on other robots, say `mm` where the joints of most turn."""
    writable: bool = False
    """Whether a lesson may set it."""
    options: tuple[str, ...] = ()
    """The words it can be; empty where they are many."""

    @property
    def units(self) -> tuple[str, ...]:
        """Every unit that a check may name."""
        return (self.unit, *self.other_units)


Facts: TypeAlias = Mapping[str, FactKind]


def number(text: str, unit: str = "", *other_units: str) -> FactKind:
    """A number that can only be read."""
    return FactKind(text, "number", unit, other_units)


def setting(text: str, unit: str = "", *other_units: str) -> FactKind:
    """A number that a lesson may set."""
    return FactKind(text, "number", unit, other_units, writable=True)


def flag(text: str) -> FactKind:
    """True or false."""
    return FactKind(text, "flag")


def switch(text: str) -> FactKind:
    """True or false, as a lesson may set it."""
    return FactKind(text, "flag", writable=True)


def word(text: str, *options: str) -> FactKind:
    """A word that can only be read."""
    return FactKind(text, "word", options=options)


def choice(text: str, *options: str) -> FactKind:
    """A word that a lesson may set; without options any text."""
    return FactKind(text, "word", writable=True, options=options)
