"""A report made by a worker."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from app.classroom.report.build import lessons_in, report_from
from app.classroom.report.deeds import Deeds
from app.classroom.report.html_page import report_html
from app.classroom.report.markdown_text import report_markdown


def report_text(deeds: Deeds, lessons: Path, kind: Literal["html", "markdown"]) -> str:
    """The report as a file's text; `lessons` is the folder of the course."""
    from app.classroom.lessons.course import Course

    report = report_from(deeds, lessons_in(Course(lessons)))
    return report_html(report) if kind == "html" else report_markdown(report)
