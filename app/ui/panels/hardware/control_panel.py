"""Who has the robot, who waits, and who sits here."""

from __future__ import annotations

import html
import math

import viser

from app.classroom.names import LONGEST_NAME
from app.link.lease import KEEP_S
from app.link.status import LinkStatus
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.verbs import VERBS, place_in_queue
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.text import small

SIGNS_S = 3.0
"""A sign of life comes every second; only when some have failed to come does the countdown begin."""

VERBS_HERE = ("request", "release", "take_over")


class ControlPanel:
    """The folder `Control`."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk) -> None:
        self._desk = desk
        gui = client.gui
        with gui.add_folder("Control"):
            self._said = gui.add_html("")
            self._grid = ButtonGrid(client, "Control", desk.do, desk.tell)
            self._add_me(client)
        desk.status_changed.connect(self._follow)
        desk.beat.connect(self._follow)
        desk.me_changed.connect(lambda _: self._follow(desk.status))
        self._follow(desk.status)

    def _add_me(self, client: viser.ClientHandle) -> None:
        gui, desk = client.gui, self._desk
        with gui.add_folder("You", expand_by_default=False):
            name = gui.add_text("Your name", desk.me.name, hint="As the others in the room see it")
            self._pin = gui.add_text("Instructor's PIN", "", visible=desk.workshop.people.has_pin)
            self._prove = ButtonGrid(client, "PIN", lambda _: self._give_pin(), desk.tell, columns=1)
            self._prove.show([Cell("prove", "I am the instructor", "The server has printed the PIN at its start")])
            self._prove.visible = self._pin.visible

        @name.on_update
        async def _(event: viser.GuiEvent[viser.GuiTextHandle]) -> None:
            desk.rename(event.target.value[: 4 * LONGEST_NAME])

    def _give_pin(self) -> None:
        pin, self._pin.value = self._pin.value, ""
        if self._desk.prove(pin):
            self._pin.visible = self._prove.visible = False

    def _follow(self, status: LinkStatus) -> None:
        me = self._desk.me
        said = lease_line(status, me.key)
        if said != self._said.content:
            self._said.content = said
        cells = [
            Cell(key, VERBS[key].label, VERBS[key].hint, VERBS[key].why_not(status, me), VERBS[key].tone)
            for key in VERBS_HERE
            if key != "take_over" or me.instructor
        ]
        if place_in_queue(status, me):
            cells[1] = Cell("release", "Leave the queue", "Give your place up")
        self._grid.show(cells)


def lease_line(status: LinkStatus, my_key: str) -> str:
    """HTML: who holds the robot, for how long without a sign of life, and who waits."""
    holder = status.holder
    if holder is None:
        return small("Nobody has control: it is free." if status.phase == "ready" else "Nobody has control.")
    mine = holder.key == my_key
    who = "<b>You</b> have control" if mine else f"<b>{html.escape(holder.name)}</b> has control"
    if holder.instructor:
        who += " (instructor)"
    left = math.ceil(status.holder_left_s)
    kept = f" Kept for {KEEP_S:.0f} s." if left >= KEEP_S - SIGNS_S else f" No sign of life: free in {left} s."
    queue = ", ".join(
        f"{place}. {'<b>you</b>' if person.key == my_key else html.escape(person.name)}"
        for place, person in enumerate(status.queue, 1)
    )
    return small(f"{who}.{kept}" + (f"<br>In the queue: {queue}." if queue else ""))
