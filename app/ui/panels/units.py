"""Between SI and what people read: millimetres and degrees."""

from __future__ import annotations

import math
from typing import Literal

Unit = Literal["m", "rad"]

FACTOR: dict[str, float] = {"m": 1e3, "rad": math.degrees(1.0)}
SHOWN_UNIT: dict[str, str] = {"m": "mm", "rad": "°"}


def shown(value: float, unit: str) -> float:
    """A value in m or rad as it is displayed, to a tenth of a millimetre or degree."""
    return round(value * FACTOR[unit], 1) + 0.0


def si(value: float, unit: str) -> float:
    """A displayed value in m or rad."""
    return value / FACTOR[unit]


def labelled(name: str, unit: str) -> str:
    """A field's label with its unit."""
    return f"{GREEK.get(name, name)} ({'mm' if unit == 'm' else 'deg'})"


GREEK = {"theta": "θ", "phi": "φ"}
