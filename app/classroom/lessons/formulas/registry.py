"""Formulas by name: what a lesson may compute from the robot, with units.

A formula takes what is written in the lesson (mm, deg, words, lists) and returns a number, a word, or several of them
by name, of which the lesson picks one.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar, get_type_hints

from app.classroom.lessons.lesson import Value
from app.classroom.lessons.mistake import nearest
from app.errors import UserMistake

ANY_UNIT = None
"""Of a result whose unit depends on what goes in: the lesson's author says it."""


class FormulaMistake(Exception):
    """Why a formula gives no number: the end of a sentence."""


class Quantity(NamedTuple):
    """One result."""

    value: Value
    unit: str | None = ""
    """As people read it; `ANY_UNIT` where the author says it."""


Result = Value | Quantity | Mapping[str, "Value | Quantity"]
Function = Callable[..., Result]
F = TypeVar("F", bound=Function)


@dataclass(frozen=True)
class Formula:
    """One entry of the table."""

    name: str
    unit: str | None
    function: Function
    arguments: Mapping[str, inspect.Parameter]
    text: str
    """What it computes, a sentence."""

    @property
    def required(self) -> set[str]:
        return {name for name, argument in self.arguments.items() if argument.default is inspect.Parameter.empty}

    @property
    def call(self) -> str:
        """Its arguments as a table of formulas lists them; those in brackets may be left out."""
        return ", ".join(name if name in self.required else f"[{name}]" for name in self.arguments)

    def takes(self, arguments: Mapping[str, Any]) -> bool:
        return self.required <= arguments.keys() <= self.arguments.keys()

    def quantity(self, arguments: Mapping[str, Any], pick: str = "") -> Quantity:
        """One result.

        Raises:
            FormulaMistake: where there is none.
        """
        self._complain_kinds(arguments)
        try:
            result = self.function(**arguments)
        except (UserMistake, ValueError, ArithmeticError, LookupError, TypeError) as error:
            raise FormulaMistake(_sentence(error)) from error
        quantity = self._picked(result, pick)
        value = quantity.value
        if isinstance(value, float) and math.isnan(value):
            raise FormulaMistake("the result is no number, because the robot cannot do this.")
        return quantity

    def _picked(self, result: Result, pick: str) -> Quantity:
        if not isinstance(result, Mapping):
            if pick:
                raise FormulaMistake(f"{self.name} has one result only: leave pick out.")
            chosen = result
        elif pick not in result:
            problem = f"{self.name} has no result {pick}" if pick else f"{self.name} has several results, so pick one"
            raise FormulaMistake(f"{problem}: {nearest(pick, result)}")
        else:
            chosen = result[pick]
        quantity = chosen if isinstance(chosen, Quantity) else Quantity(chosen, self.unit)
        return Quantity(getattr(quantity.value, "item", lambda: quantity.value)(), quantity.unit)  # if it is NumPy's

    def _complain_kinds(self, arguments: Mapping[str, Any]) -> None:
        hints = get_type_hints(self.function)
        for name, value in arguments.items():
            if wrong := _wrong_kind(value, hints.get(name)):
                raise FormulaMistake(f"{name} must be {wrong}.")


FORMULAS: dict[str, Formula] = {}


def formula(name: str, unit: str | None = "") -> Callable[[F], F]:
    """Enter a function into the table.

    Args:
        unit: of results that are plain numbers; `ANY_UNIT` where it depends on what goes in.
    """

    def enter(function: F) -> F:
        assert name not in FORMULAS, f"two formulas {name}"
        text = (inspect.getdoc(function) or "").split("\n\n")[0]
        FORMULAS[name] = Formula(name, unit, function, inspect.signature(function).parameters, " ".join(text.split()))
        return function

    return enter


def _wrong_kind(value: Any, kind: Any) -> str:
    """What a value should be instead, or empty."""
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if kind is float and not number:
        return "a number"
    if kind is int and not isinstance(value, int):
        return "a whole number"
    if kind is str and not isinstance(value, str):
        return "a text in quotes"
    if kind is bool and not isinstance(value, bool):
        return "true or false"
    if kind == list[float] and not (isinstance(value, list) and all(not _wrong_kind(one, float) for one in value)):
        return "a list of numbers"
    if kind == dict[str, float]:
        good = isinstance(value, dict) and all(not _wrong_kind(one, float) for one in value.values())
        return "" if good else "a table of numbers such as { x = 0, y = 20 }"
    return ""


def _sentence(error: Exception) -> str:
    text = " ".join(str(error).split())
    if isinstance(error, (ZeroDivisionError, OverflowError)):
        text = "it divides by zero or grows beyond all bounds"
    text = text or type(error).__name__
    return text if text.endswith((".", "?", "!")) else f"{text}."
