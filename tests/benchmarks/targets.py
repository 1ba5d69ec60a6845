"""A table of what was measured beside what was promised."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class Row:
    """One measure."""

    stage: str
    what: str
    measured: float
    target: float | None = None
    """None where nothing was promised: printed to compare."""
    at_least: bool = False
    """Whether more is better."""
    note: str = ""

    @property
    def holds(self) -> bool | None:
        if self.target is None:
            return None
        return self.measured >= self.target if self.at_least else self.measured <= self.target

    def cells(self) -> list[str]:
        target = "" if self.target is None else f"{'>=' if self.at_least else '<='} {self.target:g}"
        verdict = {True: "yes", False: "**NO**", None: ""}[self.holds]
        return [self.stage, self.what, f"{self.measured:.4g}", target, verdict, self.note]

    def as_json(self) -> dict[str, Any]:
        return asdict(self) | {"holds": self.holds}


def table(rows: Sequence[Row]) -> str:
    """In Markdown."""
    head = ["stage", "what", "measured", "target", "holds", "note"]
    lines = [head, ["---"] * len(head), *(row.cells() for row in rows)]
    missed = sum(row.holds is False for row in rows)
    verdict = "All targets hold." if not missed else f"{missed} targets are missed."
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + f"\n\n{verdict}"
