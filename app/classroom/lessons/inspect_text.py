"""Mistakes in the Markdown of a lesson: equations, pictures, links, raw HTML, unknown numbers."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import unquote
from xml.etree import ElementTree

from markdown_it.token import Token

from app.classroom.lessons.document import Document, Passage
from app.classroom.lessons.fill import MARK, Fill
from app.classroom.lessons.markdown import PICTURES, lesson_key, picture_beside, strict_parser
from app.classroom.lessons.mistake import Complaints, nearest
from app.classroom.lessons.toml_block import TomlBlock, Where
from app.equations import LatexMistake, mathml

LARGEST_PICTURE = 200_000
"""Bytes; every student's page gets it in one message."""

OUTSIDE = ("http://", "https://", "mailto:")
_NOT_MARKDOWN = frozenset({"fact", "set", "press", "unit", "tab", "formula"})


def inspect_texts(document: Document, fill: Fill, complaints: Complaints) -> None:
    """Complain about everything in the texts of a lesson, and in the texts inside its TOML."""
    for passage in _passages(document):
        _inspect(Passage(fill.text(passage.markdown), passage.line), complaints)


def inspect_marks(document: Document, names: Iterable[str], complaints: Complaints) -> None:
    """Complain about `<<name>>` where there is no such number. The front matter has its own rules."""
    known = set(names)
    begin = document.front.line + document.front.source.count("\n") + 1
    for line, text in enumerate(document.source.split("\n"), 1):
        for mark in re.finditer(r"<<(.*?)>>", text) if line > begin else ():
            exact = MARK.fullmatch(mark[0])
            if exact is None or exact[1] not in known:
                hint = nearest(mark[1].strip(), known) if known else "add it under [vary] or [derive]."
                complaints.add(line, f"There is no number {mark[1].strip() or 'without a name'}: {hint}")


def _passages(document: Document) -> Iterator[Passage]:
    sections = [document.intro]
    for part in document.parts:
        sections += [part.top, *part.sections]
    for section in sections:
        yield section.passage
        for block in section.blocks:
            yield from _texts(block, block.read(Complaints(Path())), ())
    yield from _texts(document.front, document.front.read(Complaints(Path())), ())


def _texts(block: TomlBlock, value: Any, where: Where) -> Iterator[Passage]:
    if isinstance(value, str) and where[-1] not in _NOT_MARKDOWN:
        yield Passage(value, block.line_of(where))
    elif isinstance(value, dict):
        for key, one in value.items():
            yield from _texts(block, one, (*where, key))
    elif isinstance(value, list):
        for index, one in enumerate(value):
            yield from _texts(block, one, (*where, index))


def _inspect(passage: Passage, complaints: Complaints) -> None:
    for token in strict_parser().parse(passage.markdown):
        line = passage.line + (token.map[0] if token.map else 0)
        if token.type == "html_block":
            complaints.add(line, f"Raw HTML is not allowed: write {_shown(token.content)} in Markdown.")
        elif token.type == "math_block":
            _inspect_latex(token.content, line, complaints)
        elif token.type == "inline":
            _inspect_inline(token, line, complaints)


def _inspect_inline(token: Token, line: int, complaints: Complaints) -> None:
    for child in token.children or []:
        if child.type in ("softbreak", "hardbreak"):
            line += 1
        elif child.type == "html_inline" and "task-list-item" not in child.content:
            complaints.add(line, f"Raw HTML is not allowed: write {_shown(child.content)} in Markdown.")
        elif child.type in ("math_inline", "math_inline_double"):
            _inspect_latex(child.content, line, complaints)
            line += child.content.count("\n")
        elif child.type == "image":
            _inspect_picture(str(child.attrGet("src") or ""), child.content, line, complaints)
        elif child.type == "link_open":
            _inspect_link(unquote(str(child.attrGet("href") or "")), line, complaints)
        elif child.type == "text" and "$" in child.content and r"\$" not in token.content:
            complaints.add(line, r"A $ stands alone: close the equation, without spaces inside its $, or write \$.")


def _inspect_latex(latex: str, line: int, complaints: Complaints) -> None:
    try:
        mathml(latex.strip())
    except LatexMistake as mistake:
        complaints.add(line, f"The equation {_shown(latex)} {mistake}.")


def _inspect_picture(name: str, text: str, line: int, complaints: Complaints) -> None:
    path = picture_beside(complaints.path.parent, unquote(name))
    if path is None:
        kinds = ", ".join(ending.removeprefix(".") for ending in PICTURES)
        complaints.add(line, f"There is no picture {name} beside this file ({kinds}; letters, digits, - and _).")
    elif path.stat().st_size > LARGEST_PICTURE:
        complaints.add(line, f"The picture {name} is larger than {LARGEST_PICTURE // 1000} kB: make it smaller.")
    elif path.suffix == ".svg":
        _inspect_svg(path, line, complaints)
    if not text.strip():
        complaints.add(line, f"The picture {name} has no description: write it between the [ ].")


def _inspect_svg(path: Path, line: int, complaints: Complaints) -> None:
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, ValueError) as error:
        complaints.add(line, f"The picture {path.name} is no SVG: {error}.")
        return
    if not root.tag.endswith("svg") or "viewBox" not in root.attrib:
        complaints.add(line, f"The picture {path.name} needs a viewBox in its <svg>, to fit any width.")


def _inspect_link(address: str, line: int, complaints: Complaints) -> None:
    if address.startswith(OUTSIDE):
        return
    folder, key = complaints.path.parent, lesson_key(address)
    if key is not None:
        if not (folder / f"{key}.md").is_file():
            known = [path.stem for path in folder.glob("[0-9][0-9]-*.md")]
            complaints.add(line, f"There is no lesson {key}: {nearest(key, known)}")
    else:
        complaints.add(line, f"The link {address} leads nowhere: link to a lesson's file or to https://...")


def _shown(text: str) -> str:
    flat = " ".join(text.split())
    return flat if len(flat) <= 50 else flat[:47] + "..."
