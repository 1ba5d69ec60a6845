"""A student's numbers put in place of `<<name>>`."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from app.classroom.lessons.lesson import Value

MARK = re.compile(r"<<\s*([A-Za-z_]\w*)\s*>>")


class Unknown(float):
    """Stands for a number that has not been computed; fits everywhere."""


UNKNOWN = Unknown("nan")


@dataclass(frozen=True)
class Number:
    """What a name stands for."""

    value: Value
    text: str
    """As it is written in texts."""
    unit: str | None = None
    """None where nobody has said."""


Numbers = Mapping[str, Number]


class Fill:
    """Puts numbers in; a name that is unknown stays as it is."""

    def __init__(self, numbers: Numbers) -> None:
        self.numbers = numbers

    def text(self, text: str) -> str:
        return MARK.sub(lambda mark: self.numbers[mark[1]].text if mark[1] in self.numbers else mark[0], text)

    def value(self, value: Any) -> Any:
        """A value of TOML; a string that is nothing but `<<name>>` becomes the number itself."""
        if isinstance(value, str):
            whole = MARK.fullmatch(value.strip())
            return self.numbers[whole[1]].value if whole and whole[1] in self.numbers else self.text(value)
        if isinstance(value, list):
            return [self.value(one) for one in value]
        if isinstance(value, dict):
            return {self.text(name): self.value(one) for name, one in value.items()}
        return value
