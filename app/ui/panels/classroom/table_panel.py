"""The robot on the table: who has it, who waits, and the instructor's word on it."""

from __future__ import annotations

import viser

from app.link.status import LinkStatus
from app.ui.classroom.instructor_desk import InstructorDesk
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.hardware.control_panel import lease_line
from app.ui.panels.text import small

NO_ROBOT = small("No robot is connected: open the tab Hardware.")


class TablePanel:
    """The folder `Robot on the table`. It is looked at with the board."""

    def __init__(self, client: viser.ClientHandle, desk: InstructorDesk) -> None:
        self._desk = desk
        with client.gui.add_folder("Robot on the table", expand_by_default=False):
            self._said = client.gui.add_html(NO_ROBOT)
            self._grid = ButtonGrid(client, "Robot on the table", self._do, desk.tell)
            self._queue = ButtonGrid(client, "Queue", self._give, desk.tell, columns=2)

    def look(self) -> None:
        """Show how things are now."""
        desk, status = self._desk, self._desk.status
        there = status.phase == "ready"
        said = lease_line(status, desk.me.key) if there else NO_ROBOT
        if said != self._said.content:
            self._said.content = said
        self._grid.visible = self._queue.visible = there
        if there:
            self._grid.show(deeds(status, desk.me.key))
            self._queue.show([Cell(person.key, f"Give to {person.name}") for person in status.queue])

    def _do(self, key: str) -> None:
        if key == "take":
            self._desk.take_robot()
        else:
            self._desk.free_robot()

    def _give(self, member_id: str) -> None:
        member = self._desk.classroom.find(member_id)
        if member is None:
            self._desk.tell("This student has left the class: choose somebody else.")
        else:
            self._desk.hand_robot_to(member)


def deeds(status: LinkStatus, my_key: str) -> list[Cell]:
    """What the instructor may do with the robot."""
    mine = status.holder is not None and status.holder.key == my_key
    return [
        Cell("take", "Take it back", "The robot halts and is yours", "You have it." if mine else "", "main"),
        Cell("free", "Next in line", "Give it to whoever waits", "" if mine else "Take it back first."),
    ]
