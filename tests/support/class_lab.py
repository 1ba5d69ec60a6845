"""A class in this process, and its people as clients over the wire: what each page shows, and what is pressed there."""

from __future__ import annotations

import asyncio
import html
import itertools
import json
import re
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager, contextmanager
from pathlib import Path
from typing import Any

from app.ui.guard import COOKIE, new_browser_id
from app.ui.options import ServeOptions
from app.ui.server import Lab
from tests.support.wire import Message, WireClient, wire_client

PIN = "271828"
GIZMO = "/robot/gizmo"
CALL = re.compile(r"^window\.deltalabClass\?\.(\w+)\((.*)\);$", re.DOTALL)
BUTTON = re.compile(r"<button ([^>]*)>([^<]*)</button>")
ATTRIBUTE = re.compile(r'([\w-]+)="([^"]*)"')


class ClassLab:
    """`lab` serves the page at `url`."""

    def __init__(self, lab: Lab) -> None:
        self.lab = lab
        self.classroom = lab.classroom
        self.code = lab.classroom.code
        self.url = f"http://127.0.0.1:{lab.server.get_port()}"

    async def on_the_loop(self, act: Callable[[], Any]) -> Any:
        """The result of something that is done on the server's loop, as its own callbacks do."""

        async def done() -> Any:
            return act()

        return await asyncio.wrap_future(asyncio.run_coroutine_threadsafe(done(), self.lab.server.get_event_loop()))


class ClassClient:
    """One page. What the class puts on it beside the panels is kept by the name of its part."""

    def __init__(self, client: WireClient, browser: str) -> None:
        self.client = client
        self.browser = browser
        self.told: list[str] = []
        """Notifications so far."""
        self.files: list[bytes] = []
        self.parts: dict[str, Any] = {"ask": None, "pause": None, "banner": "", "picture": ""}
        self._numbers = itertools.count(1)
        client.listeners.append(self._see)

    @property
    def asked(self) -> str | None:
        """What the card says to whoever has to join; None: there is no card."""
        return self.parts["ask"]

    @property
    def said(self) -> str:
        """What the panels' HTML says, as HTML."""
        return " ".join(str(made["props"].get("content", "")) for made in list(self.client.inputs.values()))

    def buttons(self) -> dict[str, dict[str, str]]:
        """Attributes of the buttons in the panels' HTML, by what is written on them."""
        found = BUTTON.findall(self.said)
        return {html.unescape(label): dict(ATTRIBUTE.findall(attributes)) for attributes, label in found}

    async def say(self, **what: Any) -> None:
        """As the card does."""
        await self.client.set_value("Class said", json.dumps({**what, "number": next(self._numbers)}))

    async def join(self, name: str, code: str) -> None:
        await self.say(do="join", name=name, code=code)
        await self.until(lambda: self.asked is None, f"joining of {name}")

    async def prove(self, pin: str = PIN) -> None:
        await self.say(do="prove", pin=pin)
        await self.until(lambda: self.client.has("Student pressed"), "instructor's page")

    async def press(self, label: str) -> None:
        """Press a button in the panels' HTML."""
        await self.until(lambda: label in self.buttons(), f"button {label!r}")
        button = self.buttons()[label]
        value = f"{button['data-press']} {next(self._numbers)}"
        await self.client.send("GuiUpdateMessage", uuid=button["data-wire"], updates={"value": value})

    async def set(self, label: str, value: Any) -> None:
        await self.client.set_value(label, value)

    async def until(self, condition: Callable[[], Any], what: str, timeout: float = 20.0) -> None:
        await self.client.wait_for(condition, what, timeout)

    def _see(self, message: Message, _: float) -> None:
        match message:
            case {"type": "NotificationShowMessage", "props": {"body": str(body)}}:
                self.told.append(body)
            case {"type": "FileTransferPart"}:
                self.files.append(message["content"])
            case {"type": "RunJavascriptMessage", "source": str(source)}:
                self._run(source)

    def _run(self, source: str) -> None:
        call = CALL.match(source)
        if call is None:
            return
        name, arguments = call[1], json.loads(f"[{call[2]}]")
        if name == "done":
            self.parts["ask"] = None
        else:
            self.parts[name] = arguments[0]


@contextmanager
def class_lab(data: Path, robot: str = "par4") -> Iterator[ClassLab]:
    """A class whose file is in this folder."""
    options = ServeOptions(
        port=0, robot=robot, open_browser=False, shadows=False, classroom=True, data=str(data), pin=PIN
    )
    lab = Lab(options)
    try:
        yield ClassLab(lab)
    finally:
        lab.close()


@asynccontextmanager
async def class_client(url: str, browser: str = "", whole: bool = True) -> AsyncIterator[ClassClient]:
    """A page of a browser, of a new one without its identity; `whole`: with its panels."""
    browser = browser or new_browser_id()
    async with wire_client(url, headers={"Cookie": f"{COOKIE}={browser}"}, greet=False) as client:
        one = ClassClient(client, browser)
        await client.send_camera()
        ready = "Hardware opened" if whole else "Class said"
        await client.wait_for(lambda: client.has(ready) and GIZMO in client.nodes, "page")
        yield one
