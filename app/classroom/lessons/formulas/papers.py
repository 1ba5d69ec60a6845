"""Numbers that the papers print, beside ours: the lines of `deltalab reproduce`."""

from __future__ import annotations

import functools

from app.classroom.lessons.formulas.registry import Quantity, formula


@formula("paper")
def paper(paper: str, section: str, name: str) -> dict[str, Quantity]:
    """A line of `deltalab reproduce`, by its paper, section and name: the number in the `paper`, and `ours`."""
    from app.simulation.reproduce import PAPERS

    if paper not in PAPERS:
        raise ValueError(f"the papers are {', '.join(PAPERS)}.")
    for figures in range(len(PAPERS[paper].sections)):
        for printed, ours, unit, where, label in _figures(paper, figures):
            if (where, label) == (section, name):
                numbers = {"paper": printed, "ours": ours}
                return {key: Quantity(number, unit) for key, number in numbers.items() if number is not None}
    raise ValueError(f"deltalab reproduce {paper} has no line {name} in {section}.")


@functools.cache
def _figures(paper: str, section: int) -> list[tuple[float | None, float | None, str, str, str]]:
    """Section after section, since some of them take seconds."""
    from app.simulation.reproduce import PAPERS

    figures = PAPERS[paper].sections[section]()
    return [
        (figure.value, figure.computed if isinstance(figure.computed, float) else None, *_label(figure))
        for figure in figures
    ]


def _label(figure) -> tuple[str, str, str]:
    return figure.unit, figure.section, figure.name
