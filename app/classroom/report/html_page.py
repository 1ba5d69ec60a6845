"""A report as one HTML file that needs nothing else."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from app.classroom.report.chart import chart_svg
from app.classroom.report.data import Answer, LessonReport, Report, StepReport
from app.classroom.report.words import duration, effort, figures, heading, when

_STYLE = """
:root { color-scheme: light; --ink: #26262e; --faint: #5f6470; --line: #dcdfe5; --good: #00674b; --bad: #a33b00; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 32px 24px 64px; max-width: 860px; color: var(--ink); background: #fff;
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; }
h1 { font-size: 26px; line-height: 1.2; margin: 0 0 4px; }
h2 { font-size: 20px; margin: 40px 0 2px; padding-top: 16px; border-top: 2px solid var(--ink); }
h3 { font-size: 16px; margin: 0; }
p { margin: 0; }
.faint { color: var(--faint); }
.figures { display: flex; flex-wrap: wrap; gap: 12px; margin: 20px 0 0; padding: 0; }
.figures div { flex: 1 1 140px; border: 1px solid var(--line); border-radius: 8px; padding: 10px 14px; }
.figures dt { color: var(--faint); font-size: 13px; }
.figures dd { margin: 0; font-size: 20px; font-weight: 600; }
article { border: 1px solid var(--line); border-radius: 8px; padding: 14px 16px; margin: 14px 0; break-inside: avoid; }
header { display: flex; justify-content: space-between; gap: 12px; align-items: baseline; flex-wrap: wrap; }
dl.work { display: grid; grid-template-columns: 96px 1fr; gap: 6px 12px; margin: 10px 0 0; }
dl.work dt { color: var(--faint); }
dl.work dd { margin: 0; min-width: 0; }
.row { display: grid; grid-template-columns: 1.4em 1fr; }
.right::before, .wrong::before { font-weight: 700; }
.right::before { content: "✓"; color: var(--good); }
.wrong::before { content: "✗"; color: var(--bad); }
.open::before { content: "○"; color: var(--faint); }
.done { color: var(--good); font-weight: 600; }
figure { margin: 14px 0 0; }
figure svg { width: 100%; max-width: 640px; height: auto; display: block; }
table { border-collapse: collapse; } td, th { border: 1px solid var(--line); padding: 2px 8px; }
@media print { body { padding: 0; font-size: 12px; } }
"""


def report_html(report: Report) -> str:
    """The report as a page; whatever a student typed is text in it."""
    title = escape(heading(report))
    boxes = "".join(f"<div><dt>{escape(name)}</dt><dd>{escape(value)}</dd></div>" for name, value in figures(report))
    lessons = "".join(map(_lesson, report.lessons)) or "<h2>No lesson was opened yet</h2>"
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{title}</title><style>{_STYLE}</style></head><body>"
        f'<h1>{title}</h1><p class="faint">{escape(when(report))}</p><dl class="figures">{boxes}</dl>'
        f"{lessons}</body></html>\n"
    )


def _lesson(lesson: LessonReport) -> str:
    line = f"{lesson.done} of {lesson.steps_of} steps done, {duration(lesson.seconds)}"
    steps = "".join(map(_step, lesson.steps))
    return f'<section><h2>{escape(lesson.title)}</h2><p class="faint">{escape(line)}</p>{steps}</section>'


def _step(step: StepReport) -> str:
    state = '<span class="done">done</span>' if step.done else "open"
    top = f'<h3>{step.number}. {escape(step.title)}</h3><span class="faint">{state}, {escape(effort(step))}</span>'
    plots = "".join(f"<figure>{chart_svg(plot)}</figure>" for plot in step.plots)
    return f"<article><header>{top}</header>{_work(step)}{plots}</article>"


def _work(step: StepReport) -> str:
    prediction = [] if step.prediction is None else [step.prediction]
    groups = [
        ("Prediction", _answers(prediction)),
        ("Task", "".join(_row("right" if check.met else "open", check.text) for check in step.checks)),
        ("Answer" if len(step.answers) == 1 else "Answers", _answers(step.answers)),
        ("One more", _answers(step.more)),
    ]
    rows = "".join(f"<dt>{name}</dt><dd>{content}</dd>" for name, content in groups if content)
    return f'<dl class="work">{rows}</dl>' if rows else ""


def _answers(answers: Iterable[Answer]) -> str:
    return "".join(_row("right" if answer.right else "wrong", answer.text) for answer in answers)


def _row(kind: str, markdown: str) -> str:
    from app.classroom.lessons.render import to_html  # loads the Markdown parser

    said = {"right": "right", "wrong": "not right", "open": "open"}[kind]
    return f'<div class="row {kind}" title="{said}"><div>{to_html(markdown)}</div></div>'
