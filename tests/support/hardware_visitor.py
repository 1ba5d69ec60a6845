"""The tab Hardware as one client gets it over the wire: what its page says, and what a student presses there."""

from __future__ import annotations

import asyncio
import re
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import asynccontextmanager
from typing import Any

from tests.support.server import RunningServer
from tests.support.wire import Message, WireClient, wire_client

WORD = re.compile(r'data-robot="state".*?<b>([^<]*)</b>')
BUTTON = re.compile(r"<button ([^>]*)>([^<]*)</button>")
ATTRIBUTE = re.compile(r'([\w-]+)="([^"]*)"')


class Visitor:
    """A client with the tab Hardware open. It gives signs of life as a page does."""

    def __init__(self, client: WireClient) -> None:
        self.client = client
        self.told: list[str] = []
        """Notifications so far."""
        self.files: list[bytes] = []
        self._presses = 0
        client.listeners.append(self._see)

    @property
    def word(self) -> str:
        """State of the robot."""
        found = WORD.search(self.said)
        return found[1] if found else ""

    @property
    def said(self) -> str:
        """What the page's HTML says."""
        return " ".join(made["props"]["content"] for made in self.client.inputs.values() if "content" in made["props"])

    def why_not(self, label: str) -> str | None:
        """Why a button is grey; None where it may be pressed."""
        for attributes, shown in BUTTON.findall(self.said):
            if shown == label:
                found = dict(ATTRIBUTE.findall(attributes))
                return found.get("title", "") if "aria-disabled" in found else None
        raise LookupError(f"there is no button {label!r}")

    async def press(self, grid: str, key: str) -> None:
        """Press a button of the grid with this name."""
        self._presses += 1
        await self.client.set_value(f"{grid} pressed", f"{key} {self._presses}")

    async def hold(self, key: str, seconds: float) -> None:
        """Hold a jog button, renewed as a page does, and let it go."""
        for number in range(round(seconds / 0.05)):
            await self.client.set_value("Held button", f"hold {key} {number}")
            await asyncio.sleep(0.05)
        await self.client.set_value("Held button", f"release {key} 0")

    async def set(self, label: str, value: Any) -> None:
        await self.client.set_value(label, value)

    async def until(self, condition: Callable[[], Any], what: str, timeout: float = 20.0) -> None:
        await self.client.wait_for(condition, what, timeout)

    async def until_word(self, word: str, timeout: float = 20.0) -> None:
        await self.until(lambda: self.word == word, f"state {word!r} (it is {self.word!r})", timeout)

    async def until_told(self, sentence: str) -> None:
        await self.until(lambda: any(sentence in told for told in self.told), f"notification {sentence!r}")

    async def live(self) -> None:
        """Give signs of life, as the script on a page does."""
        beat = False
        while True:
            beat = not beat
            await self.client.set_value("Sign of life", beat)
            await asyncio.sleep(1.0)

    def _see(self, message: Message, _: float) -> None:
        match message:
            case {"type": "NotificationShowMessage", "props": {"body": str(body)}}:
                self.told.append(body)
            case {"type": "FileTransferPart"}:
                self.files.append(message["content"])


@asynccontextmanager
async def visitor(server: RunningServer, headers: Mapping[str, str] | None = None) -> AsyncIterator[Visitor]:
    async with wire_client(server.url, headers=headers) as client:
        await client.wait_for(lambda: client.has("Hardware opened"), "furnished room")
        one = Visitor(client)
        await client.set_value("Hardware opened", True)
        await client.wait_for(lambda: client.has("Calibration pressed") and one.word, "tab Hardware", 60.0)
        living = asyncio.create_task(one.live())
        try:
            yield one
        finally:
            living.cancel()
