"""A browser's end of viser's websocket protocol, without the browser.

From client to server a message is a msgpack map `{"type": ClassName, **fields}`. From server to client a
frame is a window of messages: u64 length, u64 compressed length, zstd(msgpack), then raw arrays, each padded
to 8 bytes. The server takes a client for present once it has sent its camera.
"""

from __future__ import annotations

import asyncio
import contextlib
import math
import struct
import threading
import time
from collections.abc import AsyncIterator, Callable, Coroutine, Mapping, Sequence
from concurrent.futures import Future
from importlib.metadata import version as installed_version
from typing import Any, TypeVar

import msgspec.msgpack
import numpy as np
import zstandard
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

Message = dict[str, Any]
Result = TypeVar("Result")
IDENTITY = (1.0, 0.0, 0.0, 0.0)


def decode_window(frame: bytes, decompressor: zstandard.ZstdDecompressor | None = None) -> list[Message]:
    """Messages of one frame, with the arrays in their places."""
    decompressor = decompressor or zstandard.ZstdDecompressor()
    length, compressed = struct.unpack_from("<QQ", frame, 0)
    start = 16
    packed = decompressor.decompress(frame[start : start + compressed], max_output_size=length)
    window = msgspec.msgpack.decode(packed)
    buffer_lengths = window.get("binaryBufferLengths") or ()
    if not buffer_lengths:
        return list(window["messages"])
    buffers, offset = [], start + compressed
    for size in buffer_lengths:
        offset += -offset % 8
        buffers.append(frame[offset : offset + size])
        offset += size
    return [_with_arrays(message, buffers) for message in window["messages"]]


def _with_arrays(value: Any, buffers: Sequence[bytes]) -> Any:
    if isinstance(value, dict):
        if "__binary_index" in value:
            return np.frombuffer(buffers[value["__binary_index"]], dtype=value["dtype"])
        return {key: _with_arrays(item, buffers) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_with_arrays(item, buffers) for item in value]
    return value


