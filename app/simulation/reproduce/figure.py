"""One printed number beside ours, and what to think of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Verdict = Literal[
    "reproduced", "not reproduced", "paper wrong", "left open", "cannot tell", "input", "beyond the paper"
]
"""`reproduced`: ours rounds to the printed digits, or a claim in words holds. `paper wrong`: a slip in print, ours is
what it must be. `left open`: not printed, though the results depend on it; ours was found or chosen. `cannot tell`: a
printed result that depends on what the paper does not print; ours is for values of our own. `input`: data, taken as
they stand. `beyond the paper`: ours only."""


@dataclass(frozen=True)
class Figure:
    """One line of the comparison. Texts are plain ASCII, so that any terminal can show them."""

    section: str
    """Where the paper prints it, say `Table 4`."""
    name: str
    unit: str
    """Of the printed and of our value; empty for pure numbers."""
    printed: str
    """Digit for digit; several where a few data share a line; empty where the paper prints nothing."""
    computed: float | str | None
    """Ours; None for data that nothing computes."""
    verdict: Verdict
    note: str = ""
    """One or two sentences."""

    @property
    def value(self) -> float | None:
        """The printed number; None where there is none, or several."""
        try:
            return float(self.printed)
        except ValueError:
            return None

    @property
    def decimals(self) -> int | None:
        """How many are printed."""
        return None if self.value is None else len(self.printed.partition(".")[2])

    @property
    def difference(self) -> float | None:
        """Ours minus the printed one."""
        if self.value is None or not isinstance(self.computed, (int, float)):
            return None
        return self.computed - self.value


@dataclass(frozen=True)
class Section:
    """A place in a paper; makes its figures. A printed number is a text, to keep its digits."""

    title: str

    def compared(self, name: str, unit: str, printed: str, computed: float, note: str = "") -> Figure:
        """The verdict is read off the digits: ours is at most half a unit of the last one away."""
        figure = Figure(self.title, name, unit, printed, float(computed), "reproduced", note)
        assert figure.difference is not None and figure.decimals is not None, "a printed number to compare with"
        if abs(figure.difference) <= 0.5 * 10.0**-figure.decimals + 1e-9:
            return figure
        return Figure(self.title, name, unit, printed, float(computed), "not reproduced", note)

    def given(self, name: str, unit: str, printed: str, note: str = "", computed: float | None = None) -> Figure:
        return Figure(self.title, name, unit, printed, computed, "input", note)

    def wrong(self, name: str, unit: str, printed: str, computed: float | str, note: str) -> Figure:
        return Figure(self.title, name, unit, printed, computed, "paper wrong", note)

    def claim(self, name: str, printed: str, ours: str, holds: bool, note: str = "") -> Figure:
        """What the paper says in words, beside what we see, in a few letters each."""
        return Figure(self.title, name, "", printed, ours, "reproduced" if holds else "not reproduced", note)

    def unsettled(self, name: str, unit: str, printed: str, computed: float, note: str = "") -> Figure:
        return Figure(self.title, name, unit, printed, computed, "cannot tell", note)

    def open(self, name: str, unit: str, computed: float | str, note: str) -> Figure:
        return Figure(self.title, name, unit, "", computed, "left open", note)

    def beyond(self, name: str, unit: str, computed: float | str, note: str = "") -> Figure:
        return Figure(self.title, name, unit, "", computed, "beyond the paper", note)
