"""Cut a lesson file into front matter, introduction, steps and their sections; nothing is understood yet."""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from markdown_it import MarkdownIt
from markdown_it.token import Token

from app.classroom.lessons.mistake import Complaints
from app.classroom.lessons.toml_block import TomlBlock

FENCE = "+++"


class Passage(NamedTuple):
    """Some Markdown, and the line of the file in which it begins."""

    markdown: str
    line: int

    @property
    def text(self) -> str:
        """Without empty lines around it."""
        return self.markdown.strip("\n").rstrip()


@dataclass(frozen=True)
class Section:
    """What stands under one heading, its TOML taken out of the text."""

    title: str
    line: int
    passage: Passage
    blocks: tuple[TomlBlock, ...] = ()


@dataclass
class Part:
    """A step: what stands under its own heading, and its sections."""

    top: Section
    sections: list[Section] = field(default_factory=list)


class Document(NamedTuple):
    """A whole file."""

    front: TomlBlock
    intro: Section
    parts: list[Part]
    source: str


class _Heading(NamedTuple):
    row: int
    """From 0."""
    after: int
    """Row of what follows."""
    level: int
    title: str


def split(source: str, complaints: Complaints) -> Document:
    """Everything in its place; what has none is complained about."""
    rows = source.split("\n")
    front, begin = _front_matter(rows, complaints)
    body = [""] * begin + rows[begin:]
    tokens = parser().parse("\n".join(body))
    headings = list(_headings(tokens, complaints))
    fences = [token for token in tokens if token.type == "fence" and token.level == 0 and _is_toml(token)]
    for token in fences:
        _complain_unclosed(token, body, complaints)
    ends = [heading.row for heading in headings] + [len(body)]
    intro = _section(_Heading(begin, begin, 0, ""), ends[0], body, fences)
    parts: list[Part] = []
    for heading, end in zip(headings, ends[1:], strict=True):
        section = _section(heading, end, body, fences)
        if heading.level == 2:
            parts.append(Part(section))
        elif parts:
            parts[-1].sections.append(section)
        else:
            complaints.add(section.line, "This section belongs to no step: write ## and the step's title above it.")
    return Document(front, intro, parts, source)


@functools.lru_cache(maxsize=1)
def parser() -> MarkdownIt:
    """For the structure only: what stands inside a paragraph is left as it is."""
    return MarkdownIt("commonmark").disable(["inline", "text_join"])


def _front_matter(rows: list[str], complaints: Complaints) -> tuple[TomlBlock, int]:
    """The block between the first two lines of +++, and the row after it."""
    if not rows or rows[0].strip() != FENCE:
        complaints.add(1, f"A lesson begins with its front matter: a line {FENCE}, TOML, and a line {FENCE}.")
        return TomlBlock("", 1), 0
    for row, text in enumerate(rows[1:], 1):
        if text.strip() == FENCE:
            return TomlBlock("\n".join(rows[1:row]), 2), row + 1
    complaints.add(1, f"The front matter never ends: put a line {FENCE} after it.")
    return TomlBlock("", 1), len(rows)


def _headings(tokens: list[Token], complaints: Complaints) -> Iterator[_Heading]:
    for token, content in itertools.pairwise(tokens):
        if token.type != "heading_open" or token.level or token.map is None:
            continue
        row, after = token.map
        title = " ".join(content.content.split())
        if token.markup not in ("##", "###"):
            complaints.add(row + 1, _wrong_heading(token.markup))
        elif not title:
            complaints.add(row + 1, "This heading is empty: write its title behind it.")
        else:
            yield _Heading(row, after, len(token.markup), title)


def _wrong_heading(markup: str) -> str:
    if markup in ("-", "="):
        return f"A line of {markup * 3} makes a heading of the text above it: put an empty line between them."
    return f"{markup} is no heading here: a step begins with ##, a section of it with ###."


def _is_toml(token: Token) -> bool:
    return token.info.split()[:1] == ["toml"]


def _complain_unclosed(token: Token, rows: list[str], complaints: Complaints) -> None:
    assert token.map is not None
    first, end = token.map
    if end - first < 2 or not re.fullmatch(r"\s*[`~]{3,}\s*", rows[end - 1]):
        complaints.add(first + 1, f"This block never ends: put {token.markup} after its last line.")


def _section(heading: _Heading, end: int, rows: list[str], fences: list[Token]) -> Section:
    text, blocks = rows[heading.after : end], []
    for token in fences:
        first, last = token.map or (0, 0)
        if heading.after <= first < end:
            blocks.append(TomlBlock(token.content, first + 2, " ".join(token.info.split()[1:])))
            text[first - heading.after : last - heading.after] = [""] * (last - first)
    return Section(heading.title, heading.row + 1, Passage("\n".join(text), heading.after + 1), tuple(blocks))
