"""The tables of PROTOCOL.md and the enumerations of the C headers, read from their text."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.support.imports import ROOT

LINK = ROOT / "app" / "link"
TEXT = (LINK / "PROTOCOL.md").read_text()


def headers() -> str:
    """codes.h and settings.h without their comments."""
    core = LINK / "firmware" / "deltalab" / "src" / "core"
    return re.sub(
        r"/\*.*?\*/", "", "".join((core / name).read_text() for name in ("codes.h", "settings.h")), flags=re.S
    )


def c_constants() -> dict[str, int]:
    """Every name of an enumeration or a #define, with its number."""
    found: dict[str, int] = {}
    text = headers()
    for name, value in re.findall(r"#define (DL_\w+) (.+)", text):
        found[name] = _value(value, found)
    for body in re.findall(r"enum \{(.*?)\}", text, flags=re.S):
        last = -1
        for entry in filter(None, map(str.strip, body.split(","))):
            name, _, value = map(str.strip, entry.partition("="))
            last = _value(value, found) if value else last + 1
            found[name] = last
    return found


def _value(text: str, known: dict[str, int]) -> int:
    """A number, or a sum or product of numbers and names."""
    if " + " in text.strip("()") and "*" not in text:
        return sum(_value(part, known) for part in text.strip("()").split("+"))
    text = text.strip()
    return int(text, 0) if text[:1].isdigit() else known.get(text, -1)


def tables() -> Iterator[list[list[str]]]:
    """Every table, as rows of cells without the ruler."""
    for block in re.findall(r"(?:^\|.*\n)+", TEXT, flags=re.M):
        rows = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in block.splitlines()]
        yield [rows[0], *rows[2:]]


def table(first: str, *others: str) -> list[list[str]]:
    """The rows below the head that begins with these cells."""
    head = [first, *others]
    return [row for found in tables() if found[0][: len(head)] == head for row in found[1:]]
