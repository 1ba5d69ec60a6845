"""The data of an SVG path as polylines: every command, absolute and relative."""

from __future__ import annotations

import cmath
import math
import re

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.svg_units import NUMBER, finite_number

MAX_POINTS = 300_000
"""Of one path, and of a whole drawing."""

MAX_STEPS = 1_000
"""Of one curve."""

COUNTS = {"M": 2, "Z": 0, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7}
"""Numbers that a command takes at a time."""

COMMAND = re.compile("([MmZzLlHhVvCcSsQqTtAa])([^MmZzLlHhVvCcSsQqTtAa]*+)")
SPACED = rf"{NUMBER}[\s,]*+"
ONE_ARC = rf"((?:{SPACED}){{3}})([01])[\s,]*+([01])[\s,]*+({SPACED}{SPACED})"
"""Its flags may stand together, even with the number that follows: `5 5 0 0110 10`."""

VALUE, ARC = re.compile(NUMBER), re.compile(ONE_ARC)
VALUES, ARCS = (re.compile(rf"[\s,]*+(?:{one})*+") for one in (SPACED, ONE_ARC))


def path_polylines(data: str, tolerance: float) -> list[NDArray[np.float64]]:
    """(n, 2) points of every subpath in the path's own units, off its curves by at most `tolerance`.

    A closed subpath repeats its first point; one that stands still is a dot of two equal points.
    """
    pen = _Pen(tolerance)
    if data.strip() and data.lstrip()[0] not in "Mm":
        raise _unreadable(data)
    for command in COMMAND.finditer(data):
        letter = command[1]
        for row in _rows(letter, command[2]):
            pen.draw(letter, row)
            letter = {"M": "L", "m": "l"}.get(letter, letter)  # further pairs of a moveto are lines
    pen.lift()
    return [np.array(line, np.complex128).view(np.float64).reshape(-1, 2) for line in pen.lines]


def _unreadable(text: str) -> DrawingError:
    return DrawingError(f"The SVG has the path data {text.strip()[:30]!r}, which make no path; save it as a plain SVG.")


def _too_long() -> DrawingError:
    return DrawingError(f"A path of the SVG has more than {MAX_POINTS} points; simplify it and try again.")


def _rows(letter: str, text: str) -> list[list[float]]:
    """The numbers behind a command, as many at a time as it takes."""
    is_arc, count = letter in "Aa", COUNTS[letter.upper()]
    words = VALUE.findall(ARC.sub(r"\1\2 \3 \4 ", text) if is_arc else text)
    fits = len(words) % count == 0 and words if count else not words
    if not fits or not (ARCS if is_arc else VALUES).fullmatch(text):
        raise _unreadable(letter + text)
    if not count:
        return [[]]
    if len(words) > count * MAX_POINTS:
        raise _too_long()
    values = list(map(float, words))
    finite_number(words[values.index(max(values, key=abs))])
    return [values[place : place + count] for place in range(0, len(values), count)]


class _Pen:
    """Follows the commands. Points are complex numbers: x + iy."""

    def __init__(self, tolerance: float) -> None:
        self.lines: list[list[complex]] = []
        self._line: list[complex] = []
        self._at = self._start = 0j
        self._handle = ("", 0j)
        """Which curve came last, and its last control point."""
        self._tolerance = tolerance
        self._count = 0

    def draw(self, letter: str, row: list[float]) -> None:
        """One command with the numbers that it takes."""
        self._count_in(1)
        base = self._at if letter.islower() else 0j
        match letter.upper():
            case "M":
                self.lift()
                self._at = self._start = base + complex(*row)
            case "L":
                self._add([base + complex(*row)])
            case "H":
                self._add([complex(base.real + row[0], self._at.imag)])
            case "V":
                self._add([complex(self._at.real, base.imag + row[0])])
            case "A":
                self._arc(row[:5], base + complex(row[5], row[6]))
            case "Z":
                self._close()
            case curve:
                self._curve(curve, [base + complex(*pair) for pair in zip(row[::2], row[1::2], strict=True)])
                return
        self._handle = ("", 0j)

    def lift(self) -> None:
        """End a subpath."""
        if self._line:
            self.lines.append(self._line)
            self._line = []

    def _count_in(self, points: int) -> None:
        self._count += points
        if self._count > MAX_POINTS:
            raise _too_long()

    def _add(self, points: list[complex]) -> None:
        self._line = self._line or [self._at]
        self._line += points
        self._at = points[-1]
        self._count_in(len(points) - 1)

    def _close(self) -> None:
        if not self._line or self._at != self._start:
            self._add([self._start])
        self.lift()

    def _curve(self, curve: str, points: list[complex]) -> None:
        """C, S, Q and T, all as cubics."""
        kind = "C" if curve in "CS" else "Q"
        if curve in "ST":
            last, handle = self._handle
            points = [2.0 * self._at - handle if last == kind else self._at, *points]
        self._handle = (kind, points[-2])
        if kind == "Q":
            control, end = points
            points = [self._at + (control - self._at) / 1.5, end + (control - end) / 1.5, end]
        self._cubic(*points)

    def _cubic(self, b: complex, c: complex, d: complex) -> None:
        a = self._at
        bend = max(abs(a - 2.0 * b + c), abs(b - 2.0 * c + d))
        t = self._steps(math.sqrt(0.75 * bend / self._tolerance))
        s = 1.0 - t
        self._add([*(s**3 * a + 3.0 * s**2 * t * b + 3.0 * s * t**2 * c + t**3 * d)[:-1].tolist(), d])

    def _arc(self, ellipse: list[float], end: complex) -> None:
        """In coordinates in which the ellipse is the unit circle and the chord's middle the origin."""
        rx, ry, degrees, large, sweep = ellipse
        rx, ry, turn = abs(rx), abs(ry), cmath.rect(1.0, math.radians(degrees))
        half = (self._at - end) / 2.0 / turn
        if min(rx, ry) < 1e-9 or not half:
            self._add([end])
            return
        u = complex(half.real / rx, half.imag / ry)
        grow = max(abs(u), 1.0)  # radii too small for the chord grow until they reach
        rx, ry, u = rx * grow, ry * grow, u / grow
        centre = (-1j if large != sweep else 1j) * u * math.sqrt(max(1.0 / abs(u) ** 2 - 1.0, 0.0))
        first, last = cmath.phase(u - centre), cmath.phase(-u - centre)
        angle = (last - first) % math.tau - (0.0 if sweep else math.tau)
        t = self._steps(abs(angle) / math.sqrt(8.0 * self._tolerance / max(rx, ry)))
        circle = centre + np.exp(1j * (first + angle * t[:-1]))
        middle = (self._at + end) / 2.0
        self._add([*(middle + turn * (rx * circle.real + 1j * ry * circle.imag)).tolist(), end])

    def _steps(self, needed: float) -> NDArray[np.float64]:
        """Parameters of the points that follow the current one, the last of them 1."""
        count = min(max(math.ceil(needed), 1), MAX_STEPS)
        return np.arange(1, count + 1) / count
