"""From what a student did to a report, with the words of the lessons as he has seen them."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from app.classroom.classroom import Classroom
from app.classroom.lessons.course import Course
from app.classroom.lessons.lesson import Lesson, Question, Step
from app.classroom.lessons.mistake import LessonMistake
from app.classroom.outline import step_outline
from app.classroom.people import Member
from app.classroom.progress import Place
from app.classroom.report.data import Answer, CheckMark, LessonReport, Report, StepReport
from app.classroom.report.deeds import Deeds, Try, deeds_of
from app.classroom.step_progress import StepProgress

Lessons = Callable[[str, int], Lesson | None]
"""A lesson by its key and a seed; None where it is broken or gone."""


def report_of(classroom: Classroom, member: Member, course: Course) -> Report:
    """The report of a member, here and now; it may take as long as his lessons take to compute."""
    return report_from(deeds_of(classroom, member), lessons_in(course))


def lessons_in(course: Course) -> Lessons:
    """The lessons of a course."""

    def find(key: str, seed: int) -> Lesson | None:
        try:
            return course.lesson(key, seed) if key in course.files else None
        except LessonMistake:
            return None  # the course lists it as broken

    return find


def report_from(deeds: Deeds, lessons: Lessons) -> Report:
    """Every lesson of which a step was opened, in the order of the course."""
    places = sorted(place for place in deeds.progress.steps if place[0])
    keys = dict.fromkeys(key for key, _ in places)
    found = (_lesson(deeds, key, [place for place in places if place[0] == key], lessons) for key in keys)
    steps_of = sum(map(len, deeds.outline.values()))
    return Report(deeds.name, deeds.class_name, deeds.made_at, tuple(found), steps_of)


def _lesson(deeds: Deeds, key: str, places: list[Place], lessons: Lessons) -> LessonReport:
    as_seen = {place: lessons(key, deeds.seed_at(place)) for place in places}
    title = next((lesson.title for lesson in as_seen.values() if lesson is not None), key)
    steps = tuple(_step(deeds, place, _step_of(as_seen[place], place[1])) for place in places)
    return LessonReport(key, title, steps, len(deeds.outline.get(key, ())) or len(steps))


def _step_of(lesson: Lesson | None, number: int) -> Step | None:
    return lesson.steps[number - 1] if lesson is not None and 1 <= number <= len(lesson.steps) else None


def _step(deeds: Deeds, place: Place, step: Step | None) -> StepReport:
    work = deeds.progress.of(*place)
    outline = step_outline(deeds.outline, *place)
    return StepReport(
        place[1],
        step.title if step is not None else outline.title or f"Step {place[1]}",
        work.done(outline),
        _prediction(work, step.predict if step is not None else None),
        _checks(work, step),
        _answers(deeds.tries.get(place, ()), step.explain if step is not None else None),
        _answers(deeds.more.get(place, ()), step.more if step is not None else None),
        work.hints,
        work.attempt,
        work.seconds,
        deeds.plots.get(place, ()),
    )


def _prediction(work: StepProgress, question: Question | None) -> Answer | None:
    if not work.predicted or work.prediction is None or question is None:
        return None
    return Answer(in_words(work.prediction, question), question.grade(work.prediction).right)


def _checks(work: StepProgress, step: Step | None) -> tuple[CheckMark, ...]:
    if step is None or step.act is None:
        return ()
    checks = enumerate(step.act.checks)
    return tuple(CheckMark(check.says, work.acted or number in work.checks) for number, check in checks)


def _answers(tries: Iterable[Try], question: Question | None) -> tuple[Answer, ...]:
    return tuple(Answer(in_words(answer, question), right) for answer, right in tries)


def in_words(answer: float | None, question: Question | None) -> str:
    """An answer as the question words it."""
    if answer is None:
        return "no number"
    if question is not None and question.number is not None:
        return f"{answer:.6g} {question.number.unit}".rstrip()
    if question is not None and float(answer).is_integer() and 1 <= answer <= len(question.choices):
        return question.choices[int(answer) - 1].text
    return f"{answer:.6g}"
