"""Text of comments and tables: `# name: value` lines, then tables of numbers, each with a head, a blank line between.

Commas, semicolons or tabs between the columns, as spreadsheets save them; decimal commas unless commas separate.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.link.errors import LinkError

Array = NDArray[np.float64]

MAX_BYTES = 50_000_000
DIGITS = 10
"""Significant ones: a board's 32-bit floats come back exactly."""


@dataclass(frozen=True, eq=False)
class Table:
    """Numbers under their names."""

    names: tuple[str, ...]
    values: Array
    """(rows, len(names))"""
    lines: tuple[int, ...]
    """Number of the line in the text for each row, from 1; for complaints."""

    def column(self, name: str) -> Array:
        """(rows,) LinkError where the column is missing."""
        if name not in self.names:
            raise LinkError(f"There is no column {name}; the head names {', '.join(self.names)}.")
        return self.values[:, self.names.index(name)]

    def columns(self, names: Iterable[str]) -> Array:
        """(rows, names)"""
        wanted = [self.column(name) for name in names]
        return np.stack(wanted, axis=-1) if wanted else np.empty((len(self.values), 0))


def write_comments(notes: Mapping[str, str]) -> str:
    """One `# name: value` a line; blanks and line ends inside a value become single blanks."""
    return "".join(f"# {name}: {' '.join(value.split())}\n" for name, value in notes.items())


def write_table(names: Sequence[str], values: Array) -> str:
    """A head and the (rows, names) numbers."""
    rows = [",".join(f"{value:.{DIGITS}g}" for value in row) for row in np.asarray(values).tolist()]
    return "\n".join([",".join(names), *rows, ""])


def read_tables(text: str) -> tuple[dict[str, str], list[Table]]:
    """Comments by name, and the tables. LinkError with the line's number for anything that is not a number."""
    if len(text) > MAX_BYTES:
        raise LinkError(f"The file is larger than {MAX_BYTES // 1_000_000} MB; save a shorter part.")
    notes: dict[str, str] = {}
    blocks: list[list[tuple[int, str]]] = [[]]
    for number, raw in enumerate(text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n").split("\n"), 1):
        line = raw.strip(" ")
        if line.startswith("#"):
            name, _, value = line[1:].partition(":")
            notes[name.strip()] = value.strip()
        elif line.strip(",;\t "):
            blocks[-1].append((number, line))
        elif blocks[-1]:
            blocks.append([])
    return notes, [_table(block) for block in blocks if block]


def _table(block: list[tuple[int, str]]) -> Table:
    (_, head), *rows = block
    separator = next((mark for mark in "\t;" if mark in head), ",")
    names = tuple(name.strip().strip('"') for name in head.rstrip(separator).split(separator))
    values = [_row(number, line, separator, len(names)) for number, line in rows]
    return Table(names, np.array(values, dtype=float).reshape(-1, len(names)), tuple(number for number, _ in rows))


def _row(number: int, line: str, separator: str, width: int) -> list[float]:
    cells = line.rstrip(separator).split(separator)
    if len(cells) != width:
        raise LinkError(f"Line {number}: {len(cells)} columns instead of the head's {width}; correct or delete it.")
    row = []
    for cell in cells:
        try:
            row.append(float(cell if separator == "," else cell.replace(",", ".")))
        except ValueError:
            what = f"{cell.strip()[:20]!r}" if cell.strip() else "an empty cell"
            raise LinkError(f"Line {number}: {what} is not a number; correct it or delete the line.") from None
    return row
