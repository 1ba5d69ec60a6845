"""Record what the robot does, keep it as a file, and lay it beside what the simulation does."""

from __future__ import annotations

import html
from collections.abc import Callable
from typing import Any

import viser

from app.link.status import LinkStatus
from app.ui.compute import Worker
from app.ui.downloads import send
from app.ui.hardware import jobs
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.twin_desk import TwinDesk
from app.ui.hardware.verbs import NO_BOARD
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.hardware.twin_view import TwinView
from app.ui.panels.text import small
from app.ui.refusal import Refusal

ABOUT = "Record a motion, then compare: the simulation gets the same set-points as the robot did."
NO_RECORDING = "Record something first."


class RecordPanel:
    """The tab `Record`."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk, twin: TwinDesk, worker: Worker) -> None:
        self._client = client
        self._desk = desk
        self._twin = twin
        self._worker = worker
        gui = client.gui
        gui.add_html(small(ABOUT))
        self._said = gui.add_html("")
        self._grid = ButtonGrid(client, "Recording", self._press, desk.tell, columns=4)
        self._upload = gui.add_upload_button(
            "Read a recording (CSV)", icon=viser.Icon.UPLOAD, mime_type=".csv,text/csv"
        )
        self._bar = gui.add_progress_bar(100.0, animated=True, visible=False)
        self._view = TwinView(gui)
        desk.status_changed.connect(lambda _: self._follow())
        desk.beat.connect(self._show_time)
        desk.recorded.connect(lambda _: self._follow())
        twin.busy_changed.connect(lambda busy: setattr(self._bar, "visible", busy))
        twin.answered.connect(self._view.show)
        self._follow()
        if twin.result is not None:
            self._view.show(twin.result)

        @self._upload.on_upload
        async def _(event: viser.GuiEvent[viser.GuiUploadButtonHandle]) -> None:
            self._ask(desk.keep, jobs.read_recording, event.target.value.content)

    def failed(self) -> None:
        """The worker could not do it, and has said so."""
        self._bar.visible = False

    def _press(self, key: str) -> None:
        desk, recording = self._desk, self._desk.recording
        if key == "record":
            desk.start_recording()
        elif key == "stop":
            desk.stop_recording()
        elif recording is not None and key == "save":
            self._ask(lambda data: send(self._client, "recording.csv", data), jobs.recording_csv, recording)
        elif recording is not None and key == "compare":
            self._twin.compare()

    def _ask(self, then: Callable[[Any], None], job: Callable[..., Any], *arguments: object) -> None:
        def done(result: object) -> None:
            self._bar.visible = False
            if isinstance(result, Refusal):
                self._desk.tell(result.reason)
            else:
                then(result)

        self._bar.visible = True
        self._worker.request(done, job, *arguments)

    def _show_time(self, status: LinkStatus) -> None:
        recording = self._desk.recording
        if status.recording_s:
            said = f"● Recording: {status.recording_s:.0f} s"
        elif recording is not None:
            title = html.escape(recording.title or "Recording")
            said = f"{title}: {recording.duration_s:.1f} s, {len(recording.t)} messages"
        else:
            said = "No recording yet."
        if small(said) != self._said.content:
            self._said.content = small(said)

    def _follow(self) -> None:
        status = self._desk.status
        self._show_time(status)
        no_board = "" if status.phase == "ready" else NO_BOARD
        runs = "It records already." if status.recording_s else ""
        missing = "" if self._desk.recording is not None else NO_RECORDING
        self._grid.show(
            [
                Cell("record", "Record", "Every message, 50 a second, up to 30 minutes", no_board or runs, "main"),
                Cell("stop", "Stop", "End the recording", "" if status.recording_s else "Nothing is recorded."),
                Cell("compare", "Compare", "With the simulated twin", missing),
                Cell("save", "Save", "As CSV with units in its head", missing),
            ]
        )
