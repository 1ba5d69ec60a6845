"""A paper: what it is called, and the figures of each of its sections."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from app.simulation.reproduce.figure import Figure


@dataclass(frozen=True)
class Paper:
    """Figures are computed when asked for, section after section."""

    citation: str
    sections: tuple[Callable[[], list[Figure]], ...]

    def figures(self) -> list[Figure]:
        """Every figure, in the paper's order."""
        return [figure for section in self.sections for figure in section()]
