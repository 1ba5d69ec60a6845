"""What the instructor does with one student, or says to all."""

from __future__ import annotations

import html

import viser

from app.classroom.pace import LONGEST_MESSAGE
from app.ui.classroom.instructor_desk import InstructorDesk
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.text import small

CHOOSE = "Press a name in the table first."
NOBODY = small("Press a name in the table: the buttons below are about that student.")


class StudentPanel:
    """The folder `Student`."""

    def __init__(self, client: viser.ClientHandle, desk: InstructorDesk) -> None:
        self._desk = desk
        gui = client.gui
        with gui.add_folder("Student"):
            self._said = gui.add_html(NOBODY)
            self._grid = ButtonGrid(client, "Student deed", self._do, desk.tell)
            self._text = gui.add_text("Message", "", multiline=True)
            self._send = ButtonGrid(client, "Message", self._say, desk.tell, columns=2)
        desk.chosen_changed.connect(lambda _: self.look())
        self.look()

    def look(self) -> None:
        """Show what can be done now."""
        student = self._desk.chosen
        said = NOBODY if student is None else small(f"<b>{html.escape(student.name)}</b>")
        if said != self._said.content:
            self._said.content = said
        why = "" if student is not None else CHOOSE
        no_robot = why or ("" if self._desk.status.phase == "ready" else "There is no robot on the table.")
        sure = self._desk.asks("remove")
        self._grid.show(
            [
                Cell("show", "Show to all", "Everybody sees this student's robot", why, "main"),
                Cell("anonymous", "Show, no name", "The same, without telling whose it is", why),
                Cell("give", "Give the robot", "The robot on the table: it halts and is this student's", no_robot),
                Cell("lower", "Lower hand", "The question is answered", why),
                Cell("end", "End showing", "Everybody has their own robot again"),
                Cell(
                    "remove", "Really remove?" if sure else "Remove", "Out of the class; the results stay", why, "risky"
                ),
            ]
        )
        to = "the student" if student is None else student.name
        self._send.show([Cell("one", f"Send to {to}", "", why), Cell("all", "Send to all")])

    def _do(self, key: str) -> None:
        desk, classroom, student = self._desk, self._desk.classroom, self._desk.chosen
        if key == "end":
            desk.do(lambda: classroom.end_spotlight(desk.browser))
        if student is None:
            return
        if key in ("show", "anonymous"):
            desk.do(lambda: classroom.show(desk.browser, student.id, anonymous=key == "anonymous"))
        elif key == "give":
            desk.hand_robot_to(student)
        elif key == "lower":
            desk.do(lambda: classroom.lower(desk.browser, student.id))
        elif key == "remove" and desk.sure("remove"):
            desk.remove(student)
        self.look()

    def _say(self, key: str) -> None:
        desk, student, text = self._desk, self._desk.chosen, self._text.value[:LONGEST_MESSAGE]
        if key == "one" and student is None:
            desk.tell(CHOOSE)
            return
        to = student.id if key == "one" and student is not None else None
        if desk.do(lambda: desk.classroom.send(desk.browser, text, to)):
            self._text.value = ""
