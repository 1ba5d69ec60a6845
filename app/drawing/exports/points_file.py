"""The paper's `Ptos_Dibujo.txt`: points for the robot to go through one after the other.

The paper names the file and does not print it; this is our reading of it.

    # Ptos_Dibujo 1
    # sheet_mm 160.0 120.0
    -20.0 10.0 4.0
    -20.0 10.0 0.0
    -15.5 11.0 0.0
    -15.5 11.0 4.0

After two lines of header one point a line, `x y z` in mm: x to the right and y up from the middle of the sheet,
z 0 where the pen draws and above 0 where it is lifted. Every stroke begins with a lifted point over its first point
and ends with one over its last, so that a robot that only goes from line to line lifts its pen between strokes.
Numbers have as many digits as it takes to get the very same strokes back.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.drawing.errors import DrawingError
from app.drawing.exports.strokes import LARGEST_MM, SheetSize, Stroke, checked_sheet, checked_strokes

TITLE = "# Ptos_Dibujo 1"
SHEET = "# sheet_mm"
LIFT_MM = 4.0
MAX_CHARACTERS = 50_000_000

Point = tuple[float, float, float]


def write_points_file(strokes: Sequence[Stroke], sheet_mm: SheetSize, *, lift_mm: float = LIFT_MM) -> str:
    """Text as described above."""
    if not 0.0 < lift_mm <= LARGEST_MM:
        raise DrawingError(f"A lift of {lift_mm:g} mm does not lift the pen; give millimetres above zero.")
    width, height = checked_sheet(sheet_mm)
    lines = [TITLE, f"{SHEET} {width!r} {height!r}"]
    for stroke in checked_strokes(strokes):
        points = [f"{x!r} {y!r}" for x, y in stroke.tolist()]
        lines.append(f"{points[0]} {float(lift_mm)!r}")
        lines += [f"{point} 0.0" for point in points]
        lines.append(f"{points[-1]} {float(lift_mm)!r}")
    return "\n".join([*lines, ""])


def read_points_file(text: str) -> tuple[list[Stroke], SheetSize]:
    """Strokes (n, 2) and sheet in mm. DrawingError, with the line's number, for anything but that format."""
    if len(text) > MAX_CHARACTERS:
        raise DrawingError(f"The file of points is larger than {MAX_CHARACTERS // 1_000_000} MB; simplify the drawing.")
    title, sheet_line, *lines = [*text.splitlines(), "", ""]
    if title.strip() != TITLE:
        raise DrawingError(f"Line 1: the file is not one of Delta Lab's points; its first line must be {TITLE!r}.")
    if not sheet_line.startswith(SHEET):
        raise DrawingError(f"Line 2: the sheet is missing; write its size as in '{SHEET} 160 120'.")
    width, height = _numbers(2, sheet_line.removeprefix(SHEET), 2)
    points = [_point(number, line) for number, line in enumerate(lines, 3) if line.strip()]
    numbers = [number for number, line in enumerate(lines, 3) if line.strip()]
    return _strokes(points, numbers), checked_sheet((width, height))


def _strokes(points: list[Point], numbers: list[int]) -> list[Stroke]:
    """Lifted, drawn, ..., drawn, lifted; and again."""
    strokes, place = [], 0
    while place < len(points):
        first = place + 1
        last = first
        while last < len(points) and points[last][2] == 0.0:
            last += 1
        if points[place][2] == 0.0 or last == len(points):
            number = numbers[min(last, len(points) - 1)]
            raise DrawingError(f"Line {number}: a stroke must begin and end lifted; write z above 0 there.")
        if last - first < 2:
            raise DrawingError(f"Line {numbers[last]}: a stroke needs two or more points with z 0 before it ends.")
        for lifted, touching in ((place, first), (last, last - 1)):
            if points[lifted][:2] != points[touching][:2]:
                raise DrawingError(f"Line {numbers[lifted]}: the pen must be lifted right over the stroke's end.")
        strokes.append(np.array(points[first:last])[:, :2].copy())
        place = last + 1
    return strokes


def _point(number: int, line: str) -> Point:
    x, y, z = _numbers(number, line, 3)
    if z < 0.0:
        raise DrawingError(f"Line {number}: z {z:g} is below the paper; z is 0 to draw and above 0 to lift.")
    return x, y, z


def _numbers(number: int, text: str, count: int) -> list[float]:
    try:
        values = [float(word) for word in text.replace("_", "?").split()]  # float() takes 1_000, other readers do not
    except ValueError:
        values = []
    if len(values) != count or not all(abs(value) <= LARGEST_MM for value in values):
        raise DrawingError(f"Line {number}: {text.strip()[:30]!r} are not {count} numbers in mm; correct the line.")
    return values
