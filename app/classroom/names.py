"""Names: what of a typed one is kept, and which two look the same."""

from __future__ import annotations

import itertools
import unicodedata
from collections.abc import Container

LONGEST_NAME = 24
LONGEST_LOOKED_AT = 8 * LONGEST_NAME
"""Whatever stands behind this is not even looked at."""

MARKS_IN_A_ROW = 2
"""More accents on one letter would reach into the neighbouring lines."""

_LOOK_ALIKE = str.maketrans(
    "01|!iаеорсухіјѕԁһӏкмнтвαορνυικτη",
    "ollllaeopcyxljsdhlkmhtbaopvulktn",
)
"""Letters that are read as another one, small letters only: digits, Cyrillic, Greek."""


def clean_name(typed: str) -> str:
    """The name in one line, short, without what cannot be seen; empty if no letter or digit is left."""
    composed = unicodedata.normalize("NFC", typed[:LONGEST_LOOKED_AT])
    printable = "".join(character if character.isprintable() else " " for character in composed)
    short = " ".join(_few_marks(printable).split())[:LONGEST_NAME].rstrip()
    return short if any(character.isalnum() for character in short) else ""


def name_key(name: str) -> str:
    """The same for names that people take for one another: by case, spaces, width, or letters that look alike."""
    plain = unicodedata.normalize("NFKC", name).casefold().translate(_LOOK_ALIKE)
    return "".join(character for character in plain if character.isalnum() or _is_mark(character))


def free_name(name: str, taken: Container[str]) -> str:
    """The first of "Ada", "Ada 2", "Ada 3" ... whose key is not taken."""
    numbered = (f"{name[: LONGEST_NAME - 5].rstrip()} {number}" for number in itertools.count(2))
    return next(free for free in itertools.chain([name], numbered) if name_key(free) not in taken)


def _few_marks(text: str) -> str:
    kept: list[str] = []
    for character in text:
        if _is_mark(character) and all(map(_is_mark, kept[-MARKS_IN_A_ROW:])) and len(kept) >= MARKS_IN_A_ROW:
            continue
        kept.append(character)
    return "".join(kept)


def _is_mark(character: str) -> bool:
    return unicodedata.category(character).startswith("M")
