"""Power, homing, and what follows a stop."""

from __future__ import annotations

import viser

from app.link.status import LinkStatus
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.verbs import VERBS
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.text import small

VERBS_HERE = ("enable", "home", "resume", "clear", "power_off")


class MotorsPanel:
    """The folder `Motors`."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk) -> None:
        self._desk = desk
        with client.gui.add_folder("Motors"):
            self._grid = ButtonGrid(client, "Motors", desk.do, desk.tell)
            client.gui.add_html(small("After <b>Power off</b> the arms may fall: hold them."))
        desk.status_changed.connect(self._follow)
        desk.me_changed.connect(lambda _: self._follow(desk.status))
        self._follow(desk.status)

    def _follow(self, status: LinkStatus) -> None:
        self._grid.show([verb_cell(key, self._desk) for key in VERBS_HERE])


def verb_cell(key: str, desk: HardwareDesk) -> Cell:
    """The button of a verb, for whoever sits at this desk."""
    verb = VERBS[key]
    return Cell(key, verb.label, verb.hint, verb.why_not(desk.status, desk.me), verb.tone)
