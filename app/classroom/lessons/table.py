"""Take values out of a table of TOML, one by one, and complain about what is wrong with them."""

from __future__ import annotations

from typing import Any

from app.classroom.lessons.fill import MARK, UNKNOWN, Fill, Number, Unknown
from app.classroom.lessons.lesson import Value
from app.classroom.lessons.mistake import Complaints, nearest
from app.classroom.lessons.toml_block import TomlBlock, Where

_KINDS = {str: "a text in quotes", float: "a number", bool: "true or false", list: "a list in [ ]", dict: "a table"}


class Table:
    """After a complaint, a harmless value is returned, so that all mistakes are found at once."""

    def __init__(
        self, data: dict[str, Any], block: TomlBlock, fill: Fill, complaints: Complaints, where: Where = ()
    ) -> None:
        self._data, self._block, self._where = data, block, where
        self._taken: set[str] = set()
        self.fill, self.complaints = fill, complaints

    @classmethod
    def of(cls, block: TomlBlock, fill: Fill, complaints: Complaints) -> Table:
        """A whole block."""
        return cls(block.read(complaints), block, fill, complaints)

    def __contains__(self, key: str) -> bool:
        return key in self._data

    @property
    def keys(self) -> list[str]:
        return list(self._data)

    def line(self, key: str | None = None) -> int:
        return self._block.line_of(self._where if key is None else (*self._where, key))

    def complain(self, reason: str, key: str | None = None) -> None:
        self.complaints.add(self.line(key), reason)

    def word(self, key: str, default: str | None = None) -> str:
        return self._take(key, str, default, "")

    def number(self, key: str, default: float | None = None) -> float:
        """NaN only where a number has not been computed."""
        return self._take(key, float, default, UNKNOWN)

    def flag(self, key: str, default: bool | None = None) -> bool:
        return self._take(key, bool, default, False)

    def value(self, key: str) -> Value:
        """A number, a word or a flag."""
        value = self.fill.value(self._raw(key))
        if isinstance(value, (str, bool, int, float)):
            return value
        if key in self._data:
            self.complain(f"{key} must be a number, a word in quotes, true or false.", key)
        return UNKNOWN

    def values(self, key: str) -> tuple[Value, ...]:
        """A list of numbers or words."""
        found = self._take(key, list, None, [])
        if any(not isinstance(one, (str, bool, int, float)) for one in found):
            self.complain(f"{key} must be a list of numbers or words.", key)
            return ()
        return tuple(found)

    def words(self, key: str, default: tuple[str, ...] | None = None) -> tuple[str, ...]:
        found = self._take(key, list, None if default is None else list(default), [])
        if any(not isinstance(one, str) for one in found):
            self.complain(f"{key} must be a list of texts in quotes.", key)
            return ()
        return tuple(found)

    def source(self, key: str) -> Number | None:
        """The student's number that a value is, if it is nothing else."""
        mark = MARK.fullmatch(str(self._data.get(key, "")).strip())
        return self.fill.numbers.get(mark[1]) if mark else None

    def is_table(self, key: str) -> bool:
        return isinstance(self._data.get(key), dict)

    def table(self, key: str) -> Table:
        """What is written as [key]; empty if it is missing."""
        return self._below(self._raw_of(key, dict, {}), key)

    def tables(self, key: str) -> list[Table]:
        """What is written as [[key]], several times or not at all."""
        found = self._raw_of(key, list, [])
        if any(not isinstance(one, dict) for one in found):
            self.complain(f"Write each {key} as a table of its own, under [[{key}]].", key)
            return []
        return [self._below(data, key, index) for index, data in enumerate(found)]

    def flat(self) -> list[tuple[str, Any]]:
        """All of it as (key, value), with a.b = 1 written like "a.b" = 1."""
        self._taken |= self._data.keys()
        return [(self.fill.text(name), self.fill.value(value)) for name, value in _flat("", self._data)]

    def rest(self) -> dict[str, Any]:
        """What nobody has taken, as written: without the student's numbers."""
        rest = {key: value for key, value in self._data.items() if key not in self._taken}
        self._taken |= rest.keys()
        return rest

    def close(self, *others: str) -> None:
        """Complain about keys that nobody has taken. `others`: those that might have been."""
        for key in self._data:
            if key not in self._taken:
                known = {*self._taken, *others}
                hint = nearest(key, known) if known else "leave it out."
                self.complain(f"The key {key} is unknown here: {hint}", key)

    def _below(self, data: dict[str, Any], *path: str | int) -> Table:
        return Table(data, self._block, self.fill, self.complaints, (*self._where, *path))

    def _raw(self, key: str) -> Any:
        self._taken.add(key)
        if key not in self._data:
            self.complain(f"{key} is missing here: add {key} = ...")
        return self._data.get(key)

    def _raw_of(self, key: str, kind: type, otherwise: Any) -> Any:
        """A value that may be missing, before numbers are put in."""
        self._taken.add(key)
        value = self._data.get(key, otherwise)
        if isinstance(value, kind):
            return value
        self.complain(f"{key} must be {_KINDS[kind]}.", key)
        return otherwise

    def _take(self, key: str, kind: type, default: Any, otherwise: Any) -> Any:
        if default is not None and key not in self._data:
            self._taken.add(key)
            return default
        value = self.fill.value(self._raw(key))
        if isinstance(value, Unknown):
            return UNKNOWN if kind is float else otherwise
        number = kind is float and isinstance(value, (int, float)) and not isinstance(value, bool)
        if (number and _is_usual(value)) or (kind is not float and isinstance(value, kind)):
            return value
        if key in self._data:
            self.complain(f"{key} must be {_KINDS[kind]}, not {_short(value)}.", key)
        return otherwise


def _is_usual(value: float) -> bool:
    """Neither infinite nor NaN, nor so large that it is no float."""
    return abs(value) < 1e300


def _short(value: Any) -> str:
    text = repr(value) if not isinstance(value, bool) else str(value).lower()
    return text if len(text) <= 40 else text[:37] + "..."


def _flat(prefix: str, data: dict[str, Any]) -> list[tuple[str, Any]]:
    pairs = []
    for key, value in data.items():
        pairs += _flat(f"{prefix}{key}.", value) if isinstance(value, dict) else [(prefix + key, value)]
    return pairs
