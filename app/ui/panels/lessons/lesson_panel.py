"""The panel `Lesson`: a list of the course, or one step. Stretches of HTML, each sent only when it changes."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

import viser

from app.errors import UserMistake
from app.ui.lessons.answers import read_answer
from app.ui.lessons.desk import LessonDesk
from app.ui.panels.lessons import list_view, step_view
from app.ui.panels.lessons.markup import block, button
from app.ui.panels.lessons.style import STYLE
from app.ui.panels.lessons.wire import LessonWire

STRETCHES = ("head", "text", "predict", "act", "checks", "explain", "more", "helps", "foot")


class LessonPanel:
    """Shows a desk, and passes on what is pressed."""

    def __init__(
        self, client: viser.ClientHandle, desk: LessonDesk, wire: LessonWire, save_report: Callable[[str], None]
    ) -> None:
        """`save_report` takes `html` or `md`."""
        self._client = client
        self._desk = desk
        self._wire = wire
        self._save_report = save_report
        self._asking_hint = False
        self._due = False
        self._place = desk.place
        client.gui.add_html(STYLE)
        self._stretches = {name: client.gui.add_html("") for name in STRETCHES}
        desk.changed.connect(lambda _: self._soon())
        desk.marked.connect(lambda _: self._show_marks())
        self.show()

    def hear(self, what: str, value: str) -> None:
        """Something was pressed on the page, or says so: everything is checked by the desk."""
        deed = self._deeds().get(what)
        if deed is None:
            return
        try:
            deed(value)
        except UserMistake as mistake:
            self._desk.problem = str(mistake)
            self._soon()

    def show(self) -> None:
        """Bring the page up to date."""
        shown = self._content()
        for name, stretch in self._stretches.items():
            self._put(stretch, block(shown.get(name, "")))
        if self._place != self._desk.place:
            self._place = self._desk.place
            self._asking_hint = False
            self._wire.scroll_to_top()
        self._client.flush()

    def _deeds(self) -> dict[str, Callable[[str], None]]:
        desk = self._desk
        return {
            "open": lambda key: desk.go(desk.map.find(key)),
            "go": lambda number: desk.go(desk.place[0], _whole(number)),
            "next": lambda _: desk.next(),
            "back": lambda _: desk.back(),
            "list": lambda _: desk.leave(),
            "redo": self._redo,
            "predict": lambda typed: self._answer("predict", typed),
            "explain": lambda typed: self._answer("explain", typed),
            "more": lambda typed: self._answer("more", typed),
            "check": lambda _: desk.open_step and desk.open_step.ask(),
            "setup": lambda _: desk.open_step and desk.open_step.set_up_again(),
            "hint": lambda _: self._ask_hint(True),
            "hint-no": lambda _: self._ask_hint(False),
            "hint-yes": self._take_hint,
            "report": self._save_report,
            "hand": self._raise_hand,
        }

    def _answer(self, what: str, typed: str) -> None:
        step = self._desk.open_step
        if step is None:
            return
        question, deed = {
            "predict": (step.step.predict, step.predict),
            "explain": (step.step.explain, step.explain),
            "more": (step.step.more, step.answer_more),
        }[what]
        if question is not None:
            self._desk.problem = ""
            deed(read_answer(question, typed))

    def _redo(self, place: str) -> None:
        key, _, number = place.rpartition(" ")
        self._desk.redo(self._desk.map.find(key), _whole(number))

    def _ask_hint(self, asking: bool) -> None:
        self._asking_hint = asking
        self._soon()

    def _take_hint(self, _: str) -> None:
        if self._asking_hint and self._desk.open_step is not None:
            self._asking_hint = False
            self._desk.open_step.take_hint()

    def _raise_hand(self, _: str) -> None:
        classroom, browser = self._desk.map.classroom, self._desk.map.browser
        if self._desk.map.progress.hand_since is None:
            classroom.raise_hand(browser)
        else:
            classroom.lower_hand(browser)

    def _soon(self) -> None:
        """Once, whatever changes in this turn of the event loop."""
        if not self._due:
            self._due = True
            asyncio.get_running_loop().call_soon(self._show_due)

    def _show_due(self) -> None:
        self._due = False
        self.show()

    def _show_marks(self) -> None:
        step = self._desk.open_step
        if step is not None:
            self._put(self._stretches["checks"], block(step_view.checks(step)))
            self._client.flush()

    def _put(self, stretch: viser.GuiHtmlHandle, content: str) -> None:
        if stretch.content != content:
            stretch.content = content

    def _content(self) -> dict[str, str]:
        desk, extra = self._desk, self._hand()
        if desk.map.library.course is None:
            return {"text": list_view.loading()}
        if desk.lesson is None:
            shown = {"text": list_view.course(desk.map, desk.problem), "foot": list_view.mine(desk.map, extra)}
            return {"head": list_view.preparing(), **shown} if desk.fetching else shown
        dots = desk.map.dots(desk.place[0], desk.place[1])
        head = step_view.head(desk.lesson, dots, extra)
        if desk.open_step is None:
            return {"head": head, "text": list_view.end(desk.map, desk.lesson, desk.problem)}
        return {"head": head, **self._step()}

    def _step(self) -> dict[str, str]:
        desk = self._desk
        step, member = desk.open_step, desk.map.member
        assert step is not None
        return {
            "text": step_view.text(step, instructor=member is not None and member.instructor),
            "predict": step_view.predict(step),
            "act": step_view.act(step),
            "checks": step_view.checks(step),
            "explain": step_view.explain(step),
            "more": step_view.more(step),
            "helps": step_view.helps(step, asking=self._asking_hint),
            "foot": step_view.foot(step, desk.why_not_next, desk.problem),
        }

    def _hand(self) -> str:
        """The way to call the instructor; nobody comes to who works alone."""
        member = self._desk.map.member
        if not self._desk.map.classroom.in_class or member is None or member.instructor:
            return ""
        raised = self._desk.map.progress.hand_since is not None
        label = "✋ Hand is up: lower it" if raised else "✋ Raise hand"
        return button("hand", label, hint="Your instructor sees it on the board")


def _whole(text: str) -> int:
    """A step's number; 0, which is none, for anything else."""
    return int(text) if text.isascii() and text.isdigit() and len(text) < 4 else 0
