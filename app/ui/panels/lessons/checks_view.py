"""The check marks of an act as HTML; a few are sent four times a second while a student drags."""

from __future__ import annotations

from collections.abc import Sequence

from app.classroom.lessons.catalogue import fact_kind
from app.classroom.lessons.check import Verdict
from app.classroom.lessons.lesson import Check
from app.classroom.lessons.render import to_html
from app.ui.panels.lessons.markup import button, escape, figure, row


def check_list(checks: Sequence[Check], verdicts: Sequence[Verdict], *, advised: bool, passed: bool) -> str:
    """Each with a mark, a word and its value now; `advised`: with what is missing, too."""
    items = "".join(
        _item(check, verdict._replace(met=True) if passed else verdict, advised=advised, live=not passed)
        for check, verdict in zip(checks, verdicts, strict=True)
    )
    return f'<ul class="checks">{items}</ul>'


def astray_warning(facts: Sequence[str]) -> str:
    """What was changed though it belongs to the task."""
    if not facts:
        return ""
    names = ", ".join(escape(_words(fact)) for fact in facts)
    return (
        f'<div class="bad" role="status"><b>Changed, though it belongs to the task:</b> {names}. '
        f"Nothing counts until it is as it was.{row(button('setup', 'Set up again', tone='main'))}</div>"
    )


def _item(check: Check, verdict: Verdict, *, advised: bool, live: bool) -> str:
    mark, word, tone = ("✓", "done", "met") if verdict.met else ("○", "open", "open")
    now = f' · now <span class="num">{figure(verdict.value, check.unit)}</span>' if live else ""
    parts = [to_html(verdict.says), f'<small><span class="word">{word}</span>{now}</small>']
    if verdict.met and check.why:
        parts.append(f"<small>{to_html(check.why)}</small>")
    if advised and not verdict.met and verdict.advice:
        parts.append(f'<div class="tip">{to_html(verdict.advice)}</div>')
    return f'<li class="{tone}"><span class="mark" aria-hidden="true">{mark}</span><div>{"".join(parts)}</div></li>'


def _words(fact: str) -> str:
    kind = fact_kind(fact)
    return kind.text if kind is not None else fact
