"""How far the class may go, and a pause for all."""

from __future__ import annotations

import html

import viser

from app.classroom.pace import Pace
from app.ui.classroom.instructor_desk import InstructorDesk
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.classroom.board_table import short_key
from app.ui.panels.text import small

NO_LESSONS = "No lessons"


class PacePanel:
    """The folder `Pace`."""

    def __init__(self, client: viser.ClientHandle, desk: InstructorDesk) -> None:
        self._desk = desk
        gui = client.gui
        with gui.add_folder("Pace"):
            self._said = gui.add_html("")
            self._lesson = gui.add_dropdown("Up to lesson", tuple(self._lessons()))
            self._step = gui.add_dropdown("Up to step", self._steps())
            self._grid = ButtonGrid(client, "Pace", self._do, desk.tell, columns=2)
            self._text = gui.add_text("Said in the pause", "")
        self._leave = desk.classroom.pace_changed.connect(lambda _: self.look())
        self.look()

        @self._lesson.on_update
        async def _(_: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._follow_course()

    def close(self) -> None:
        self._leave()

    def look(self) -> None:
        """Show the pace as it is."""
        self._follow_course()
        pace = self._desk.classroom.pace
        said = small(in_words(pace))
        if said != self._said.content:
            self._said.content = said
        pause = Cell("go_on", "Go on", "The pace before the pause", tone="main")
        if not pace.paused:
            pause = Cell("pause", "Pause", "Students' pages wait, with the words below above all")
        self._grid.show(
            [
                Cell("up_to", "Open up to here", "Students go as fast as they like, up to this step"),
                Cell("all_at", "All to here", "Every page turns to this step, and waits there"),
                Cell("free", "Free", "No limit"),
                pause,
            ]
        )

    def _follow_course(self) -> None:
        """Lessons are read, and written, while this is open."""
        for dropdown, options in ((self._lesson, tuple(self._lessons())), (self._step, self._steps())):
            if dropdown.options != options:
                dropdown.options = options

    def _lessons(self) -> dict[str, str]:
        """What is read -> key."""
        return {titled(key): key for key in self._desk.classroom.outline} or {NO_LESSONS: ""}

    @property
    def _chosen(self) -> str:
        """Key of a lesson; empty where there is none."""
        return self._lessons().get(self._lesson.value, "")

    def _steps(self) -> tuple[str, ...]:
        steps = self._desk.classroom.outline.get(self._chosen, ())
        return tuple(f"{number}. {step.title}" for number, step in enumerate(steps, 1)) or (NO_LESSONS,)

    def _do(self, key: str) -> None:
        desk, classroom, by = self._desk, self._desk.classroom, self._desk.browser
        if key == "go_on":
            desk.do(lambda: classroom.go_on(by))
        elif key == "pause":
            desk.do(lambda: classroom.set_pace(by, "paused", message=self._text.value))
        elif key == "free":
            desk.do(lambda: classroom.set_pace(by, "free"))
        elif key in ("up_to", "all_at") and self._step.value != NO_LESSONS:
            step = int(self._step.value.partition(".")[0])
            desk.do(lambda: classroom.set_pace(by, key, self._chosen, step))


def titled(key: str) -> str:
    """A lesson's key as people read it."""
    number, _, topic = key.partition("-")
    return f"{number} · {topic.replace('-', ' ').capitalize()}" if topic else key


def in_words(pace: Pace) -> str:
    """HTML: what the class may do."""
    if pace.paused:
        return f"<b>Paused.</b> {html.escape(pace.message)}"
    if pace.limit is None:
        return "<b>Free:</b> everybody at their own pace."
    where = f"lesson {html.escape(short_key(pace.lesson))}, step {pace.step}"
    return f"<b>All at</b> {where}." if pace.mode == "all_at" else f"<b>Open up to</b> {where}."
