"""Dimensions of a robot: frozen, checked, and known by the symbols of the papers."""

from __future__ import annotations

import dataclasses
import difflib
import math
from dataclasses import dataclass
from typing import Any, Self


class GeometryError(ValueError):
    """A robot that cannot be built; the message is one sentence for the user."""


@dataclass(frozen=True)
class Dimension:
    """What a person needs to know to change one field of a geometry."""

    label: str
    low: float
    high: float
    unit: str
    """`m` or `rad`."""
    essential: bool
    """Shown as a slider; the others are for keywords."""


def length(default: float, label: str, low: float, high: float, *, essential: bool = True) -> Any:
    """A length in metres that may be set between `low` and `high`."""
    return dataclasses.field(default=default, metadata={"dimension": Dimension(label, low, high, "m", essential)})


def angle(default: float, label: str, low: float, high: float) -> Any:
    """An angle in radians that may be set between `low` and `high`."""
    return dataclasses.field(default=default, metadata={"dimension": Dimension(label, low, high, "rad", False)})


@dataclass(frozen=True, kw_only=True)
class Geometry:
    """Base of every robot's dimensions. Fields carry the paper's symbol as their name."""

    def __post_init__(self) -> None:
        for name, dimension in self.dimensions().items():
            value = getattr(self, name)
            if not isinstance(value, int | float) or isinstance(value, bool) or not math.isfinite(value):
                raise GeometryError(f"{dimension.label} ({name}) must be a number in {dimension.unit}, not {value!r}.")
            if not dimension.low <= value <= dimension.high:
                raise GeometryError(
                    f"{dimension.label} ({name}) must lie between {dimension.low:g} and {dimension.high:g} "
                    f"{dimension.unit}, not {value:g}."
                )
            object.__setattr__(self, name, float(value))

    @classmethod
    def dimensions(cls) -> dict[str, Dimension]:
        """Field name -> its label, range and unit, in the order of the class."""
        return {f.name: f.metadata["dimension"] for f in dataclasses.fields(cls) if "dimension" in f.metadata}

    def changed(self, **values: float) -> Self:
        """A copy with some fields replaced.

        Raises:
            GeometryError: for an unknown field or a value that is out of range.
        """
        known = self.dimensions()
        for name in values:
            if name not in known:
                close = difflib.get_close_matches(name, known, n=1)
                hint = f" Did you mean {close[0]!r}?" if close else ""
                raise GeometryError(f"{name!r} is not a dimension of this robot; it has {', '.join(known)}.{hint}")
        return dataclasses.replace(self, **values)
