"""Calibrate the robot: measured poses, what is looked for, what was found, and where to measure next."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import viser

from app.errors import UserMistake
from app.link.calibration.problem import FRAME
from app.link.calibration.report import board_settings, choices
from app.link.status import LinkStatus
from app.robots import Robot
from app.ui.compute import Worker
from app.ui.downloads import send
from app.ui.hardware.calibration_jobs import Calibrated, Wish, calibrate, nominal_of, propose, read_measurements
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.notebook import Notebook
from app.ui.hardware.verbs import NO_BOARD, not_off
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.hardware.calibration_tables import found_table, next_table, rows_table
from app.ui.panels.text import small
from app.ui.refusal import Refusal

ABOUT = (
    "Move the tool to a point whose place you can measure (a grid, a ruler, a dial gauge), type x, y and z, and take "
    "the pose. The more different poses, the better."
)
NO_ROWS = "Take a pose first."


class CalibrationPanel:
    """The tab `Calibrate`."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk, worker: Worker) -> None:
        self._client = client
        self._desk = desk
        self._worker = worker
        self._notebook = Notebook()
        self._found: Calibrated | None = None
        self._robot = ""
        self._wanted: dict[str, viser.GuiCheckboxHandle] = {}
        gui = client.gui
        gui.add_html(small(ABOUT))
        self._point = gui.add_vector3("Measured (mm)", (0.0, 0.0, 0.0), step=0.01, hint="x, y and z of the tool")
        self._rows = ButtonGrid(client, "Poses", self._press, desk.tell)
        self._table = gui.add_html("")
        self._upload = gui.add_upload_button(
            "Read poses (CSV)", icon=viser.Icon.UPLOAD, mime_type=".csv,text/csv", color="gray"
        )
        with gui.add_folder("What is looked for", expand_by_default=False):
            self._accuracy = gui.add_number("Accuracy (mm)", 0.2, min=0.01, max=20.0, step=0.01)
            self._offsets = gui.add_checkbox("Offsets of the joints", True)
            self._choices = gui.add_folder(None)
        self._solving = ButtonGrid(client, "Calibration", self._press, desk.tell)
        self._said = gui.add_html("")
        self._next = gui.add_html("")
        desk.status_changed.connect(self._follow)
        desk.me_changed.connect(lambda _: self._follow(desk.status))
        self._follow(desk.status)

        @self._upload.on_upload
        async def _(event: viser.GuiEvent[viser.GuiUploadButtonHandle]) -> None:
            if self._robot:
                self._ask(self._receive_file, read_measurements, self._robot, event.target.value.content)

    def failed(self) -> None:
        """The worker could not do it, and has said so."""
        self._said.content = ""

    def _follow(self, status: LinkStatus) -> None:
        if status.robot is not None and status.robot.name != self._robot:
            self._offer(status.robot)
        self._show_buttons(status)

    def _offer(self, robot: Robot) -> None:
        """What can be looked for on this robot."""
        self._robot = robot.name
        for box in self._wanted.values():
            box.remove()
        with self._choices:
            self._wanted = {
                name: self._client.gui.add_checkbox(label, False) for name, label in choices(robot.name).items()
            }
        self._forget()

    def _show_buttons(self, status: LinkStatus) -> None:
        no_board = "" if status.robot is not None and status.telemetry is not None else NO_BOARD
        no_rows = "" if len(self._notebook) else NO_ROWS
        self._rows.show(
            [
                Cell("take", "Take this pose", "The joints now, and what you have measured", no_board, "main"),
                Cell("undo", "Remove last", "", no_rows),
                Cell("save", "Save poses", "As CSV", no_rows),
            ]
        )
        unsolved = "" if self._found is not None else "Solve first."
        self._solving.show(
            [
                Cell("solve", "Solve", "The machine that fits best", no_rows, "main"),
                Cell("next", "Where next?", "Poses that would help most", no_board),
                Cell(
                    "apply",
                    "To the board",
                    "Offsets and geometry, read back",
                    unsolved or not_off(status, self._desk.me),
                ),
            ]
        )

    def _press(self, key: str) -> None:
        actions: dict[str, Callable[[], None]] = {
            "take": self._take,
            "undo": self._undo,
            "save": self._save,
            "solve": self._solve,
            "next": lambda: self._ask(self._show_next, propose, self._wish()),
            "apply": self._apply,
        }
        actions[key]()

    def _take(self) -> None:
        status = self._desk.status
        if status.robot is None or status.telemetry is None:
            return
        joints = status.telemetry.position[: len(status.robot.joint_names)]
        x, y, z = (1e-3 * value for value in self._point.value)
        self._notebook.add(status.robot.name, joints, (x, y, z))
        self._forget()

    def _undo(self) -> None:
        self._notebook.remove_last()
        self._forget()

    def _save(self) -> None:
        send(self._client, "poses.csv", self._notebook.measurements.csv().encode())

    def _receive_file(self, measurements: Any) -> None:
        self._notebook.load(measurements)
        self._forget()

    def _forget(self) -> None:
        """Other rows: what was found before is void."""
        self._found = None
        self._said.content = self._next.content = ""
        rows = self._notebook.measurements if len(self._notebook) else None
        self._table.content = rows_table(rows) if rows is not None else small("No pose yet.")
        self._show_buttons(self._desk.status)

    def _wish(self) -> Wish:
        status, frame = self._desk.status, {name for name, _ in FRAME}
        chosen = [name for name, box in self._wanted.items() if box.value]
        return Wish(
            self._robot,
            nominal_of(status.robot) if status.robot is not None else {},
            self._offsets.value,
            tuple(name for name in chosen if name not in frame),
            tuple(name for name in chosen if name in frame),
            1e-3 * self._accuracy.value,
        )

    def _solve(self) -> None:
        try:
            measurements = self._notebook.measurements
        except UserMistake as refusal:
            self._desk.tell(str(refusal))
            return
        self._said.content = small("Solving …")
        self._ask(self._show, calibrate, self._wish(), measurements)

    def _ask(self, then: Callable[[Any], None], job: Callable[..., Any], *arguments: object) -> None:
        def done(result: object) -> None:
            if isinstance(result, Refusal):
                self._said.content = ""
                self._desk.tell(result.reason)
            else:
                then(result)

        self._worker.request(done, job, *arguments)

    def _show(self, found: Calibrated) -> None:
        self._found = found
        self._said.content = found_table(found)
        self._next.content = next_table(found.solution.problem.robot, found.next)
        self._show_buttons(self._desk.status)

    def _show_next(self, following: Any) -> None:
        self._next.content = next_table(self._robot, following)

    def _apply(self) -> None:
        assert self._found is not None
        desk = self._desk
        try:
            values = board_settings(self._found.solution, desk.status.settings)
        except UserMistake as refusal:
            desk.tell(str(refusal))
            return
        desk.apply_settings(values, lambda: desk.tell_good("The board has the calibration; home it again."))
