"""The elements of an SVG file that somebody uploaded: nothing in it is fetched, run or expanded."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from xml.parsers import expat

from app.drawing.errors import DrawingError

MAX_BYTES = 6_000_000
MAX_DEPTH = 60
"""Elements within elements."""

MAX_ELEMENTS = 50_000

FOREIGN_URL = re.compile(r"@import|url\(\s*+[\"']?+\s*+(?!#|data:)", re.IGNORECASE)
PLAIN = "save the drawing as a plain SVG, all of it in one file, and try again"


@dataclass(frozen=True, eq=False)
class Element:
    """One element; its tag is without the name space's prefix."""

    tag: str
    attributes: dict[str, str]
    children: list[Element] = field(default_factory=list)

    @property
    def link(self) -> str:
        """What `href` or `xlink:href` names."""
        return self.attributes.get("href") or self.attributes.get("xlink:href") or ""


def parse_svg(data: bytes) -> Element:
    """The root `svg` element. DrawingError for what is no SVG, is too large, or holds more than a drawing."""
    if len(data) > MAX_BYTES:
        raise DrawingError(f"The SVG is larger than {MAX_BYTES // 1_000_000} MB; simplify its paths and save it again.")
    builder = _Builder()
    try:
        builder.parser.Parse(data, True)
    except DrawingError:
        raise
    except (expat.ExpatError, LookupError, ValueError):  # the last two: an unknown encoding
        line = builder.parser.ErrorLineNumber
        raise DrawingError(f"The file is no readable SVG (line {line}); save it as a plain SVG again.") from None
    if builder.root.tag != "svg":
        raise DrawingError(f"The file is XML, but a {builder.root.tag[:20]!r} and not an SVG; choose an SVG file.")
    return builder.root


class _Builder:
    """Builds the tree as the parser goes, so that it stops at the first thing that does not belong."""

    root: Element

    def __init__(self) -> None:
        self.parser = expat.ParserCreate()
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text
        self.parser.EntityDeclHandler = self._entity
        self.parser.ProcessingInstructionHandler = self._instruction
        self._open: list[Element] = []
        self._style: list[str] = []
        self._count = 0

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        element = Element(name.rpartition(":")[2], attributes)
        _refuse_more_than_a_drawing(element)
        self._count += 1
        if len(self._open) >= MAX_DEPTH:
            raise DrawingError(f"The SVG's groups are nested more than {MAX_DEPTH} deep; ungroup them and try again.")
        if self._count > MAX_ELEMENTS:
            raise DrawingError(f"The SVG has more than {MAX_ELEMENTS} elements; simplify the drawing and try again.")
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element
        self._open.append(element)

    def _end(self, _name: str) -> None:
        if self._open.pop().tag != "style":
            return
        if FOREIGN_URL.search("".join(self._style)):
            raise DrawingError(f"The SVG's style sheet refers to another file; {PLAIN}.")
        self._style.clear()

    def _text(self, text: str) -> None:
        if self._open[-1].tag == "style":
            self._style.append(text)

    def _entity(self, *_declaration: object) -> None:
        raise DrawingError(f"The SVG declares entities, which can blow up a file; {PLAIN}.")

    def _instruction(self, target: str, _data: str) -> None:
        if target == "xml-stylesheet":
            raise DrawingError(f"The SVG refers to a style sheet in another file; {PLAIN}.")


def _refuse_more_than_a_drawing(element: Element) -> None:
    """Scripts and other files do nothing here, but who opens the file elsewhere would meet them."""
    if element.tag.lower() == "script":
        raise DrawingError(f"The SVG holds a script; {PLAIN}.")
    for name, value in element.attributes.items():
        is_link = name.rpartition(":")[2].lower() == "href"
        target = value.strip().lower()
        if name.lower().startswith("on") or (is_link and target.startswith("javascript:")):
            raise DrawingError(f"The SVG holds a script ({name[:20]!r}); {PLAIN}.")
        is_elsewhere = is_link and element.tag != "a" and not target.startswith(("#", "data:image/"))
        if is_elsewhere or FOREIGN_URL.search(value):
            raise DrawingError(f"The SVG refers to another file ({value.strip()[:40]!r}); {PLAIN}.")
