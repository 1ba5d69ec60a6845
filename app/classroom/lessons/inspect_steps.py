"""What belongs together in a lesson: sections that need each other, right and wrong solutions, minutes, safety."""

from __future__ import annotations

import math
from pathlib import Path

from app.classroom.lessons.catalogue import namespace
from app.classroom.lessons.lesson import Lesson, Play, Press, Question, Relation, Set, Step
from app.classroom.lessons.mistake import Complaints, nearest

MINUTES_OFF = 5
MOVES_HARDWARE = frozenset({"home_robot", "jog", "run_drawing", "run_run", "mirror", "test"})
"""Actions that move the robot on the table."""

STEPS = (4, 8)


def inspect_lesson(lesson: Lesson, complaints: Complaints) -> None:
    """Complain about what does not fit together."""
    total = sum(step.minutes for step in lesson.steps)
    if lesson.steps and abs(total - lesson.minutes) > MINUTES_OFF:
        complaints.add(
            1, f"The steps take {total:g} minutes together, but the lesson {lesson.minutes:g}: change one of them."
        )
    for needed in lesson.needs:
        _complain_needed(needed, lesson.path, complaints)
    for step in lesson.steps:
        _inspect_sections(step, complaints)
        _inspect_answers(step, complaints)
        _inspect_hardware(step, lesson, complaints)


def note_length(lesson: Lesson, complaints: Complaints) -> None:
    """Not wrong, but worth a look."""
    if not STEPS[0] <= len(lesson.steps) <= STEPS[1]:
        complaints.note(1, f"A lesson has {STEPS[0]} to {STEPS[1]} steps; this one has {len(lesson.steps)}.")


def _complain_needed(needed: str, path: Path, complaints: Complaints) -> None:
    if not (path.parent / f"{needed}.md").is_file():
        known = [other.stem for other in path.parent.glob("[0-9][0-9]-*.md")]
        complaints.add(1, f"needs lists {needed}, and there is no such lesson: {nearest(needed, known)}")


def _inspect_sections(step: Step, complaints: Complaints) -> None:
    if not (step.predict or step.act or step.explain):
        complaints.add(step.line, "This step asks for nothing: it needs Predict, Act or Explain.")
    if not (step.act or step.explain):
        return
    missing = {
        "Hints": not step.hints and not _complained(step, "Hints", complaints),
        "Solution": step.solution is None,
        "Wrong solution": step.wrong is None,
    }
    for title in (title for title, absent in missing.items() if absent):
        complaints.add(step.line, f"This step has no section {title}: add ### {title}.")


def _complained(step: Step, title: str, complaints: Complaints) -> bool:
    """Whether a section is there, but was complained about."""
    return any(mistake.line > step.line and mistake.reason.startswith(title) for mistake in complaints.found)


def _inspect_answers(step: Step, complaints: Complaints) -> None:
    for name in ("predict", "explain", "more"):
        question: Question | None = getattr(step, name)
        if step.solution is not None:
            _inspect_answer(name, question, step.solution, True, complaints)
        if step.wrong is not None:
            _inspect_answer(name, question, step.wrong, False, complaints)


def _inspect_answer(name: str, question: Question | None, play: Play, right: bool, complaints: Complaints) -> None:
    title = "Solution" if right else "Wrong solution"
    answer: float | None = getattr(play, name)
    if question is None:
        if answer is not None:
            complaints.add(play.line, f"{title} answers {name}, but this step does not ask it.")
    elif answer is None:
        if right or name == "explain":
            complaints.add(play.line, f"{title} needs {name} = ..., the {'right' if right else 'a wrong'} answer.")
    elif _is_graded(question, answer) and question.grade(answer).right != right and (right or name != "predict"):
        verdict = "wrong" if right else "right"
        complaints.add(play.line, f"{title} gives {answer:g} for {name}, which is judged {verdict}.")


def _is_graded(question: Question, answer: float) -> bool:
    """Not where numbers are still unknown, or options were complained about."""
    if question.number is not None:
        return not (math.isnan(answer) or math.isnan(question.number.answer) or math.isnan(question.number.within))
    return bool(question.choices) and not math.isnan(answer)


def _inspect_hardware(step: Step, lesson: Lesson, complaints: Complaints) -> None:
    deeds = [deed for play in (step.solution, step.wrong) if play for deed in play.deeds]
    moves = [deed.name for deed in deeds if isinstance(deed, Press) and deed.name in MOVES_HARDWARE]
    if moves and not step.safety:
        complaints.add(step.line, f"The robot on the table moves in this step ({moves[0]}): add ### Safety.")
    names = [deed.fact for deed in deeds if isinstance(deed, Set)] + [setting.fact for setting in step.settings]
    if step.act:
        names += [check.fact for check in step.act.checks]
        bounds = [bound for check in step.act.checks for bound in (check.at_least, check.at_most)]
        names += [bound.fact for bound in bounds if isinstance(bound, Relation)]
    if (moves or any(namespace(name) == "link" for name in names)) and not lesson.hardware:
        complaints.add(step.line, "This step uses the robot on the table: write hardware = true in the front matter.")
