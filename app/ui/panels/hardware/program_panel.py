"""Run a drawing or a path on the robot: speed, progress, pause, cancel."""

from __future__ import annotations

import html
import math
import time

import viser

from app.link.programs import Program
from app.link.status import LinkStatus
from app.ui.compute import Worker
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.offers import Offer, Shelf
from app.ui.hardware.verbs import not_allowed, not_free
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.hardware.motors_panel import verb_cell
from app.ui.panels.options import show_options
from app.ui.panels.text import small
from app.ui.refusal import Refusal
from app.ui.viser_adapter import show_value

NOTHING: str = "Nothing yet"
ADVICE = "Plan a drawing in the tab Draw, or compute a run in the tab Control: it can then be run here."

ECHO_S = 1.0
"""A slider that was just pulled does not follow what the link says: that is older."""


class ProgramPanel:
    """The folder `Run`."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk, shelf: Shelf, worker: Worker) -> None:
        self._desk = desk
        self._shelf = shelf
        self._worker = worker
        self._offers: dict[str, Offer] = {}
        self._pulled_s = -math.inf
        gui = client.gui
        with gui.add_folder("Run"):
            self._speed = gui.add_slider(
                "Speed override (%)", 5, 100, 5, 100, hint="Slows everything the robot does, at once"
            )
            self._what = gui.add_dropdown("What", (NOTHING,))
            self._grid = ButtonGrid(client, "Run", self._press, desk.tell, columns=4)
            self._bar = gui.add_progress_bar(0.0, visible=False)
            self._said = gui.add_html(small(ADVICE))
        desk.status_changed.connect(self._follow)
        desk.beat.connect(self._show_progress)
        desk.me_changed.connect(lambda _: self._follow(desk.status))
        self.look()

        @self._speed.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[int]]) -> None:
            self._pulled_s = time.monotonic()
            desk.set_override(event.target.value / 100.0)

    def look(self) -> None:
        """See what the other labs have by now."""
        self._offers = {offer.title: offer for offer in self._shelf.offers()}
        titles = tuple(self._offers) or (NOTHING,)
        show_options(self._what, titles, self._what.value if self._what.value in titles else titles[0])
        self._follow(self._desk.status)

    def failed(self) -> None:
        """The worker could not do it, and has said so."""
        self._follow(self._desk.status)

    def _press(self, key: str) -> None:
        if key != "run":
            self._desk.do(key)
            return
        offer = self._offers.get(self._what.value)
        if offer is not None:
            self._said.content = small("The motion is being made …")
            self._worker.request(self._receive, offer.job)

    def _receive(self, program: Program | Refusal) -> None:
        self._said.content = ""
        if isinstance(program, Refusal):
            self._desk.tell(program.reason)
        else:
            self._desk.run(program)

    def _follow(self, status: LinkStatus) -> None:
        missing = "" if self._offers else ADVICE
        why_not = not_free(status, self._desk.me) or missing
        run = Cell("run", "Run", "The robot goes to the start slowly, then runs it", why_not, "main")
        self._grid.show([run, *(verb_cell(key, self._desk) for key in ("pause", "resume", "cancel"))])
        if time.monotonic() - self._pulled_s > ECHO_S:
            show_value(self._speed, round(100.0 * status.override))
        locked = bool(not_allowed(status, self._desk.me))
        if self._speed.disabled != locked:
            self._speed.disabled = locked
        running = status.activity in ("run", "paused")
        if self._bar.visible != running:
            self._bar.visible = running
        self._said.content = "" if running or self._offers else small(ADVICE)
        self._show_progress(status)

    def _show_progress(self, status: LinkStatus) -> None:
        if not self._bar.visible:
            return
        percent = round(100.0 * status.progress)
        if percent != self._bar.value:
            self._bar.value = percent
        said = "paused" if status.activity == "paused" else f"{percent} %"
        content = small(f"{html.escape(status.program_title)}: {said}")
        if content != self._said.content:
            self._said.content = content
