"""Files for the student to keep."""

from __future__ import annotations

from collections.abc import Callable

import viser


def offer(client: viser.ClientHandle, label: str, make: Callable[[], tuple[str, str]]) -> viser.GuiButtonHandle:
    """A button that saves a small file: `make` gives its name and text."""
    button = client.gui.add_button(label, icon=viser.Icon.DOWNLOAD, color="gray")

    @button.on_click
    async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
        name, text = make()
        send(client, name, text.encode())

    return button


def send(client: viser.ClientHandle, name: str, content: bytes) -> None:
    """Put a file into the browser's downloads."""
    client.send_file_download(name, content, save_immediately=True)
