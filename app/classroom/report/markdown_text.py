"""A report as Markdown."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterator

from app.classroom.report.chart import chart_svg
from app.classroom.report.data import Answer, Report, StepReport
from app.classroom.report.words import duration, effort, figures, heading, when

_SPECIAL = re.compile(r"([\\`*_{}\[\]()<>#+.!|$~&-])")


def report_markdown(report: Report) -> str:
    """The report as one file; its plots are inside."""
    return "\n".join(_lines(report)) + "\n"


def escaped(text: str) -> str:
    """Plain text that Markdown leaves as it is."""
    return _SPECIAL.sub(r"\\\1", text)


def _lines(report: Report) -> Iterator[str]:
    yield from [f"# {escaped(heading(report))}", "", escaped(when(report)), ""]
    names, values = zip(*figures(report), strict=True)
    yield from [f"| {' | '.join(names)} |", f"|{' --- |' * len(names)}", f"| {' | '.join(values)} |", ""]
    if not report.lessons:
        yield "No lesson was opened yet."
    for lesson in report.lessons:
        yield f"## {lesson.title}"
        yield from ["", f"{lesson.done} of {lesson.steps_of} steps done, {duration(lesson.seconds)}.", ""]
        for step in lesson.steps:
            yield from _step(step)


def _step(step: StepReport) -> Iterator[str]:
    yield from [f"### {step.number}. {step.title} ({'done' if step.done else 'open'})", "", f"{effort(step)}.", ""]
    items = list(_items(step))
    yield from [*items, ""] if items else []
    for plot in step.plots:
        image = base64.b64encode(chart_svg(plot).encode()).decode()
        title = escaped(str(plot.get("title", ""))).replace("\n", " ")
        yield from [f"![{title}](data:image/svg+xml;base64,{image})", ""]


def _items(step: StepReport) -> Iterator[str]:
    if step.prediction is not None:
        yield f"- Prediction: {_answer(step.prediction)}"
    for check in step.checks:
        yield f"- [{'x' if check.met else ' '}] {_one_line(check.text)}"
    for number, answer in enumerate(step.answers, 1):
        yield f"- Answer {number}: {_answer(answer)}"
    for answer in step.more:
        yield f"- One more: {_answer(answer)}"


def _answer(answer: Answer) -> str:
    return f"{_one_line(answer.text)} ({'right' if answer.right else 'not right'})"


def _one_line(markdown: str) -> str:
    return " ".join(markdown.split())
