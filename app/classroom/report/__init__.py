"""A student's own report, to hand in.

`deeds_of` reads what he did; everything after it is a function of plain data, for another process: some lessons take
seconds to compute a student's numbers.
"""

from app.classroom.report.build import report_from, report_of
from app.classroom.report.data import Report
from app.classroom.report.deeds import Deeds, deeds_of
from app.classroom.report.html_page import report_html
from app.classroom.report.job import report_text
from app.classroom.report.markdown_text import report_markdown

__all__ = ["Deeds", "Report", "deeds_of", "report_from", "report_html", "report_markdown", "report_of", "report_text"]
