"""The tab Draw as one client gets it over the wire: what its page shows, and what a student does there."""

from __future__ import annotations

import re
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from typing import Any

from app.drawing.exports import EXPORTS
from tests.support.server import RunningServer
from tests.support.wire import Message, WireClient, run_async, wire_client

PROBLEM = re.compile(r">▲ ([^<]*)</b>")


class Visitor:
    """A client with the tab Draw open, and what its page shows."""

    def __init__(self, client: WireClient) -> None:
        self.client = client
        self.visible: dict[str, bool] = {}
        self.pictures = 0
        """Of the sheet, so far."""
        self.files: list[bytes] = []
        self.go, self.stop = client.uuid_of("Draw"), client.uuid_of("Stop and go home")
        client.listeners.append(self._see)

    async def set(self, label: str, value: Any) -> None:
        """As a page does, which shows at once what was entered."""
        made = self._input(label)
        made["value"] = value
        await self.client.send("GuiUpdateMessage", uuid=made["uuid"], updates={"value": value})

    async def press(self, label: str) -> None:
        await self.client.set_value(label, True)

    def _input(self, label: str) -> Message:
        """A folder may be called like what is in it."""
        all_made = self.client.inputs.values()
        return next(made for made in all_made if "value" in made and made["props"].get("label") == label)

    def props(self, label: str) -> dict[str, Any]:
        return self.client.inputs[self.client.uuid_of(label)]["props"]

    @property
    def can_draw(self) -> bool:
        return not self.client.inputs[self.go]["props"]["disabled"]

    @property
    def said(self) -> str:
        """All HTML that is shown."""
        all_props = [made["props"] for made in self.client.inputs.values()]
        return " ".join(props["content"] for props in all_props if props.get("visible") and "content" in props)

    def cell(self, name: str) -> str:
        """A number of the table; `2.34 m` for lengths."""
        found = re.search(rf"<td>{name}</td><td[^>]*><b>([^<]*)</b>", self.said)
        return found[1] if found else ""

    async def until(self, condition: Callable[[], Any], what: str, timeout: float = 30.0) -> None:
        await self.client.wait_for(condition, what, timeout)

    @property
    def reasons(self) -> list[str]:
        """Why something cannot be, as it is said."""
        return PROBLEM.findall(self.said)

    @property
    def settled(self) -> bool:
        """Whether nobody has to wait for the drawing any more."""
        return self.can_draw or ("The way is being planned" not in self.said and bool(self.reasons))

    async def saved_svg(self) -> bytes:
        """The drawing as a file."""
        await self.set("Format", EXPORTS[".svg"].title)
        self.files.clear()
        await self.press("Save")
        await self.until(lambda: any(file.startswith(b"<?xml") for file in self.files), "file")
        return next(file for file in self.files if file.startswith(b"<?xml"))

    async def new_picture(self, begin: Awaitable[None]) -> None:
        before = self.pictures
        await begin
        await self.until(lambda: self.pictures > before, "new picture of the sheet")

    async def upload(self, name: str, data: bytes) -> None:
        common = {"source_component_uuid": self.client.uuid_of("Upload a picture"), "transfer_uuid": name}
        size = {"part_count": int(len(data) > 0), "size_bytes": len(data)}
        await self.client.send("FileTransferStartUpload", filename=name, mime_type="image/png", **size, **common)
        if data:
            await self.client.send("FileTransferPart", part_index=0, content=data, **common)

    def _see(self, message: Message, _: float) -> None:
        match message:
            case {"type": "SetSceneNodeVisibilityMessage"}:
                self.visible[message["name"]] = message["visible"]
            case {"type": "FileTransferPart"}:
                self.files.append(message["content"])
            case {"type": "GuiUpdateMessage", "updates": {"content": str(content)}} if 'alt="Drawing"' in content:
                self.pictures += 1


@asynccontextmanager
async def visitor(server: RunningServer) -> AsyncIterator[Visitor]:
    async with wire_client(server.url) as client:
        await client.wait_for(lambda: client.has("Draw opened"), "furnished room")
        await client.set_value("Draw opened", True)
        await client.wait_for(lambda: client.has("Compare the robots"), "tab Draw", 60.0)
        one = Visitor(client)
        await one.until(lambda: one.can_draw, "first plan")
        yield one


def on_page(server: RunningServer, play: Callable[[Visitor], Awaitable[None]]) -> None:
    async def scene() -> None:
        async with visitor(server) as one:
            await play(one)

    run_async(scene())
