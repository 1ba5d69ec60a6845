"""Files of the drawing for other machines and programs."""

from __future__ import annotations

from typing import Any

import viser

from app.drawing.exports import EXPORTS, GCODE_VARIANTS
from app.ui.compute import Worker
from app.ui.downloads import send
from app.ui.drawing import jobs
from app.ui.drawing.desk import DrawingDesk
from app.ui.refusal import Refusal

TIMED = "timed.csv"
TITLES = {export.title: suffix for suffix, export in EXPORTS.items()} | {"CSV of the robot's path in time": TIMED}


class ExportPanel:
    """The folder `Save the drawing`."""

    def __init__(self, client: viser.ClientHandle, desk: DrawingDesk, worker: Worker) -> None:
        gui = client.gui
        with gui.add_folder("Save the drawing", expand_by_default=False):
            self._format = gui.add_dropdown("Format", tuple(TITLES), initial_value=EXPORTS[".svg"].title)
            self._variant = gui.add_dropdown("Machine", tuple(GCODE_VARIANTS), visible=False)
            self._save = gui.add_button("Save", icon=viser.Icon.DOWNLOAD, disabled=True)
        desk.sketched.connect(lambda _: setattr(self._save, "disabled", False))

        @self._format.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._variant.visible = TITLES[event.target.value] == ".gcode"

        @self._save.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            suffix = TITLES[self._format.value]
            variant: dict[str, Any] = GCODE_VARIANTS[self._variant.value] if suffix == ".gcode" else {}
            name = "Ptos_Dibujo.txt" if suffix == ".txt" else f"drawing{suffix if suffix[0] == '.' else '-' + suffix}"

            def deliver(result: bytes | Refusal) -> None:
                if isinstance(result, Refusal):
                    client.add_notification("Not saved", result.reason, color="red", auto_close_seconds=8)
                else:
                    send(client, name, result)
                    desk.note_saved()

            if desk.sketch is not None:
                worker.request(deliver, jobs.export, desk.sketch, suffix, variant)
