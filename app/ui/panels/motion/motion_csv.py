"""The motion as a file: written by a worker."""

from __future__ import annotations

import viser

from app.ui.compute import Worker
from app.ui.downloads import send
from app.ui.motion.desk import MotionDesk
from app.ui.motion.jobs import motion_csv


def offer_csv(client: viser.ClientHandle, desk: MotionDesk, worker: Worker) -> None:
    """A button that saves the motion that is shown."""
    button = client.gui.add_button("Save this motion as CSV", icon=viser.Icon.DOWNLOAD, color="gray")

    @button.on_click
    async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
        if desk.motion is not None:
            name = f"motion-{desk.robot.name}.csv"
            worker.request(lambda content: send(client, name, content), motion_csv, desk.motion, desk.robot.name)
