"""Figures of a report as people read them."""

from __future__ import annotations

import time

from app.classroom.report.data import Report, StepReport


def duration(seconds: float) -> str:
    """In minutes, from an hour on with hours."""
    if 0.0 < seconds < 60.0:
        return "under 1 min"
    minutes = round(seconds / 60.0)
    return f"{minutes} min" if minutes < 60 else f"{minutes // 60} h {minutes % 60:02d} min"


def heading(report: Report) -> str:
    return f"{report.name}: report on parallel robots"


def when(report: Report) -> str:
    """The class and the day."""
    day = time.strftime("%d %B %Y", time.localtime(report.made_at)).lstrip("0")
    return f"{report.class_name}, {day}" if report.class_name else day


def figures(report: Report) -> list[tuple[str, str]]:
    """What stands at the top: a name and a figure each."""
    right, tried = report.first_tries
    return [
        ("steps done", f"{report.done} of {max(report.steps_of, report.done)}"),
        ("right at the first try", f"{right} of {tried}"),
        ("hints", str(report.hints)),
        ("time", duration(report.seconds)),
    ]


def effort(step: StepReport) -> str:
    """Time, hints and attempts of a step in one line."""
    parts = [duration(step.seconds)]
    if step.hints:
        parts.append("1 hint" if step.hints == 1 else f"{step.hints} hints")
    if step.attempts > 1:
        parts.append(f"attempt {step.attempts}")
    return ", ".join(parts)
