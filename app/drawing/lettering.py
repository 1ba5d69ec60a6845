"""Text as strokes, in the single-stroke font of `lettering_glyphs`."""

from __future__ import annotations

import unicodedata
from functools import lru_cache
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.lettering_glyphs import GLYPHS, MARKS, UNKNOWN
from app.drawing.svg_path import path_polylines

Align = Literal["left", "center", "right"]
Stroke = NDArray[np.float64]

TOLERANCE_MM = 0.01
MAX_CHARACTERS = 5_000
CAPITAL = 10.0
"""Height of a capital in the font's units."""

SPACE = 4.0
"""Width of a space in the font's units; the gaps to both sides come on top."""

ALIKE = str.maketrans(dict.fromkeys("’‘", "'") | dict.fromkeys("“”„", '"') | dict.fromkeys("–—−", "-"))
ALIKE |= str.maketrans(dict.fromkeys("\t\N{NO-BREAK SPACE}", " "))
"""What text processors make of plain characters."""

DOTLESS = {"i": "ı", "j": "ȷ"}
BELOW = {"\N{COMBINING CEDILLA}"}
FREE_HEIGHT = 8.0
"""Marks stand free over letters that are no higher."""


def letter_strokes(
    text: str, size_mm: float = 10.0, *, spacing: float = 0.2, line_pitch: float = 1.7, align: Align = "center"
) -> list[Stroke]:
    """(n, 2) sheet strokes in mm in the order of reading; the middle of what is drawn is the middle of the sheet.

    `size_mm` is the height of capitals; the gap between characters and the distance of lines are in capitals'
    heights. A character that the font lacks becomes a box: `unknown_characters` says which.
    """
    lines = _lines(text)
    if not (0.0 < size_mm <= 1000.0 and 0.0 <= spacing <= 10.0 and 0.0 <= line_pitch <= 10.0):
        raise DrawingError("Letters need a size above 0 and up to 1000 mm, and gaps of 0 to 10 times that; correct it.")
    if align not in get_args(Align):
        raise DrawingError(f"Text is aligned left, center or right, not {align!r}; choose one of them.")
    scale = size_mm / CAPITAL
    tolerance = TOLERANCE_MM / scale
    strokes = []
    for number, line in enumerate(lines):
        left = -_width(line, spacing * CAPITAL, tolerance) * get_args(Align).index(align) / 2.0
        strokes += _line_strokes(line, (left, -number * line_pitch * CAPITAL), spacing * CAPITAL, tolerance)
    if not strokes:
        raise DrawingError("The text has no letter to draw; write at least one.")
    points = np.concatenate(strokes)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    return [(stroke - middle) * scale for stroke in strokes]


def unknown_characters(text: str) -> str:
    """Every character once that the font lacks, in the order in which they occur."""
    return "".join(dict.fromkeys(character for line in _lines(text) for character in line if not _is_known(character)))


def _lines(text: str) -> list[str]:
    if len(text) > MAX_CHARACTERS:
        raise DrawingError(f"The text is longer than {MAX_CHARACTERS} characters; shorten it.")
    plain = unicodedata.normalize("NFC", text).translate(ALIKE)
    return plain.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def _width(line: str, gap: float, tolerance: float) -> float:
    """In the font's units."""
    return sum(_glyph(character, tolerance)[1] + gap for character in line) - gap if line else 0.0


def _line_strokes(line: str, start: tuple[float, float], gap: float, tolerance: float) -> list[Stroke]:
    x, y = start
    strokes = []
    for character in line:
        glyph, width = _glyph(character, tolerance)
        strokes += [stroke + (x, y) for stroke in glyph]
        x += width + gap
    return strokes


def _parts(character: str) -> tuple[str, str]:
    """The letter and the marks on it."""
    if character in GLYPHS:
        return character, ""
    letter, *marks = unicodedata.normalize("NFD", character)
    return letter, "".join(marks)


def _is_known(character: str) -> bool:
    letter, marks = _parts(character)
    return character == " " or (letter in GLYPHS and all(mark in MARKS for mark in marks))


@lru_cache(maxsize=1_000)
def _glyph(character: str, tolerance: float) -> tuple[tuple[Stroke, ...], float]:
    """Strokes from x = 0 on the line at y = 0, and the width, in the font's units."""
    if character == " ":
        return (), SPACE
    letter, marks = _parts(character) if _is_known(character) else ("", "")
    if any(mark not in BELOW for mark in marks):
        letter = DOTLESS.get(letter, letter)
    strokes = path_polylines(GLYPHS.get(letter, UNKNOWN), tolerance)
    points = np.concatenate(strokes)
    middle, rise = points[:, 0].max() / 2.0, 3.0 * (points[:, 1].max() > FREE_HEIGHT)
    for mark in marks:
        shift = np.array([middle, 0.0 if mark in BELOW else rise])
        strokes += [stroke + shift for stroke in path_polylines(MARKS[mark], tolerance)]
    points = np.concatenate(strokes)
    left, right = points[:, 0].min(), points[:, 0].max()
    return tuple(stroke - (left, 0.0) for stroke in strokes), float(right - left)
