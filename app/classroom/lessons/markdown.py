"""The Markdown of lessons: CommonMark with tables, crossed-out words, task lists and equations between dollar signs."""

from __future__ import annotations

import functools
import re
from pathlib import Path

from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.tasklists import tasklists_plugin

PICTURES = {".svg": "image/svg+xml", ".png": "image/png", ".jpg": "image/jpeg"}
"""Ending of a picture's name -> its media type."""


def lesson_markdown(html: bool = False) -> MarkdownIt:
    """A parser. `html`: raw HTML is found as such, to be complained about; otherwise it is plain text."""
    markdown = MarkdownIt("commonmark", {"html": html}).enable(["table", "strikethrough"])
    dollarmath_plugin(markdown, allow_labels=False, allow_space=False, double_inline=True)
    return markdown.use(tasklists_plugin)


@functools.lru_cache(maxsize=1)
def strict_parser() -> MarkdownIt:
    """For looking for mistakes."""
    return lesson_markdown(html=True)


def picture_beside(folder: Path | None, name: str) -> Path | None:
    """A picture in the lesson's own folder; None where there is none of this name."""
    if folder is None or not re.fullmatch(r"[\w-][\w.-]*", name) or Path(name).suffix not in PICTURES:
        return None
    path = folder / name
    return path if path.is_file() else None


def lesson_key(address: str) -> str | None:
    """Key of the lesson that a link leads to, written as `02-inverse` or `02-inverse.md`; None for other links."""
    return key[0] if (key := re.match(r"\d\d-[a-z0-9-]+(?=(\.md)?$)", address)) else None
