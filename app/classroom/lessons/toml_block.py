"""A piece of TOML inside a lesson file, which knows in which line of the file a key stands."""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from app.classroom.lessons.mistake import Complaints

_ARRAY = re.compile(r"\s*\[\[(.+?)\]\]")
_TABLE = re.compile(r"\s*\[(.+?)\]\s*(?:#.*)?$")
_KEY = re.compile(r"""\s*((?:"[^"]*"|'[^']*'|[\w.-]|\s*\.\s*)+?)\s*=""")
_PART = re.compile(r"""\s*(?:"([^"]*)"|'([^']*)'|([^.\s]+))\s*(?:\.|$)""")
Where = tuple[str | int, ...]
"""Keys and indices that lead to a value, say ("check", 1, "within")."""


@dataclass(frozen=True)
class TomlBlock:
    """As it stands in the file."""

    source: str
    line: int
    """Of its first line."""
    label: str = ""
    """`setup` for what a step begins with."""

    def read(self, complaints: Complaints) -> dict[str, Any]:
        """Its values, not to be changed; empty after a complaint."""
        values, mistake = self._values
        if mistake:
            complaints.add(*mistake)
        return values

    def line_of(self, where: Where) -> int:
        """Line of the file in which a value, or else what it belongs to, is written."""
        path = tuple(part for one in where for part in (one.split(".") if isinstance(one, str) else [one]))
        while path and path not in self._lines:
            path = path[:-1]
        return self._lines.get(path, self.line)

    @cached_property
    def _values(self) -> tuple[dict[str, Any], tuple[int, str] | None]:
        """The values, or line and reason why there are none."""
        try:
            return tomllib.loads(self.source), None
        except tomllib.TOMLDecodeError as error:
            place = re.search(r"\s*\(at (?:line (\d+), column \d+|end of document)\)", str(error))
            reason = str(error)[: place.start()] if place else str(error)
            last = self.source.count("\n") or 1
            row = int(place[1]) if place and place[1] else last
            return {}, (self.line + min(row, last) - 1, f"This is no TOML: {reason[:1].lower()}{reason[1:]}.")
        except (ValueError, RecursionError):  # a date that does not exist, or brackets a thousand deep
            return {}, (self.line, "This is no TOML: a value cannot be read.")

    @cached_property
    def _lines(self) -> dict[Where, int]:
        lines: dict[Where, int] = {}
        counts: Counter[Where] = Counter()
        here: Where = ()
        for number, text in enumerate(self.source.split("\n"), self.line):
            if found := _ARRAY.match(text):
                here = _parts(found[1])
                counts[here] += 1
                lines.setdefault(here, number)
                here = (*here, counts[here] - 1)
                lines[here] = number
            elif found := _TABLE.match(text):
                here = _parts(found[1])
                lines.setdefault(here, number)
            elif found := _KEY.match(text):
                lines.setdefault((*here, *_parts(found[1])), number)
        return lines


def _parts(name: str) -> Where:
    """`a."b.c"` reads ("a", "b", "c"): lessons may write a name with points either way."""
    names = [double or single or bare for double, single, bare in _PART.findall(name)]
    return tuple(part for one in names for part in one.split("."))
