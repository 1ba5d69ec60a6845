"""A viser server that shows every client one of everything, guarded or bare, and notes what its callbacks get."""

from __future__ import annotations

import asyncio
import contextlib
import http.client
import io
import math
from collections.abc import AsyncIterator, Callable, Iterator, Mapping
from typing import Any

import numpy as np
import viser

from app.ui.guard import Guard
from app.ui.viser_adapter import start_server, stop_server
from tests.support.wire import WireClient, wire_client

HOST = "127.0.0.1"
GIZMO, TOOL, GROUP = "/robot/gizmo", "/robot/tool", "/robot/group"
INSTANCES = 3
TRIANGLE = np.eye(3), np.array([[0, 1, 2]])


class SmallLab:
    """`heard` lists (client id, label, value) of every callback, in the order of their calls."""

    def __init__(self, server: viser.ViserServer) -> None:
        self.server = server
        self.heard: list[tuple[int, str, Any]] = []
        self.clients: dict[int, viser.ClientHandle] = {}
        self.gizmos: dict[int, viser.TransformControlsHandle] = {}
        self.groups: dict[int, viser.BatchedMeshHandle] = {}
        self.tools: dict[int, viser.FrameHandle] = {}
        self.shared = server.gui.add_slider("Shared", min=0.0, max=1.0, step=0.01, initial_value=0.5)
        self._hear("Shared", self.shared)
        server.on_client_connect(self._furnish)

    @property
    def url(self) -> str:
        return f"http://{HOST}:{self.server.get_port()}"

    def values(self, label: str) -> list[Any]:
        """What the callbacks of one input were given."""
        return [value for _, heard, value in list(self.heard) if heard == label]

    def get(self, path: str = "/", headers: Mapping[str, str] | None = None) -> http.client.HTTPResponse:
        """The answer to a request for a page, already read."""
        connection = http.client.HTTPConnection(HOST, self.server.get_port(), timeout=10)
        connection.request("GET", path, headers=dict(headers or {}))
        response = connection.getresponse()
        response.read()
        return response

    @contextlib.asynccontextmanager
    async def visit(self, headers: Mapping[str, str] | None = None) -> AsyncIterator[WireClient]:
        """A client that has been shown everything."""
        async with wire_client(self.url, headers=headers) as client:
            await client.wait_for(lambda: GIZMO in client.nodes, "gizmo")
            yield client

    def client_of(self, client: WireClient) -> viser.ClientHandle:
        """The server's end of a client."""
        return self.clients[int(client.nodes[GIZMO]["owner"])]

    async def _furnish(self, client: viser.ClientHandle) -> None:
        scene, gui, number = client.scene, client.gui, client.client_id
        self.tools[number] = scene.add_frame(TOOL, show_axes=False)
        self.groups[number] = scene.add_batched_meshes_simple(
            GROUP,
            *TRIANGLE,
            batched_wxyzs=np.tile((1.0, 0.0, 0.0, 0.0), (INSTANCES, 1)),
            batched_positions=np.zeros((INSTANCES, 3)),
            batched_colors=(10, 20, 30),
            lod="off",
        )
        self._hear("Speed", gui.add_slider("Speed", min=0.0, max=1.0, step=0.001, initial_value=0.5))
        self._hear("Height", gui.add_number("Height", 0.0, min=-100.0, max=100.0, step=0.5))
        self._hear("Count", gui.add_number("Count", 1, min=0, max=1000, step=1))
        self._hear("Robot", gui.add_dropdown("Robot", ("par4", "delta3"), initial_value="par4"))
        self._hear("Name", gui.add_text("Name", ""))
        self._hear("Ghosts", gui.add_checkbox("Ghosts", False))
        self._hear("Target", gui.add_vector3("Target", (0.0, 0.0, 0.0), min=(-1.0, -1.0, -1.0), max=(1.0, 1.0, 1.0)))
        self._hear("Colour", gui.add_rgb("Colour", (1, 2, 3)))
        self._hear("Locked", gui.add_number("Locked", 0.0, disabled=True))
        self._hear_clicks("Go", gui.add_button("Go"))
        self._hear_uploads("Drawing", gui.add_upload_button("Drawing"))
        self._follow(client, scene.add_transform_controls(GIZMO, scale=0.2))
        self.clients[number] = client

    def _follow(self, client: viser.ClientHandle, gizmo: viser.TransformControlsHandle) -> None:
        self.gizmos[client.client_id] = gizmo

        @gizmo.on_update
        async def _(event: viser.TransformControlsEvent) -> None:
            if event.phase == "update":
                position = tuple(event.target.position.tolist())
                self.heard.append((client.client_id, "drag", position))
                self.tools[client.client_id].position = position
                client.flush()

    def _hear(self, label: str, handle: Any) -> None:
        @handle.on_update
        async def _(event: viser.GuiEvent) -> None:
            self.heard.append((-1 if event.client_id is None else event.client_id, label, event.target.value))

    def _hear_clicks(self, label: str, button: viser.GuiButtonHandle) -> None:
        @button.on_click
        async def _(event: viser.GuiEvent) -> None:
            self.heard.append((-1 if event.client_id is None else event.client_id, label, True))

    def _hear_uploads(self, label: str, button: viser.GuiUploadButtonHandle) -> None:
        @button.on_upload
        async def _(event: viser.GuiEvent) -> None:
            file = event.target.value
            self.heard.append((-1 if event.client_id is None else event.client_id, label, (file.name, file.content)))


async def eventually(condition: Callable[[], Any], what: str, timeout: float = 10.0) -> None:
    """Wait until something is so on the server."""
    for _ in range(math.ceil(timeout / 0.01)):
        if condition():
            return
        await asyncio.sleep(0.01)
    raise AssertionError(f"no {what} within {timeout:g} s")


async def round_trip(client: WireClient, position: tuple[float, float, float], timeout: float = 10.0) -> None:
    """Drag the gizmo and wait until the tool has followed: all that was sent before has then been dealt with."""
    await client.drag(GIZMO, position)
    await client.wait_for(lambda: client.positions.get(TOOL) == position, f"tool at {position}", timeout)


@contextlib.contextmanager
def guarded_lab(guard: Guard | None = None) -> Iterator[SmallLab]:
    """Behind a guard, as Delta Lab runs it."""
    server = start_server(HOST, 0, guard or Guard())
    try:
        yield SmallLab(server)
    finally:
        stop_server(server)


@contextlib.contextmanager
def bare_lab() -> Iterator[SmallLab]:
    """viser alone: what an attack does where nobody guards."""
    with contextlib.redirect_stdout(io.StringIO()):
        server = viser.ViserServer(HOST, 0, verbose=False)
    try:
        yield SmallLab(server)
    finally:
        with contextlib.redirect_stdout(io.StringIO()):
            server.stop()
