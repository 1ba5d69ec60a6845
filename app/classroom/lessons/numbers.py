"""A student's own numbers: drawn by the seed, and what follows from them for the robot."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from app.classroom.lessons.fill import MARK, UNKNOWN, Fill, Number, Numbers
from app.classroom.lessons.formulas import FORMULAS, FormulaMistake, formula_named
from app.classroom.lessons.lesson import Value
from app.classroom.lessons.mistake import Complaints, nearest
from app.classroom.lessons.table import Table

MOST = 10_000
"""Different values that one number may take."""


MOST_DIGITS = 12
"""Written after a point."""


@dataclass(frozen=True)
class Varied:
    """A number that is drawn."""

    name: str
    values: tuple[Value, ...]

    def draw(self, seed: int, key: str) -> Value:
        """The same for the same student and lesson on every computer, and evenly spread over students."""
        digest = hashlib.blake2b(f"{seed}/{key}/{self.name}".encode(), digest_size=8).digest()
        return self.values[int.from_bytes(digest, "big") % len(self.values)]


@dataclass(frozen=True)
class Derived:
    """A number that a formula computes."""

    name: str
    formula: str
    arguments: dict[str, Any]
    """As written, before numbers are put in."""
    pick: str
    unit: str
    digits: int | None
    line: int


@dataclass(frozen=True)
class Recipe:
    """How a lesson's numbers come about."""

    varied: tuple[Varied, ...] = ()
    derived: tuple[Derived, ...] = ()

    @property
    def names(self) -> set[str]:
        return {one.name for one in (*self.varied, *self.derived)}

    def drawn(self, seed: int, key: str) -> Numbers:
        """Only what is drawn; in place of what is derived stands something unknown."""
        return self._with_unknown({one.name: one.draw(seed, key) for one in self.varied})

    def extremes(self) -> list[Numbers]:
        """As `drawn`, for the students who get the first and the last value of everything."""
        return [self._with_unknown({one.name: one.values[end] for one in self.varied}) for end in (0, -1)]

    def _with_unknown(self, drawn: dict[str, Value]) -> Numbers:
        numbers = {name: written(value) for name, value in drawn.items()}
        return numbers | {one.name: Number(UNKNOWN, "…") for one in self.derived}

    def computed(self, drawn: Numbers, complaints: Complaints) -> Numbers:
        """All numbers of one student; complains about what cannot be computed."""
        numbers = dict(drawn)
        for one in self.derived:
            try:
                numbers[one.name] = _computed(one, numbers)
            except FormulaMistake as mistake:
                with_numbers = _named(one, numbers)
                complaints.add(one.line, f"{one.name} cannot be computed{with_numbers}: {mistake}")
        return numbers


def read_recipe(front: Table) -> Recipe:
    """From [vary.*] and [derive.*]."""
    vary, derive = front.table("vary"), front.table("derive")
    varied = tuple(Varied(name, _values(vary.table(name), name)) for name in vary.keys)
    known = {one.name for one in varied}
    derived = []
    for name in derive.keys:
        if name in known:
            derive.complain(f"There are two numbers {name}: give one of them another name.", name)
        derived.append(_derived(derive.table(name), name, known))
        known.add(name)
    for table in (vary, derive):
        for name in table.keys:
            if not MARK.fullmatch(f"<<{name}>>"):
                table.complain(f"{name} is no name for a number: use letters, digits and _.", name)
    return Recipe(varied, tuple(derived))


def _values(table: Table, name: str) -> tuple[Value, ...]:
    if "choose" in table:
        values = table.values("choose")
        if not values:
            table.complain(f"{name} has nothing to choose from: list at least one value.", "choose")
        table.close("from", "to", "step")
        return values or (UNKNOWN,)
    low, high, step = (table.number(key) for key in ("from", "to", "step"))
    table.close("choose")
    if any(math.isnan(number) for number in (low, high, step)):
        return (UNKNOWN,)
    if not (step > 0 and high >= low and (high - low) / step < MOST):
        table.complain(f"{name} needs from <= to and a step above 0, with at most {MOST} values.")
        return (UNKNOWN,)
    return tuple(_tidy(low + step * k, low, step) for k in range(int((high - low) / step + 1e-9) + 1))


