"""The drawing on the robot on the table: draw, pause, go on, cancel. Seen only where that is the same kind of robot."""

from __future__ import annotations

from collections.abc import Callable

import viser

from app.link.programs import Program
from app.link.status import LinkStatus
from app.ui.compute import Worker
from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.jobs import Sketch
from app.ui.hardware import jobs
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.mirror import OTHER_ROBOT
from app.ui.hardware.verbs import not_free
from app.ui.panels.button_grid import STYLE, ButtonGrid, Cell
from app.ui.panels.hardware.motors_panel import verb_cell
from app.ui.panels.text import small
from app.ui.refusal import Refusal

HINT = "The robot on the table goes to the start slowly, then draws"


class RunPanel:
    """The folder `On the robot`. `progress` hears how far the robot has come with the drawing that is shown, 0 to 1."""

    def __init__(
        self, client: viser.ClientHandle, desk: DrawingDesk, worker: Worker, progress: Callable[[float], None]
    ) -> None:
        self._client = client
        self._desk = desk
        self._worker = worker
        self._progress = progress
        self._sent: Sketch | None = None
        """What the robot was asked to draw from here."""
        self._making = False
        self._folder = client.gui.add_folder("On the robot", visible=False)

    def furnish(self, hardware: HardwareDesk) -> None:
        """There is a robot: from now on the folder comes and goes with it."""
        self._hardware = hardware
        with self._folder:
            self._client.gui.add_html(STYLE)
            self._grid = ButtonGrid(self._client, "Drawing on the robot", self._press, hardware.tell, columns=2)
            self._said = self._client.gui.add_html("")
        hardware.status_changed.connect(self._follow)
        hardware.me_changed.connect(lambda _: self._follow(hardware.status))
        hardware.session.robot_changed.connect(lambda _: self._follow(hardware.status))
        hardware.beat.connect(self._report)
        self._desk.planned.connect(lambda _: self._follow(hardware.status))
        self._follow(hardware.status)

    def failed(self) -> None:
        """The worker could not do it, and has said so."""
        self._making = False
        self._follow(self._hardware.status)

    def _press(self, key: str) -> None:
        sketch = self._desk.sketch
        if key != "draw":
            self._hardware.do(key)
        elif sketch is not None and not self._making:
            self._making = True
            self._follow(self._hardware.status)
            self._worker.request(lambda program: self._receive(sketch, program), jobs.drawing_program, sketch)

    def _receive(self, sketch: Sketch, program: Program | Refusal) -> None:
        self._making = False
        if isinstance(program, Refusal):
            self._hardware.tell(program.reason)
        else:
            self._sent = sketch
            self._hardware.run(program)
        self._follow(self._hardware.status)

    def _follow(self, status: LinkStatus) -> None:
        session = self._hardware.session
        visible = status.phase == "ready" and status.robot is not None and status.robot.name == session.robot_name
        if self._folder.visible != visible:
            self._folder.visible = visible
        if not visible:
            return
        verbs = [verb_cell(key, self._hardware) for key in ("pause", "resume", "cancel")]
        self._grid.show([Cell("draw", "Draw with the robot", HINT, self._why_not(status), "main"), *verbs])
        self._report(status)

    def _why_not(self, status: LinkStatus) -> str:
        if self._making:
            return "The motion is being made: wait a moment."
        if refusal := not_free(status, self._hardware.me):
            return refusal
        if not self._hardware.shows_it:
            return OTHER_ROBOT
        if self._desk.plan is None:
            return "There is no way to draw this yet: see above."
        return ""

    def _report(self, status: LinkStatus) -> None:
        if not self._folder.visible:
            return
        said = self._why_not(status)
        if status.activity in ("run", "paused"):
            said = f"{'Paused' if status.activity == 'paused' else 'The robot draws'}: {100 * status.progress:.0f} %"
            if self._sent is not None and self._sent is self._desk.sketch:
                self._progress(status.progress)
        content = small(said) if said else ""
        if content != self._said.content:
            self._said.content = content
            self._client.flush()
