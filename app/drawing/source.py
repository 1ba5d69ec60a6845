"""What there is to draw: a picture, or strokes from a file, from text or from a hand, told apart by content."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePath

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.drawing.errors import DrawingError
from app.drawing.exports.points_file import TITLE as POINTS_TITLE
from app.drawing.exports.points_file import read_points_file
from app.drawing.lettering import letter_strokes, unknown_characters
from app.drawing.load import load_image
from app.drawing.svg_import import read_svg

Array = NDArray[np.float64]

UTF8_MARK = b"\xef\xbb\xbf"
UTF16_XML = (b"\xff\xfe<\0", b"\xfe\xff\0<")
SHOWN_CHARACTERS = 20
LONGEST_TITLE = 60


@dataclass(frozen=True, eq=False)
class Source:
    """Something to draw; it has either a picture or strokes."""

    title: str
    grey: NDArray[np.uint8] | None
    """(h, w), 0 black to 255 white; None for a drawing that is strokes already."""
    strokes: list[Array] | None = None
    """(n, 2) each, y up, fitted to the sheet."""
    notes: tuple[str, ...] = ()
    """What its owner may want to know, a sentence each."""
    in_place: bool = False
    """Whether the strokes are sheet millimetres already, and stay where they are."""


def read_source(name: str, data: bytes) -> Source:
    """A picture, an SVG or a `Ptos_Dibujo.txt` from its bytes, whatever its name says. DrawingError otherwise."""
    title = PurePath(name.replace("\\", "/")).name or "picture"
    start = data[:4096].removeprefix(UTF8_MARK).lstrip()
    if start.startswith(b"<") or data.startswith(UTF16_XML):
        return Source(title, None, read_svg(data))
    if start.startswith(POINTS_TITLE.encode()):
        return Source(title, None, read_points_file(_text(data))[0])
    picture = load_image(data)
    return Source(title, picture.grey, notes=picture.notes)


def text_source(text: str) -> Source:
    """A text in the single-stroke font."""
    strokes = letter_strokes(text)
    title = " ".join(text.split())
    unknown = unknown_characters(text)
    notes = (f"The font lacks {' '.join(unknown[:SHOWN_CHARACTERS])}: a box stands for each.",) if unknown else ()
    return Source(title if len(title) <= LONGEST_TITLE else title[: LONGEST_TITLE - 1] + "…", None, strokes, notes)


def strokes_source(title: str, strokes: Sequence[ArrayLike], *, in_place: bool = False) -> Source:
    """Strokes (n, 2), y up, say of a hand; in place if they are sheet millimetres already."""
    arrays = [np.asarray(stroke, dtype=np.float64) for stroke in strokes]
    if not arrays:
        raise DrawingError("There are no strokes yet; draw at least one.")
    for stroke in arrays:
        if stroke.ndim != 2 or stroke.shape[1] != 2 or len(stroke) < 2 or not np.isfinite(stroke).all():
            raise DrawingError("A stroke needs two or more points x, y; draw it again.")
    return Source(title, None, arrays, in_place=in_place)


def _text(data: bytes) -> str:
    try:
        return data.removeprefix(UTF8_MARK).decode()
    except UnicodeDecodeError:
        raise DrawingError("The file of points is not plain text (UTF-8); save it as such and try again.") from None
