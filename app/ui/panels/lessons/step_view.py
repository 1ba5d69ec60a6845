"""One step on the page, as stretches of HTML that are sent only when they change."""

from __future__ import annotations

from pathlib import Path

from app.classroom.lessons.lesson import Lesson
from app.classroom.lessons.render import to_html
from app.ui.lessons.open_step import OpenStep
from app.ui.lessons.standing import Dot, Phase, Standing
from app.ui.panels.lessons.checks_view import astray_warning, check_list
from app.ui.panels.lessons.markup import button, card, escape, problem, row
from app.ui.panels.lessons.question_view import answered, asked, feedback

STAGES = ("Hint 1: a question", "Hint 2: a hint", "Hint 3: the worked step")
_WORDS: dict[Dot, str] = {"done": "done", "here": "you are here", "open": "open", "locked": "locked"}


def head(lesson: Lesson, dots: tuple[tuple[Standing, Dot], ...], extra: str = "") -> str:
    """Title and the row of steps; `extra` stands at the right."""
    title = f'<h2 data-lesson-top tabindex="-1">{lesson.number} · {escape(lesson.title)}</h2>'
    top = row(button("list", "‹ All lessons", tone="quiet"), f'<span class="far">{extra}</span>')
    steps = "".join(f"<li>{_dot(lesson, standing, dot)}</li>" for standing, dot in dots)
    return f'{top}{title}<ol class="dots" aria-label="Steps">{steps}</ol>'


def introduction(lesson: Lesson) -> str:
    """Before the first step."""
    folder = lesson.path.parent
    goals = "".join(f"<li>{to_html(goal)}</li>" for goal in lesson.goals)
    aims = f"<p><b>You will learn to</b></p><ul>{goals}</ul>" if goals else ""
    return f"<small>About {lesson.minutes:g} minutes</small>{to_html(lesson.intro, folder=folder)}{aims}"


def text(step: OpenStep, *, instructor: bool) -> str:
    """What the step is about."""
    shown, folder = step.step, _folder(step)
    parts = [introduction(step.lesson)] if shown.number == 1 else []
    count = len(step.lesson.steps)
    parts.append(f"<h3>{escape(shown.title)}</h3><small>Step {shown.number} of {count} · {shown.minutes:g} min</small>")
    parts.append(to_html(shown.text, folder=folder))
    if shown.safety:
        parts.append(f'<div class="warn"><b>⚠ Safety</b>{to_html(shown.safety, folder=folder)}</div>')
    if instructor and shown.notes:
        parts.append(f'<div class="note"><b>For the instructor</b>{to_html(shown.notes, folder=folder)}</div>')
    return "".join(parts)


def predict(step: OpenStep) -> str:
    question, standing = step.step.predict, step.standing
    if question is None:
        return ""
    title, folder = "Predict: before you try", _folder(step)
    if standing.phase == "predict":
        return card(title, asked(question, "predict", folder, "This is my guess"), "now")
    prediction = standing.work.prediction
    grade = question.grade(prediction) if standing.shows_prediction and prediction is not None else None
    later = "" if grade is not None else "<small>You will see whether it holds.</small>"
    return card(title, answered(question, prediction, grade, folder) + later)


def act(step: OpenStep) -> str:
    """What to do; the check marks are a stretch of their own below it."""
    if step.step.act is None:
        return ""
    if step.standing.phase == "predict":
        return card("Act", "<small>After your guess: then you try it on the robot.</small>", "later")
    tone = "now" if step.standing.phase == "act" else ""
    return card("Act: try it on the robot", to_html(step.step.act.text, folder=_folder(step)), tone)


def checks(step: OpenStep) -> str:
    if step.step.act is None or step.standing.phase == "predict":
        return ""
    passed = step.standing.work.acted
    marks = check_list(step.step.act.checks, step.examiner.verdicts, advised=step.advised, passed=passed)
    if passed:
        return f'{marks}<div class="good" role="status"><b>✓ Done.</b> Your robot shows it.</div>'
    buttons = row(button("check", "Check: what is missing?"), button("setup", "Set up again", tone="quiet"))
    return marks + astray_warning(step.examiner.astray) + buttons


