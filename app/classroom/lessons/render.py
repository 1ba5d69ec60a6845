"""Markdown to HTML that is safe to show: raw HTML stays text, equations become MathML, pictures come along."""

from __future__ import annotations

import base64
import functools
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.token import Token

from app.classroom.lessons.markdown import PICTURES, lesson_key, lesson_markdown, picture_beside
from app.equations import LatexMistake, mathml


def to_html(markdown: str, *, folder: Path | None = None) -> str:
    """HTML of a text, with data URIs for pictures in `folder`. Cached.

    Links to lessons become `?lesson=KEY`; others open a new page. What cannot be shown is shown as it was written.
    """
    return _rendered(markdown, folder)


def forget_rendered() -> None:
    """Pictures have changed on disk."""
    _rendered.cache_clear()


@functools.lru_cache(maxsize=4096)
def _rendered(markdown: str, folder: Path | None) -> str:
    return _renderer().render(markdown, {"folder": folder})


@functools.lru_cache(maxsize=1)
def _renderer() -> MarkdownIt:
    markdown = lesson_markdown()
    markdown.add_render_rule("math_inline", _inline_equation)
    markdown.add_render_rule("math_inline_double", _equation_in_text)
    markdown.add_render_rule("math_block", _equation)
    markdown.add_render_rule("image", _picture)
    markdown.add_render_rule("link_open", _link)
    return markdown


def _inline_equation(_: RendererHTML, tokens: Sequence[Token], at: int, *__: Any) -> str:
    return _converted(tokens[at].content, block=False)


def _equation(_: RendererHTML, tokens: Sequence[Token], at: int, *__: Any) -> str:
    return f'<div class="equation">{_converted(tokens[at].content, block=True)}</div>\n'


def _equation_in_text(_: RendererHTML, tokens: Sequence[Token], at: int, *__: Any) -> str:
    return f'<span class="equation">{_converted(tokens[at].content, block=True)}</span>'


def _converted(latex: str, block: bool) -> str:
    try:
        return mathml(latex.strip(), block)
    except LatexMistake:
        return f"<code>{escape(latex)}</code>"


def _picture(renderer: RendererHTML, tokens: Sequence[Token], at: int, options: Any, env: dict[str, Any]) -> str:
    token = tokens[at]
    text = escape(renderer.renderInlineAsText(token.children, options, env))
    path = picture_beside(env.get("folder"), str(token.attrGet("src") or ""))
    if path is None:
        return f"<em>[{text}]</em>"
    content = base64.b64encode(path.read_bytes()).decode()
    return f'<img class="picture" alt="{text}" src="data:{PICTURES[path.suffix]};base64,{content}">'


def _link(renderer: RendererHTML, tokens: Sequence[Token], at: int, options: Any, env: dict[str, Any]) -> str:
    token = tokens[at]
    address = str(token.attrGet("href") or "")
    if key := lesson_key(address):
        token.attrSet("href", f"?lesson={key}")
    else:
        token.attrSet("target", "_blank")
        token.attrSet("rel", "noopener noreferrer")
    return renderer.renderToken(tokens, at, options, env)
