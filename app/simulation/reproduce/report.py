"""The comparison on paper: a table for people, JSON for programs."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from itertools import groupby
from typing import Any

from rich.console import Console, Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from app.simulation.reproduce.figure import Figure, Verdict
from app.simulation.reproduce.paper import Paper

STYLES: dict[Verdict, str] = {
    "reproduced": "green",
    "not reproduced": "bold red",
    "paper wrong": "red",
    "left open": "yellow",
    "cannot tell": "yellow",
    "input": "dim",
    "beyond the paper": "cyan",
}

SUMMED_UP: dict[Verdict, str] = {
    "reproduced": "reproduced",
    "not reproduced": "not reproduced",
    "paper wrong": "wrong in print",
    "left open": "left open",
    "cannot tell": "cannot be checked",
    "input": "taken as input",
}
"""How the closing line calls the verdicts on the paper's own numbers."""

COLUMNS = ("printed", "ours", "difference", "unit", "verdict")
WIDTHS = (10, 10, 10, 8, 14)
"""Characters of each; the name before them takes what is left."""

NARROWEST, WIDEST = 80, 100
"""Characters a line; the latter where the output is no terminal, too."""


def print_table(papers: dict[str, Paper]) -> None:
    """To stdout; in colour on a terminal, else as plain text."""
    console = Console(highlight=False)
    console.width = min(max(console.width, NARROWEST), WIDEST) if console.is_terminal else WIDEST
    for paper in papers.values():
        console.print(as_table(paper, paper.figures()))


def as_table(paper: Paper, figures: list[Figure]) -> Group:
    """All figures under the headings of their sections, each note below its figure, and the closing line."""
    head = Padding(_line(*(Text(word, "bold") for word in ("", *COLUMNS))), (0, 0, 0, 2))
    return Group(Text(paper.citation, "bold"), "", head, *_sections(figures), "", Text(summary(figures), "bold"))


def summary(figures: list[Figure]) -> str:
    """Such as `34 entries: 28 reproduced, 2 wrong in print, 4 left open`; ours beyond the paper are counted apart."""
    counts = Counter(figure.verdict for figure in figures)
    beyond = counts.pop("beyond the paper", 0)
    parts = [f"{counts[verdict]} {words}" for verdict, words in SUMMED_UP.items() if counts[verdict]]
    line = f"{counts.total()} entries: {', '.join(parts)}"
    return f"{line}; {beyond} more of ours go beyond the paper." if beyond else f"{line}."


def as_json(papers: dict[str, Paper]) -> str:
    """An array with one object a figure; what has no value is null."""
    rows = [_fields(name, figure) for name, paper in papers.items() for figure in paper.figures()]
    return json.dumps(rows, indent=2, allow_nan=False)


def _fields(paper: str, figure: Figure) -> dict[str, Any]:
    """`printed` is a number where it is one, and `as_printed` keeps its digits."""
    return {
        "paper": paper,
        "section": figure.section,
        "name": figure.name,
        "unit": figure.unit,
        "printed": figure.value if figure.value is not None else figure.printed or None,
        "as_printed": figure.printed,
        "decimals": figure.decimals,
        "computed": figure.computed,
        "difference": figure.difference,
        "verdict": figure.verdict,
        "note": figure.note,
    }


def _sections(figures: list[Figure]) -> Iterator[RenderableType]:
    for title, members in groupby(figures, key=lambda figure: figure.section):
        yield ""
        yield Text(title, "bold")
        for figure in members:
            yield Padding(_line(*cells(figure)), (0, 0, 0, 2))
            if figure.note:
                yield Padding(Text(figure.note, "dim"), (0, 2, 0, 4))


def cells(figure: Figure) -> list[Text]:
    """One a column; each verdict is a word or two here."""
    texts = (figure.name, figure.printed or "-", _ours(figure), _difference(figure), figure.unit)
    return [*map(Text, texts), Text(figure.verdict.removesuffix(" the paper"), STYLES[figure.verdict])]


def _ours(figure: Figure) -> str:
    value = figure.computed
    if value is None or isinstance(value, str):
        return value or "-"
    if "e" in figure.printed:
        return f"{value:.4e}"
    if float(value).is_integer():
        return f"{value:.0f}"
    return f"{value:.5g}" if figure.decimals is None else f"{value:.{_shown_decimals(figure.decimals)}f}"


def _difference(figure: Figure) -> str:
    if figure.difference is None or figure.decimals is None:
        return "-"
    if "e" in figure.printed:
        return f"{figure.difference:+.2e}"
    if float(figure.difference).is_integer():
        return f"{figure.difference:+.0f}" if figure.difference else "0"
    return f"{figure.difference:+.{_shown_decimals(figure.decimals)}f}"


def _shown_decimals(printed: int) -> int:
    """More than printed, so that the rounding can be seen; no more than fit."""
    return min(max(printed + 2, 3), 7)


def _line(*cells: Text) -> Table:
    table = Table.grid(padding=(0, 1), expand=True)
    table.add_column(ratio=1)
    for width, justify in zip(WIDTHS, ("right", "right", "right", "left", "left"), strict=True):
        table.add_column(width=width, justify=justify)
    table.add_row(*cells)
    return table