class WireClient:
    """One connected client: what the server has shown it so far, and what it can send.

    `nodes` maps a scene node's name to the message that made it, `positions` and `orientations` (wxyz) to its
    last pose, `inputs` a GUI element's uuid to the message that made it, with its present value.
    """

    def __init__(self, connection: ClientConnection) -> None:
        self.connection = connection
        self.nodes: dict[str, Message] = {}
        self.positions: dict[str, tuple[float, ...]] = {}
        self.orientations: dict[str, tuple[float, ...]] = {}
        self.inputs: dict[str, Message] = {}
        self.listeners: list[Callable[[Message, float], None]] = []
        """Called with every message and the time (perf_counter) at which its frame arrived."""
        self.closed_because: str | None = None
        self._changed = asyncio.Event()
        self._decompressor = zstandard.ZstdDecompressor()

    async def send(self, type: str, **fields: Any) -> None:
        """Send one message; nothing is checked, so that a test can forge what it likes."""
        await self.connection.send(msgspec.msgpack.encode({"type": type, **fields}))

    async def wait_for(self, condition: Callable[[], Any], what: str, timeout: float = 20.0) -> None:
        """Wait until what has been received fulfils `condition`; `what` names it when it does not come."""
        try:
            async with asyncio.timeout(timeout):
                while not condition():
                    if self.closed_because:
                        raise ConnectionError(f"closed while waiting for {what}: {self.closed_because}")
                    self._changed.clear()
                    await self._changed.wait()
        except TimeoutError:
            raise AssertionError(f"no {what} within {timeout:g} s") from None

    async def start_drag(self, gizmo: str) -> None:
        await self.send("TransformControlsDragStartMessage", name=gizmo, owner=self.nodes[gizmo]["owner"])

    async def drag(self, gizmo: str, position: Sequence[float], wxyz: Sequence[float] = IDENTITY) -> None:
        """Move a gizmo to `position` (metres) and `wxyz`, both relative to its parent."""
        owner = self.nodes[gizmo]["owner"]
        await self.send(
            "TransformControlsUpdateMessage",
            name=gizmo,
            owner=owner,
            position=tuple(position),
            wxyz=tuple(wxyz),
        )

    async def end_drag(self, gizmo: str) -> None:
        await self.send("TransformControlsDragEndMessage", name=gizmo, owner=self.nodes[gizmo]["owner"])

    def uuid_of(self, label: str) -> str:
        """Identity of the only GUI element with this label."""
        found = [uuid for uuid, made in self.inputs.items() if made.get("props", {}).get("label") == label]
        if len(found) != 1:
            raise LookupError(f"{len(found)} GUI elements are labelled {label!r}")
        return found[0]

    def has(self, label: str) -> bool:
        """Whether a GUI element with this label is there."""
        return any(made.get("props", {}).get("label") == label for made in self.inputs.values())

    def value_of(self, label: str) -> Any:
        return self.inputs[self.uuid_of(label)]["value"]

    async def set_value(self, label: str, value: Any) -> None:
        """Give an input a value; `True` presses a button."""
        await self.send("GuiUpdateMessage", uuid=self.uuid_of(label), updates={"value": value})

    async def send_camera(self) -> None:
        """Say where this client looks from, which is what makes the server greet it."""
        await self.send(
            "ViewerCameraMessage", wxyz=IDENTITY, position=(1.0, 1.0, 1.0), look_at=(0.0, 0.0, 0.0),
            up_direction=(0.0, 0.0, 1.0), fov=math.radians(75), near=0.01, far=1000.0,
            image_height=900, image_width=1440,
        )  # fmt: skip

    async def _receive(self) -> None:
        try:
            async for frame in self.connection:
                arrived = time.perf_counter()
                assert isinstance(frame, bytes)
                for message in decode_window(frame, self._decompressor):
                    self._note(message)
                    if message["type"] == "LocalStorageGetItemRequestMessage":
                        await self._answer_as_fresh_browser(message)
                    for listener in self.listeners:
                        listener(message, arrived)
                self._changed.set()
            self.closed_because = "the server said goodbye"
        except ConnectionClosed as reason:
            self.closed_because = str(reason)
        self._changed.set()

    def _note(self, message: Message) -> None:
        kind = message["type"]
        if kind == "SetPositionMessage":
            self.positions[message["name"]] = tuple(message["position"])
        elif kind == "SetOrientationMessage":
            self.orientations[message["name"]] = tuple(message["wxyz"])
        elif kind == "RemoveSceneNodeMessage":
            self._forget(message["name"])
        elif kind == "GuiUpdateMessage" and message["uuid"] in self.inputs:
            self._update_input(self.inputs[message["uuid"]], message["updates"])
        elif kind == "GuiRemoveMessage":
            self.inputs.pop(message["uuid"], None)
        elif kind.startswith("Gui") and "uuid" in message and "props" in message:
            self.inputs[message["uuid"]] = message
        elif "name" in message and "props" in message:
            self.nodes[message["name"]] = message

    def _forget(self, name: str) -> None:
        """Drop a scene node with all that hangs on it."""
        for registry in (self.nodes, self.positions, self.orientations):
            for gone in [known for known in registry if known == name or known.startswith(f"{name}/")]:
                del registry[gone]

    @staticmethod
    def _update_input(made: Message, updates: Mapping[str, Any]) -> None:
        for name, value in updates.items():
            if name == "value":
                made["value"] = value
            else:
                made["props"][name] = value

    async def _answer_as_fresh_browser(self, request: Message) -> None:
        await self.send(
            "LocalStorageGetItemResponseMessage", value=None, error=None, request_uuid=request["request_uuid"]
        )


def note(client: WireClient, *types: str) -> list[Message]:
    """Fills with the messages of these types that a client receives from now on."""
    noted: list[Message] = []
    client.listeners.append(lambda message, _: noted.append(message) if message["type"] in types else None)
    return noted


@contextlib.asynccontextmanager
async def wire_client(
    url: str, *, greet: bool = True, headers: Mapping[str, str] | None = None, version: str | None = None
) -> AsyncIterator[WireClient]:
    """Connect to the server at `url`. `greet` sends the camera; `headers` may hold a cookie or an Origin."""
    version = version or installed_version("viser")
    async with connect(
        url.replace("http", "ws", 1),
        subprotocols=[Subprotocol(f"viser-v{version}")],
        additional_headers=headers,
        max_size=None,
        compression=None,
        open_timeout=30,
    ) as connection:
        client = WireClient(connection)
        receiving = asyncio.create_task(client._receive())
        try:
            if greet:
                await client.send_camera()
            yield client
        finally:
            receiving.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await receiving


def run_async(task: Coroutine[Any, Any, Result]) -> Result:
    """`asyncio.run` on a thread of its own: in a browser test Playwright keeps a loop on the main thread."""
    outcome: Future[Result] = Future()

    def work() -> None:
        try:
            outcome.set_result(asyncio.run(task))
        except BaseException as error:
            outcome.set_exception(error)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    return outcome.result()
