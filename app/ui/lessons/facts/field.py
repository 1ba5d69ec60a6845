"""How the facts of one field are read and set. Values are in the units of the catalogue."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from app.classroom.lessons.lesson import Value

Read = Callable[[], Value | None]
Write = Callable[[Any], None]


@dataclass(frozen=True)
class Field:
    """`read_each` and `write_each` are for patterns: `joint.` -> a function that takes the rest of the name first."""

    read: Mapping[str, Read] = field(default_factory=dict)
    write: Mapping[str, Write] = field(default_factory=dict)
    read_each: Mapping[str, Callable[[str], Value | None]] = field(default_factory=dict)
    write_each: Mapping[str, Callable[[str, Any], None]] = field(default_factory=dict)


def deg(radians: float) -> float:
    """Degrees of radians."""
    return math.degrees(radians)


def index_of(name: str, names: tuple[str, ...]) -> int | None:
    """Where a name stands among others; None where it does not."""
    return names.index(name) if name in names else None
