"""Lists in Markdown that mean something: the options of a question, and the three hints."""

from __future__ import annotations

import functools
import re
from typing import NamedTuple

from app.classroom.lessons.document import Passage, parser

_MARKER = re.compile(r"\s*(?:[-*+]|\d+[.)])\s+")
_BOX = re.compile(r"\[([ xX])\](?:\s+|$)")


class Option(NamedTuple):
    """One option of a question; its own text, and what is quoted under it."""

    line: int
    text: str
    feedback: str
    right: bool
    boxed: bool
    """Whether it begins with [ ] or [x]."""


@functools.lru_cache(maxsize=1024)
def options(passage: Passage) -> tuple[str, tuple[Option, ...]]:
    """The text without the list of options, and the options; none where no list begins with a box."""
    rows = passage.markdown.split("\n")
    found: list[Option] = []
    for first, last, items in _lists(passage.markdown, "bullet_list"):
        mine = [_option(rows[start:end], passage.line + start) for start, end in items]
        if any(option.boxed for option in mine):
            found += mine
            rows[first:last] = [""] * (last - first)
    return Passage("\n".join(rows), passage.line).text, tuple(found)


@functools.lru_cache(maxsize=1024)
def numbered(passage: Passage) -> tuple[str, ...]:
    """The items of the first numbered list."""
    rows = passage.markdown.split("\n")
    for _, _, items in _lists(passage.markdown, "ordered_list"):
        return tuple(_dedented(rows[start:end]) for start, end in items)
    return ()


def _option(rows: list[str], line: int) -> Option:
    source = _dedented(rows)
    box = _BOX.match(source)
    text, feedback = _apart(source[box.end() :] if box else source)
    return Option(line, text, feedback, bool(box and box[1] != " "), bool(box))


def _apart(source: str) -> tuple[str, str]:
    """What is written, and what is quoted."""
    rows, quoted = source.split("\n"), []
    for token in parser().parse(source):
        if token.type == "blockquote_open" and token.level == 0 and token.map:
            first, last = token.map
            quoted += [re.sub(r"^\s*>? ?", "", row) for row in rows[first:last]]
            rows[first:last] = [""] * (last - first)
    return "\n".join(rows).strip(), "\n".join(quoted).strip()


def _lists(markdown: str, kind: str) -> list[tuple[int, int, list[tuple[int, int]]]]:
    """(first row, row after, rows of the items) of each list that is in nothing else."""
    lists: list[tuple[int, int, list[tuple[int, int]]]] = []
    inside = False
    for token in parser().parse(markdown):
        if token.level == 0 and token.type.endswith("_open") and token.map:
            inside = token.type == f"{kind}_open"
            if inside:
                lists.append((token.map[0], token.map[1], []))
        elif inside and token.level == 1 and token.type == "list_item_open" and token.map:
            lists[-1][2].append((token.map[0], token.map[1]))
    return lists


def _dedented(rows: list[str]) -> str:
    """An item of a list without its marker."""
    marker = _MARKER.match(rows[0] + " ")
    width = marker.end() if marker else 0
    indent = re.compile(f" {{0,{width}}}")
    return "\n".join([rows[0][width:], *(indent.sub("", row, count=1) for row in rows[1:])]).strip()