def _tidy(value: float, *like: float) -> float:
    """Whole where all of `like` are, else without the dust of floating-point sums."""
    return int(value) if all(isinstance(one, int) for one in like) else round(value, 10)


def _derived(table: Table, name: str, known: set[str]) -> Derived:
    formula, unit = table.word("formula"), table.word("unit", "")
    pick = table.word("pick", "")
    digits, line = _digits(table), table.line()
    arguments = table.rest()
    for key, value in {**arguments, "pick": pick}.items():
        for unknown in sorted(set(_marks(value)) - known):
            table.complain(f"<<{unknown}>> is no number that stands above {name}: {nearest(unknown, known)}", key)
    if formula:
        _complain_formula(table, formula, arguments)
    return Derived(name, formula, arguments, pick, unit, digits, line)


def _digits(table: Table) -> int | None:
    if "digits" not in table:
        return None
    digits = table.number("digits")
    if digits not in range(MOST_DIGITS + 1):
        table.complain(f"digits must be a whole number from 0 to {MOST_DIGITS}.", "digits")
        return None
    return int(digits)


def _complain_formula(table: Table, name: str, arguments: dict[str, Any]) -> None:
    formula = formula_named(name)
    if formula is None:
        table.complain(f"There is no formula {name}: {nearest(name, FORMULAS)}", "formula")
        return
    for missing in sorted(formula.required - arguments.keys()):
        table.complain(f"The formula {name} needs {missing}: add {missing} = ...")
    for unknown in sorted(arguments.keys() - formula.arguments.keys()):
        table.complain(f"The formula {name} has no argument {unknown}: {nearest(unknown, formula.arguments)}", unknown)


def _computed(one: Derived, numbers: Numbers) -> Number:
    formula = formula_named(one.formula)
    if formula is None or not formula.takes(one.arguments):
        return numbers[one.name]  # complained about where it is written
    arguments = Fill(numbers).value(one.arguments)
    if any(value is UNKNOWN for value in _leaves(arguments)):
        return numbers[one.name]  # so is what it needs
    quantity = formula.quantity(arguments, Fill(numbers).text(one.pick))
    if quantity.unit is not None and quantity.unit != one.unit:
        is_, must = one.unit or "no unit", f"{quantity.unit!r}" if quantity.unit else "none: leave unit out"
        raise FormulaMistake(f"its unit is written as {is_}, but must be {must}.")
    return replace(written(quantity.value, one.digits), unit=one.unit)


def written(value: Value, digits: int | None = None) -> Number:
    """A number as texts show it: with these digits after the point, else as short as it is exact."""
    if isinstance(value, bool):
        return Number(value, "yes" if value else "no")
    if isinstance(value, str):
        return Number(value, value)
    text = f"{value:.10g}" if digits is None else f"{value:.{digits}f}"
    return Number(value, text.removeprefix("-") if float(text) == 0.0 else text)


def _marks(value: Any) -> Iterable[str]:
    return [mark[1] for one in _leaves(value) if isinstance(one, str) for mark in MARK.finditer(one)]


def _leaves(value: Any) -> Sequence[Any]:
    if isinstance(value, dict):
        return [leaf for one in value.values() for leaf in _leaves(one)]
    if isinstance(value, list):
        return [leaf for one in value for leaf in _leaves(one)]
    return [value]


def _named(one: Derived, numbers: Numbers) -> str:
    """For example " with x = 40, leg = 2"."""
    names = dict.fromkeys([*_marks(one.arguments), *_marks(one.pick)])
    told = ", ".join(f"{name} = {numbers[name].text}" for name in names if name in numbers)
    return f" with {told}" if told else ""
