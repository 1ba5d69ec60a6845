"""A question as HTML: to be answered, or as it was answered."""

from __future__ import annotations

from pathlib import Path

from app.classroom.lessons.lesson import Grade, Question
from app.classroom.lessons.render import to_html
from app.ui.panels.lessons.markup import escape, figure, verdict


def asked(question: Question, what: str, folder: Path, label: str = "Answer") -> str:
    """A form whose answer goes to the server as `what`."""
    inputs = _options(question, folder) if question.choices else _number_input(question)
    send = f'<div class="row"><button type="submit" class="main">{escape(label)}</button></div>'
    form = f'<form data-lesson="{escape(what)}" autocomplete="off">{inputs}{send}</form>'
    return to_html(question.text, folder=folder) + form


def answered(question: Question, answer: float | None, grade: Grade | None, folder: Path) -> str:
    """The question with what was answered, and what that is worth, if the student may know."""
    parts = [to_html(question.text, folder=folder)]
    if answer is not None:
        parts.append(_given(question, answer, folder))
    if grade is not None:
        parts.append(feedback(grade, folder))
    return "".join(parts)


def feedback(grade: Grade, folder: Path) -> str:
    return verdict(grade.right, to_html(grade.feedback, folder=folder))


def _options(question: Question, folder: Path) -> str:
    rows = (
        f'<label class="option"><input type="radio" name="answer" value="{number}" required>'
        f"<div>{to_html(choice.text, folder=folder)}</div></label>"
        for number, choice in enumerate(question.choices, 1)
    )
    return f'<div role="radiogroup">{"".join(rows)}</div>'


def _number_input(question: Question) -> str:
    unit = question.number.unit if question.number is not None else ""
    label = f"Your answer in {unit}" if unit else "Your answer"
    return (
        f'<div class="row"><input type="text" inputmode="text" name="answer" maxlength="30" required '
        f'aria-label="{escape(label)}" placeholder="a number"><span>{escape(unit)}</span></div>'
    )


def _given(question: Question, answer: float, folder: Path) -> str:
    if question.number is not None:
        return f"<p>Your answer: <b>{figure(answer, question.number.unit)}</b></p>"
    index = int(answer) - 1
    if not 0 <= index < len(question.choices):
        return ""
    text = to_html(question.choices[index].text, folder=folder)
    return f'<small>Your answer:</small><div class="option"><b>●</b><div>{text}</div></div>'
