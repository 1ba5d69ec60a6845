"""Recordings of a motor's input and output as CSV text, read as tolerantly as a student's file needs.

Commas, semicolons or tabs between columns; decimal commas unless commas separate the columns; an optional
header in any order, such as `time (s)`, `voltage (V)`, `angle (deg)`; `#` starts a comment.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

MAX_BYTES = 20_000_000
MAX_ROWS = 500_000
MAX_LINES = 2 * MAX_ROWS
"""With blank lines and comments."""

MAX_LINE = 2_000

QUANTITIES = {"t": "t", "time": "t", "u": "u", "voltage": "u", "input": "u"}
QUANTITIES |= {"y": "y", "angle": "y", "position": "y", "output": "y"}
UNITS = {"t": ("s", "sec", "seconds"), "u": ("v", "volt", "volts"), "y": ("deg", "degrees", "°", "mm")}
HEADER_CELL = re.compile(rf"({'|'.join(QUANTITIES)})(?:\s*[(\[_]\s*([a-z°]+)\s*[)\]]?)?")
EXPECTED = {"t": "the time in seconds", "u": "the voltage", "y": "the angle in degrees or the position in mm"}
NAMES = {"t": "time (s)", "u": "voltage (V)", "y": "angle (deg)"}


class RecordingError(ValueError):
    """A file that cannot be read; the message is one sentence saying where it is wrong and what to do."""


@dataclass(frozen=True, eq=False)
class Recording:
    """What went into a motor and what came out."""

    t: NDArray[np.float64]
    """(n,) s, increasing."""
    u: NDArray[np.float64]
    """(n,) V."""
    y: NDArray[np.float64]
    """(n,) in `unit`."""
    unit: str = "deg"
    """`deg` or `mm`."""


@dataclass(frozen=True)
class _Layout:
    """Where t, u and y stand in a row."""

    separator: str
    columns: tuple[int, int, int]
    narrowest: int
    widest: int
    unit: str = "deg"


def write_recording(recording: Recording) -> str:
    """CSV with a header; `read_recording` gives back the very same numbers."""
    name = "position (mm)" if recording.unit == "mm" else NAMES["y"]
    columns = (np.asarray(column, dtype=float).tolist() for column in (recording.t, recording.u, recording.y))
    rows = [f"{t!r},{u!r},{y!r}\n" for t, u, y in zip(*columns, strict=True)]
    return "".join([f"{NAMES['t']},{NAMES['u']},{name}\n", *rows])


def read_recording(data: bytes) -> Recording:
    """Read CSV. RecordingError, with the line's number, for anything that is not t, u and y in rows."""
    lines = _lines(_decoded(data))
    number, first = next(lines, (1, ""))
    if not first:
        raise RecordingError("Line 1: the file holds no data; it needs rows of time, voltage and angle.")
    layout, is_header = _layout(number, first)
    numbers, rows = ([], []) if is_header else ([number], [_row(number, first, layout)])
    for number, line in lines:
        rows.append(_row(number, line, layout))
        numbers.append(number)
        if len(rows) > MAX_ROWS:
            raise RecordingError(f"Line {number}: there are more than {MAX_ROWS} rows; record more slowly or for less.")
    if not rows:
        raise RecordingError(f"Line {number}: no data follow the header; add rows of time, voltage and angle.")
    table = np.array(rows)
    _check(table, numbers)
    return Recording(*table.T.copy(), unit=layout.unit)


def _decoded(data: bytes) -> str:
    if len(data) > MAX_BYTES:
        megabytes = MAX_BYTES // 1_000_000
        raise RecordingError(f"The file is larger than {megabytes} MB; record more slowly or for less time.")
    if b"\0" in data:
        line = data[: data.index(b"\0")].count(b"\n") + 1
        raise RecordingError(f"Line {line}: this is not plain text; save the table as CSV (UTF-8) and try again.")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")  # older spreadsheets: only a degree sign or a comment can differ


def _lines(text: str) -> Iterator[tuple[int, str]]:
    """Numbered lines that say something, without comments and without quotes."""
    for number, raw in enumerate(io.StringIO(text, newline=None), 1):
        if len(raw) > MAX_LINE:
            raise RecordingError(f"Line {number} is longer than {MAX_LINE} characters; put one sample on each line.")
        if number > MAX_LINES:
            raise RecordingError(f"Line {number}: there are more than {MAX_LINES} lines; delete the empty ones.")
        line = raw.partition("#")[0].replace('"', "").rstrip(" \n")
        if line.strip(" \t;,"):
            yield number, line


def _layout(number: int, first: str) -> tuple[_Layout, bool]:
    """How the file is laid out, and whether its first line is a header."""
    separator = next((mark for mark in "\t;" if mark in first), ",")
    cells = _cells(first, separator)
    found = [_quantity(cell) for cell in cells]
    if not any(found) and any(_is_number(cell, separator) for cell in cells):
        return _Layout(separator, (0, 1, 2), 3, 3), False
    columns = []
    for quantity, meaning in EXPECTED.items():
        places = [place for place, match in enumerate(found) if match and match[0] == quantity]
        if len(places) != 1:
            how_many = "several columns" if places else "no column"
            raise RecordingError(f"Line {number}: {how_many} for {meaning}; name one {quantity} or {NAMES[quantity]}.")
        columns += places
    unit = "mm" if found[columns[2]] == ("y", "mm") else "deg"
    t, u, y = columns
    return _Layout(separator, (t, u, y), max(columns) + 1, len(cells), unit), True


def _quantity(cell: str) -> tuple[str, str] | None:
    """(t, u or y, unit) that a header's cell names; None for any other column."""
    match = HEADER_CELL.fullmatch(cell.strip().lower())
    if not match:
        return None
    quantity, unit = QUANTITIES[match[1]], match[2] or ""
    return (quantity, unit) if not unit or unit in UNITS[quantity] else None


def _cells(line: str, separator: str) -> list[str]:
    return line.rstrip(separator).split(separator)


def _row(number: int, line: str, layout: _Layout) -> tuple[float, float, float]:
    """t, u and y of one line."""
    cells = _cells(line if layout.separator == "," else line.replace(",", "."), layout.separator)
    t, u, y = layout.columns
    if not layout.narrowest <= len(cells) <= layout.widest:
        raise RecordingError(
            f"Line {number}: {len(cells)} columns instead of {layout.widest}; give time, voltage and angle, "
            "with semicolons between them if the decimals have commas."
        )
    try:
        return float(cells[t]), float(cells[u]), float(cells[y])
    except ValueError:
        wrong = next(cells[place] for place in layout.columns if not _is_number(cells[place], layout.separator))
        what = f"{wrong.strip()[:20]!r}" if wrong.strip() else "an empty cell"
        raise RecordingError(f"Line {number}: {what} is not a number; correct it or delete the line.") from None


def _is_number(cell: str, separator: str) -> bool:
    try:
        float(cell if separator == "," else cell.replace(",", "."))
    except ValueError:
        return False
    return True


def _check(table: NDArray[np.float64], numbers: list[int]) -> None:
    """Finite values and increasing times."""
    finite = np.isfinite(table).all(axis=1)
    if not finite.all():
        line = numbers[int(np.argmin(finite))]
        raise RecordingError(f"Line {line}: a value is not finite; correct it or delete the line.")
    rising = np.diff(table[:, 0]) > 0.0
    if not rising.all():
        line = numbers[int(np.argmin(rising)) + 1]
        raise RecordingError(f"Line {line}: the time does not increase; sort the rows and delete repeated ones.")
