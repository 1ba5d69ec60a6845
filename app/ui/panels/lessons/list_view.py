"""The course as a list, and the end of a lesson, as HTML."""

from __future__ import annotations

from collections.abc import Sequence

from app.classroom.lessons.lesson import Lesson
from app.classroom.lessons.mistake import LessonMistake
from app.classroom.progress import Place
from app.robots import ROBOTS
from app.ui.lessons.course_map import CourseMap
from app.ui.panels.lessons.markup import button, card, escape, problem, row


def course(course_map: CourseMap, trouble: str) -> str:
    """All lessons with how far the student is."""
    library = course_map.library
    whole = {key: _lesson(course_map, file.outline) for key, file in library.files.items()}
    broken = {key: _broken(key, mistake) for key, mistake in library.broken.items()}
    items = "".join(item for _, item in sorted({**whole, **broken}.items()))
    limit = course_map.limit_words()
    note = f"<p><small>{escape(limit)}</small></p>" if limit else ""
    title = '<h2 data-lesson-top style="margin:0">Lessons</h2>'
    close = button("fold", "Explore freely", tone="quiet", hint="Fold the lessons away; they stay at the edge")
    return f"{row(title, f'<span class=far>{close}</span>')}{problem(trouble)}{_go_on(course_map)}{note}{items}"


def loading() -> str:
    return "<h2>Lessons</h2><p>The lessons are being read …</p>"


def preparing() -> str:
    return '<p role="status">Your numbers are being computed …</p>'


def mine(course_map: CourseMap, extra: str) -> str:
    """What belongs to the student: steps to try again, report, own code. `extra` stands among the buttons."""
    member = course_map.member
    if member is None:
        return ""
    parts = [redo(course_map, course_map.redo_list()), row(*reports(), f'<span class="far">{extra}</span>')]
    if member.own_code:
        parts.append(
            f"<details><summary>My place</summary><p>You are {escape(member.name)}. In another browser you go on with "
            f'your own code:</p><p class="code">{escape(member.own_code)}</p></details>'
        )
    elif course_map.classroom.notice:
        parts.append(f"<p><small>{escape(course_map.classroom.notice)}</small></p>")
    return "".join(parts)


def end(course_map: CourseMap, lesson: Lesson, trouble: str) -> str:
    """After the last step."""
    standings = course_map.standings(lesson.key)
    minutes = sum(standing.work.seconds for standing in standings) / 60.0
    asked = [standing for standing in standings if standing.step.explain is not None]
    first = sum(standing.work.first_try_right is True for standing in asked)
    hints = sum(standing.work.hints for standing in standings)
    facts = [f"{max(minutes, 1.0):.0f} minutes", f"{hints} {'hint' if hints == 1 else 'hints'}"]
    if asked:
        facts.insert(1, f"{first} of {len(asked)} questions right at the first try")
    done = f'<div class="good"><b>✓ Lesson {lesson.number} is done.</b> {", ".join(facts)}.</div>'
    again = redo(course_map, course_map.redo_list(lesson.key))
    return problem(trouble) + done + again + row(*reports()) + _what_next(course_map, lesson)


def reports() -> tuple[str, str]:
    """Buttons that save the student's own report."""
    hint = "To keep, to print or to hand in"
    return (
        button("report", "My report", "html", hint=hint),
        button("report", "as Markdown", "md", tone="quiet", hint=hint),
    )


def redo(course_map: CourseMap, places: Sequence[Place]) -> str:
    """Steps that needed the worked hint, or whose first answer was wrong."""
    items = "".join(f"<li>{_step_name(course_map, place)} {_again(place)}</li>" for place in places)
    if not items:
        return ""
    return card(
        "Worth another try", f"<p>These were hard. With new numbers they will stay with you:</p><ul>{items}</ul>"
    )


def _again(place: Place) -> str:
    return button("redo", "Try again with new numbers", f"{place[0]} {place[1]}", tone="quiet")


def _step_name(course_map: CourseMap, place: Place) -> str:
    outline = course_map.library.files[place[0]].outline
    title = outline.steps[place[1] - 1].title if place[1] <= len(outline.steps) else ""
    return f"{outline.number}.{place[1]} {escape(title)}"


def _lesson(course_map: CourseMap, lesson: Lesson) -> str:
    done, count = course_map.share(lesson.key)
    robot = ROBOTS[lesson.robot].title if lesson.robot in ROBOTS else lesson.robot
    words = [f"{lesson.minutes:g} min", escape(robot)]
    if lesson.hardware:
        words.append("robot on the table, or an emulated one")
    words.append("done" if done == count else f"{done} of {count} steps" if done else f"{count} steps")
    mark = "✓" if done == count else str(lesson.number)
    bar = f'<div class="bar"><i style="width:{100.0 * done / count:.0f}%"></i></div>' if done else ""
    return (
        f'<button type="button" class="lesson" data-lesson="open" data-value="{escape(lesson.key)}">'
        f'<span class="nr">{mark}</span><span><b>{escape(lesson.title)}</b>'
        f"<small>{' · '.join(words)}</small>{bar}</span></button>"
    )


def _broken(key: str, mistake: LessonMistake) -> str:
    return (
        f'<div class="lesson broken"><span class="nr">▲</span><span><b>{escape(key)}</b>'
        f"<small>Cannot be read. Line {mistake.line}: {escape(mistake.reason)}</small></span></div>"
    )


def _go_on(course_map: CourseMap) -> str:
    progress = course_map.progress
    if progress.lesson not in course_map.library.files:
        return ""
    step = course_map.present_step(progress.lesson)
    number = course_map.library.files[progress.lesson].outline.number
    return row(button("open", f"Go on: lesson {number}, step {step}", progress.lesson, tone="main"))


def _what_next(course_map: CourseMap, lesson: Lesson) -> str:
    keys = sorted(course_map.library.files)
    after = [key for key in keys if key > lesson.key]
    buttons = [button("back", "Back", tone="quiet"), button("list", "All lessons")]
    if after:
        outline = course_map.library.files[after[0]].outline
        buttons.append(button("open", f"Next: {outline.title}", after[0], tone="main"))
    return row(*buttons)
