"""A new lesson to begin with: small, and whole."""

from __future__ import annotations

import re
import unicodedata
from pathlib import Path

from app.errors import UserMistake

LAST = 99
_TROUBLE = str.maketrans({'"': "'", "\\": "", "<": "", ">": "", "$": ""})
"""Characters that mean something in a lesson file."""

_LETTERS = str.maketrans({"ß": "ss", "ł": "l", "Ł": "L", "ø": "o", "Ø": "O", "æ": "ae", "đ": "d"})


def write_template(title: str, folder: Path) -> Path:
    """Write a lesson into a folder under the next free number; returns its file."""
    plain = " ".join(title.split())
    topic = _topic(plain)
    if not topic:
        raise UserMistake("A lesson needs a title with letters: deltalab lessons new 'The five-bar robot'.")
    number = max((int(path.name[:2]) for path in folder.glob("[0-9][0-9]-*.md")), default=0) + 1
    if number > LAST:
        raise UserMistake(f"There is a lesson {LAST} already, and no number after it: choose another folder.")
    path = folder / f"{number:02d}-{topic}.md"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8") as file:
            file.write(TEMPLATE.replace("TITLE", plain.translate(_TROUBLE)))
    except OSError as error:
        raise UserMistake(f"Cannot write {path}: {(error.strerror or 'unknown reason').lower()}.") from error
    return path


def _topic(title: str) -> str:
    """`Grübler's count` becomes grubler-s-count."""
    ascii_only = unicodedata.normalize("NFKD", title.translate(_LETTERS)).encode("ascii", "ignore").decode().lower()
    return "-".join(re.findall(r"[a-z0-9]+", ascii_only))[:48].strip("-")


TEMPLATE = Path(__file__).with_name("template.md").read_text(encoding="utf-8")
