"""One step that a student works on: answers, the watched act, hints. No widgets here."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from app.classroom import events
from app.classroom.lessons.lesson import Grade, Lesson, Question, Step, Value
from app.classroom.step_progress import StepProgress
from app.errors import UserMistake
from app.signal import Signal
from app.ui.lessons.examiner import Examiner
from app.ui.lessons.pulse import Pulse
from app.ui.lessons.setting_up import is_set_up, set_up
from app.ui.lessons.standing import Standing

LOOK_EVERY_S = 0.25


class Apparatus(Protocol):
    """The robot and the tabs of a student's page, as lessons see them."""

    changed: Signal[Any]
    """Something may have changed."""

    @property
    def busy(self) -> bool: ...

    def value(self, fact: str) -> Value | None: ...

    def set(self, fact: str, value: Value) -> None: ...

    def evidence(self, step: Step) -> Sequence[Any]: ...


class Notebook(Protocol):
    """Where a student's work in this step is written down."""

    @property
    def work(self) -> StepProgress: ...

    def record(self, event: events.Event) -> None:
        """Saved when it returns.

        Raises:
            UserMistake: it is not.
        """
        ...


class OpenStep:
    """Predict, act, explain, in this order, with what helps."""

    def __init__(
        self,
        lesson: Lesson,
        step: Step,
        notebook: Notebook,
        apparatus: Apparatus,
        changed: Callable[[], None],
        marked: Callable[[], None],
    ) -> None:
        """`changed` is called when the page says something else, `marked` when only check marks do."""
        self.lesson = lesson
        self.step = step
        self.problem = ""
        """Why something could not be done; a sentence."""
        self.advised = False
        """Whether the student has asked what is missing."""
        self.more_answer: float | None = None
        """To the extra problem, given on this page."""
        self._notebook = notebook
        self._apparatus = apparatus
        self._changed = changed
        self._marked = marked
        self._examiner = Examiner(apparatus, step)
        self._pulse = Pulse(self.look, LOOK_EVERY_S)
        self._hush: Callable[[], None] = lambda: None

    @property
    def standing(self) -> Standing:
        return Standing(self.step, self._notebook.work)

    @property
    def examiner(self) -> Examiner:
        return self._examiner

    @property
    def grade(self) -> Grade | None:
        """Of the last answer to the question after the act."""
        return _grade(self.step.explain, self.standing.work.answer)

    @property
    def more_grade(self) -> Grade | None:
        return _grade(self.step.more, self.more_answer)

    def begin(self, *, come_back: bool = False) -> None:
        """Set everything up, and watch. Who only comes back keeps what is there, as far as it is still the task."""
        if not (come_back and is_set_up(self._apparatus, self.lesson, self.step)):
            self.problem = set_up(self._apparatus, self.lesson, self.step)
        self._watch()

    def set_up_again(self) -> None:
        self.problem = set_up(self._apparatus, self.lesson, self.step)
        self._watch()
        self._changed()

    def exchange(self, lesson: Lesson, step: Step) -> None:
        """The lesson's author has changed it meanwhile."""
        self.lesson, self.step = lesson, step
        self._watch()

    def close(self) -> None:
        self._hush()
        self._pulse.stop()

    def predict(self, answer: float) -> None:
        if self.standing.phase == "predict":
            self._write(events.predicted(self.lesson.key, self.step.number, answer))
            self._pulse.nudge()

    def explain(self, answer: float) -> None:
        if self.standing.phase == "explain" and self.step.explain is not None:
            right = self.step.explain.grade(answer).right
            self._write(events.explained(self.lesson.key, self.step.number, answer, right))

    def answer_more(self, answer: float) -> None:
        if self.standing.phase == "done" and self.step.more is not None:
            right = self.step.more.grade(answer).right
            if self._write(events.more(self.lesson.key, self.step.number, answer, right)):
                self.more_answer = answer

    def take_hint(self) -> None:
        """The next one; it is counted."""
        stage = self.standing.work.hints + 1
        if stage <= len(self.step.hints):
            self._write(events.hint(self.lesson.key, self.step.number, stage))

    def ask(self) -> None:
        """Look now, and say what is missing."""
        self.advised = True
        self.look()
        self._changed()

    def look(self) -> None:
        """Judge the act, as long as it is open."""
        if self.standing.phase != "act":
            return
        before = self._examiner.verdicts, self._examiner.astray
        self._examiner.look()
        self._note_what_is_met()
        if self._examiner.passed:
            self._pass()
        elif self._examiner.wants_another_look:
            self._pulse.nudge()
        if before != (self._examiner.verdicts, self._examiner.astray):
            self._marked()

    def _watch(self) -> None:
        self._hush()
        self._examiner = Examiner(self._apparatus, self.step, self.standing.work.checks)
        self._hush = self._apparatus.changed.connect(lambda _: self._pulse.nudge())
        self._pulse.nudge()

    def _note_what_is_met(self) -> None:
        if self._examiner.astray or self._apparatus.busy:
            return
        for number, verdict in enumerate(self._examiner.verdicts):
            if verdict.met and number not in self.standing.work.checks:
                self._write(events.checked(self.lesson.key, self.step.number, number))

    def _pass(self) -> None:
        evidence = self._apparatus.evidence(self.step)
        if not self._write(events.acted(self.lesson.key, self.step.number, evidence)):
            self._pulse.nudge()  # say, too many things were saved in a second

    def _write(self, event: events.Event) -> bool:
        """Only what is saved is shown."""
        try:
            self._notebook.record(event)
        except UserMistake as refusal:
            self.problem = str(refusal)
        else:
            self.problem = ""
        self._changed()
        return not self.problem


def _grade(question: Question | None, answer: float | None) -> Grade | None:
    return None if question is None or answer is None else question.grade(answer)
