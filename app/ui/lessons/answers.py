"""What a student typed or chose, as a number."""

from __future__ import annotations

import math
import re

from app.classroom.lessons.lesson import Question
from app.errors import UserMistake

LONGEST = 30
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE)


def read_answer(question: Question, typed: str) -> float:
    """The number of the option, or the number that was typed.

    Raises:
        UserMistake: it is none.
    """
    value = _number(typed)
    if question.number is None:
        if value is None or not value.is_integer() or not 1 <= value <= len(question.choices):
            raise UserMistake("Choose one of the options first.")
        return value
    if value is None:
        raise UserMistake("Type a number, such as 12.5 or -3.")
    return value


def _number(typed: str) -> float | None:
    """As people write it: with a comma, a long minus, or a unit behind it."""
    plain = typed[:LONGEST].strip().replace("\N{MINUS SIGN}", "-").replace(",", ".").replace(" ", "")
    found = _NUMBER.match(plain)
    if found is None or any(character.isdigit() for character in plain[found.end() :]):
        return None
    value = float(found.group())
    return value if math.isfinite(value) else None