def explain(step: OpenStep) -> str:
    question, standing = step.step.explain, step.standing
    if question is None:
        return ""
    folder = _folder(step)
    if _comes_later(standing.phase):
        return card("Explain", "<small>After the act.</small>", "later")
    if standing.phase != "explain":
        return card("Explain", answered(question, standing.work.answer, step.grade, folder))
    told = feedback(step.grade, folder) if step.grade is not None else ""
    return card("Explain: what does it mean?", asked(question, "explain", folder) + told, "now")


def more(step: OpenStep) -> str:
    """The extra problem, once the step is done."""
    question, standing = step.step.more, step.standing
    if question is None or standing.phase != "done":
        return ""
    folder = _folder(step)
    if step.more_grade is not None and step.more_grade.right:
        content = answered(question, step.more_answer, step.more_grade, folder)
    elif standing.work.more_right and step.more_answer is None:
        content = answered(question, None, None, folder) + "<p><b>✓ You have solved it.</b></p>"
    else:
        content = asked(question, "more", folder)
        content += feedback(step.more_grade, folder) if step.more_grade is not None else ""
    return card("One more: if you like", content)


def helps(step: OpenStep, *, asking: bool) -> str:
    """Hints taken so far, the way to the next, and common errors. `asking`: whether it is to be counted."""
    shown, folder = step.step, _folder(step)
    taken = step.standing.work.hints
    parts = [
        card(title, to_html(hint, folder=folder))
        for title, hint in zip(STAGES[:taken], shown.hints[:taken], strict=True)
    ]
    if taken < len(shown.hints):
        parts.append(_next_hint(taken, asking=asking))
    if shown.errors:
        errors = to_html(shown.errors, folder=folder)
        parts.append(f"<details><summary>Common errors</summary>{errors}</details>")
    return "".join(parts)


def foot(step: OpenStep, why_not_next: str, trouble: str) -> str:
    """The way back and on."""
    number, count = step.step.number, len(step.lesson.steps)
    label = "Next step" if number < count else "Finish the lesson"
    back = button("back", "Back", tone="quiet") if number > 1 else ""
    on = button("next", label, tone="main", why_not=why_not_next)
    reason = f"<small>{escape(why_not_next)}</small>" if why_not_next else ""
    again = ""
    if step.standing.phase == "done":
        place = f"{step.lesson.key} {number}"
        again = button("redo", "Try again with new numbers", place, tone="quiet")
    return problem(step.problem or trouble) + row(back, f'<span class="far">{reason}</span>', on) + row(again)


def _next_hint(taken: int, *, asking: bool) -> str:
    if not asking:
        return row(button("hint", f"I need a hint ({taken + 1} of {len(STAGES)})", tone="quiet"))
    question = f"<p>{STAGES[taken]}. Hints are counted: your report and your instructor see them.</p>"
    return card("Take it?", question + row(button("hint-yes", "Show the hint"), button("hint-no", "Not now")))


def _comes_later(phase: Phase) -> bool:
    return phase in ("predict", "act")


def _dot(lesson: Lesson, standing: Standing, dot: Dot) -> str:
    step = standing.step
    label = f"Step {step.number}, {step.title}: {_WORDS[dot]}"
    face = f"✓{step.number}" if standing.done else str(step.number)
    extra = ' aria-current="step"' if dot == "here" else ' aria-disabled="true"' if dot == "locked" else ""
    tone = "done" if dot == "open" and standing.done else dot
    return (
        f'<button type="button" class="{tone}" data-lesson="go" data-value="{step.number}"{extra} '
        f'aria-label="{escape(label)}" title="{escape(label)}">{face}</button>'
    )


def _folder(step: OpenStep) -> Path:
    return step.lesson.path.parent
