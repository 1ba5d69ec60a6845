"""Small pieces of a lesson's HTML."""

from __future__ import annotations

import html

from app.ui.panels.lessons.style import CLASS

escape = html.escape


def block(content: str) -> str:
    """A stretch of the panel; empty stays empty."""
    return f'<div class="{CLASS}">{content}</div>' if content else ""


def button(what: str, label: str, value: object = "", *, tone: str = "", why_not: str = "", hint: str = "") -> str:
    """A button that says `what` and `value` to the server. With a reason `why_not` it is greyed."""
    attributes = [f'type="button" data-lesson="{escape(what)}" data-value="{escape(str(value))}"']
    if tone:
        attributes.append(f'class="{tone}"')
    if why_not:
        attributes.append('aria-disabled="true"')
    if title := why_not or hint:
        attributes.append(f'title="{escape(title)}"')
    return f"<button {' '.join(attributes)}>{escape(label)}</button>"


def row(*pieces: str) -> str:
    content = "".join(pieces)
    return f'<div class="row">{content}</div>' if content else ""


def card(title: str, content: str, tone: str = "") -> str:
    """A box with a small title; `tone` is `now`, `later` or nothing."""
    return f'<section class="card {tone}"><h4>{escape(title)}</h4>{content}</section>'


def verdict(right: bool, feedback: str) -> str:
    """Feedback (HTML) on an answer: a word first, not only a colour."""
    word = "✓ Right." if right else "✗ Not yet."
    return f'<div class="{"good" if right else "bad"}" role="status"><b>{word}</b> {feedback}</div>'


def problem(sentence: str) -> str:
    return f'<div class="bad" role="alert"><b>▲ {escape(sentence)}</b></div>' if sentence else ""


def figure(value: float | bool | str | None, unit: str = "") -> str:
    """A fact as people read it, as HTML."""
    if value is None or value != value:
        return "nothing yet"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return escape(value) or "nothing"
    digits = f"{value:.4g}".replace("-", "\N{MINUS SIGN}")
    return f"{digits}{f' {escape(unit)}' if unit else ''}"
