"""A guarded viser server, and pose updates without viser's detours.

This is the one module that touches viser's private names. It is written against viser 1.1;
tests/ui/test_viser_adapter.py fails where another version behaves differently.

viser has no limits and no checks of its own. Its worker is one long function with everything inside; it runs here
as it is, but under the names of its own it sees our way to serve, our consumer of messages and our message
buffers (`_rebound`). In viser itself one thing is patched: it remembers types (`_remember_type_hints`).
"""

from __future__ import annotations

import asyncio
import functools
import typing
from collections.abc import AsyncGenerator, AsyncIterator, Callable, Iterable, Iterator
from contextlib import AbstractAsyncContextManager, asynccontextmanager, contextmanager
from functools import partial
from types import FunctionType, SimpleNamespace
from typing import Any, TypeAlias, TypeVar
from weakref import WeakKeyDictionary

import numpy as np
import numpy.typing as npt
import rich
import viser
import websockets.datastructures
import websockets.exceptions
from viser import _messages, infra
from viser._assignable_props_api import AssignablePropsBase
from viser._gui_handles import _GuiInputHandle
from viser.infra._async_message_buffer import AsyncMessageBuffer
from websockets.asyncio.server import Server, ServerConnection
from websockets.frames import CloseCode

from app.ui import inbound
from app.ui.admission import Admission
from app.ui.guard import MIB, Guard, browser_id_in, new_browser_id
from app.ui.listener import PortTaken as PortTaken
from app.ui.listener import cookies, listen, serve_guarded
from app.ui.near_loop import NearLoop
from app.ui.uploads import UploadLedger

Value = TypeVar("Value")
Peer: TypeAlias = infra.WebsockClientConnection


def start_server(host: str, port: int, guard: Guard) -> viser.ViserServer:
    """Serve on exactly this port (0: any free one), quietly, behind `guard`.

    Raises `PortTaken` if another program listens there, `UserMistake` if the address cannot be used.
    """
    listener = listen(host, port)
    serve = partial(serve_guarded, listener, guard)
    names = vars(infra) | {"WebsockServer": partial(_GuardedServer, guard, serve)}
    initialize = _rebound(viser.ViserServer.__init__, infra=SimpleNamespace(**names))
    server = viser.ViserServer.__new__(viser.ViserServer)
    try:
        with _quiet_console():
            initialize(server, host, port, verbose=False)
    except BaseException:
        listener.close()
        raise
    guarded = _guarded(server)
    guarded.unregister_handler(_messages.ShareUrlRequest)
    guarded.unregister_handler(_messages.ShareUrlDisconnect)
    guarded.viser = server
    return server


def stop_server(server: viser.ViserServer) -> None:
    """Stop at once and quietly: connections closed, threads ended."""
    with _quiet_console():
        server.stop()


def browser_id(client: viser.ClientHandle) -> str:
    """Which browser this client is: the same after a reload, if it takes cookies."""
    return _guarded(client._viser_server).browser_ids[client._websock_connection]


def run_javascript(client: viser.ClientHandle, source: str) -> None:
    """Run a script on the client's page."""
    client._websock_connection.queue_message(_messages.RunJavascriptMessage(source=source))


def show_value(element: viser.GuiInputHandle[Value], value: Value) -> None:
    """Show a value in an input without calling its listeners, who would only hear what they said."""
    state = element._impl
    if state.value != value:
        state.value = value
        state.gui_api._websock_interface.queue_message(_messages.GuiUpdateMessage(state.uuid, {"value": value}))


def element_id(element: viser.GuiInputHandle[Any]) -> str:
    """The HTML id of an input on the page, for a style of its own."""
    return element._impl.uuid


def silence_gizmo_echo(gizmo: viser.TransformControlsHandle) -> None:
    """Let a position assigned while the gizmo is dragged reach who drags it.

    viser answers a drag with the dragged pose "for the others", which replaces the assigned one on its way.
    Only for a gizmo of one client: the others would no longer see a shared one move.
    """
    gizmo._impl_aux.sync_cb = None


class NodeStream:
    """Fast updates of one client's nodes: one message each, without comparing old and new values.

    As with viser's own setters, an update replaces an older one of the same kind that was not sent yet, and
    `flush` sends what has gathered at once instead of up to 17 ms later.
    """

    def __init__(self, client: viser.ClientHandle) -> None:
        self._client = client

    def place(
        self,
        handle: viser.BatchedMeshHandle | viser.BatchedGlbHandle,
        positions: npt.ArrayLike,
        wxyzs: npt.ArrayLike | None = None,
        colors: npt.ArrayLike | None = None,
        scales: npt.ArrayLike | None = None,
        opacities: npt.ArrayLike | None = None,
    ) -> None:
        """Place the n instances of a batched node.

        `positions` (n, 3) in metres, `wxyzs` (n, 4), `colors` (n, 3) or (3,) of 0 to 255, `scales` (n,) or
        (n, 3), `opacities` (n,); what is left out stays. Raises ValueError for any other shape.
        """
        count = len(handle._impl.props.batched_positions)
        updates = {"batched_positions": _array("positions", positions, np.float32, (count, 3))}
        if wxyzs is not None:
            updates["batched_wxyzs"] = _array("wxyzs", wxyzs, np.float32, (count, 4))
        if colors is not None:
            updates["batched_colors"] = _array("colors", colors, np.uint8, (count, 3), (3,))
        if scales is not None:
            updates["batched_scales"] = _array("scales", scales, np.float32, (count,), (count, 3))
        if opacities is not None:
            updates["batched_opacities"] = _array("opacities", opacities, np.float32, (count,))
        self._queue(handle, _NodeUpdate(handle._impl.name, updates))
        vars(handle._impl.props).update(updates)

    def move(
        self,
        handle: viser.SceneNodeHandle,
        position: Iterable[float],
        wxyz: Iterable[float] | None = None,
    ) -> None:
        """Put a node at `position` (3,) in metres and turn it to `wxyz` (4,), relative to its parent."""
        x, y, z = map(float, position)
        self._queue(handle, _messages.SetPositionMessage(handle._impl.name, (x, y, z)))
        handle._impl.position[:] = x, y, z
        if wxyz is not None:
            w, x, y, z = map(float, wxyz)
            self._queue(handle, _messages.SetOrientationMessage(handle._impl.name, (w, x, y, z)))
            handle._impl.wxyz[:] = w, x, y, z

    def flush(self) -> None:
        """Send what has gathered."""
        self._client.flush()

    def _queue(self, handle: viser.SceneNodeHandle, message: _messages.Message) -> None:
        if handle._impl.removed:
            raise RuntimeError(f"The node {handle._impl.name} has been removed.")
        handle._impl.api._queue_scene_message(message)


class _NodeUpdate(_messages.SceneNodeUpdateMessage):
    """viser's message for arrays only: it need not look for what else there might be."""

    def as_serializable_dict(self, binary_buffers: list[memoryview] | None = None) -> dict[str, Any]:
        assert binary_buffers is not None, "only for sending, not for recordings"
        updates = {}
        for name, array in self.updates.items():
            updates[name] = {"__binary_index": len(binary_buffers), "dtype": array.dtype.str}
            binary_buffers.append(array.data)
        return {"type": "SceneNodeUpdateMessage", "name": self.name, "updates": updates, "owner": self.owner}


def _array(what: str, values: npt.ArrayLike, dtype: type, *shapes: tuple[int, ...]) -> np.ndarray:
    """A copy of `values`, since the caller may go on writing to its own."""
    array = np.array(values, dtype, order="C")
    if array.shape not in shapes:
        raise ValueError(f"{what} need the shape {' or '.join(map(str, shapes))}, not {array.shape}.")
    return array


class _Page:
    """One open page, as its `Admission` sees it."""

    def __init__(self, peer: Peer, server: _GuardedServer) -> None:
        self.number = peer.client_id
        self._peer = peer
        self._server = server

    def element(self, uuid: str) -> _GuiInputHandle[Any] | None:
        handles = (gui._gui_input_handle_from_uuid.get(uuid) for gui in self._guis())
        return next((handle for handle in handles if handle is not None), None)

    def takes_files(self, uuid: str) -> bool:
        return isinstance(self.element(uuid), viser.GuiUploadButtonHandle)

    def has_container(self, uuid: str) -> bool:
        return any(uuid in gui._container_handle_from_uuid for gui in self._guis())

    def decline_upload(self, upload: inbound.FileTransferStartUpload) -> None:
        """Free the page's button, which would wait for ever, and say why."""
        ack = _messages.FileTransferPartAck(upload.source_component_uuid, upload.transfer_uuid, 0, 0)
        self._peer.queue_message(ack)
        client = self._client()
        if client is not None:
            body = f"Up to {self._server.guard.max_upload_bytes // MIB} MB are taken."
            client.add_notification("File not taken", body, color="red", auto_close_seconds=10.0)

    def _client(self) -> viser.ClientHandle | None:
        server = self._server.viser
        return None if server is None else server._connected_clients.get(self.number)

    def _guis(self) -> list[viser.GuiApi]:
        """The panels this page sees: those for everybody, and its own."""
        return [owner.gui for owner in (self._server.viser, self._client()) if owner is not None]


class _GuardedServer(infra.WebsockServer):
    """viser's websocket server with our way to serve and to take messages."""

    def __init__(self, guard: Guard, serve: Callable[..., AbstractAsyncContextManager[Server]], **options: Any) -> None:
        super().__init__(**options)
        self.guard = guard
        self.uploads = UploadLedger(guard)
        self.viser: viser.ViserServer | None = None
        self.browser_ids: WeakKeyDictionary[Peer, str] = WeakKeyDictionary()
        self._guarded_serve = serve
        self._peers: WeakKeyDictionary[ServerConnection, Peer] = WeakKeyDictionary()
        self._handling: set[asyncio.Task[None]] = set()
        seen_websockets = SimpleNamespace(
            asyncio=SimpleNamespace(server=SimpleNamespace(serve=self._serve)),
            datastructures=websockets.datastructures,
            exceptions=websockets.exceptions,
        )
        self._background_worker = _rebound(
            infra.WebsockServer._background_worker,
            websockets=seen_websockets,
            AsyncMessageBuffer=_message_buffer,
            _message_consumer=self._consume,
        ).__get__(self)
        self.on_client_connect(self._greet)
        self.on_client_disconnect(self._take_leave)

    @asynccontextmanager
    async def _serve(
        self, handle: Any, _host: str, _port: int, *, process_request: Any, **options: Any
    ) -> AsyncIterator[Server]:
        """In place of `websockets.serve`; the listening socket is already there."""

        async def handle_own(websocket: ServerConnection) -> None:
            # viser would print a line; the page shows the reason.
            if websocket.subprotocol == f"viser-v{viser.__version__}":
                await handle(websocket)
            else:
                await websocket.close(CloseCode.PROTOCOL_ERROR, "Reload the page: the server is another version")

        async with self._guarded_serve(handle_own, process_request, **options) as server:
            yield server
        for task in self._handling:
            task.cancel()
        await asyncio.gather(*self._handling, return_exceptions=True)

    def _greet(self, peer: Peer) -> None:
        """A websocket is open; viser does not listen to it yet."""
        websocket = self._live_connections[peer.client_id]
        assert websocket.request is not None
        self._peers[websocket] = peer
        self.browser_ids[peer] = browser_id_in(cookies(websocket.request)) or new_browser_id()

    def _take_leave(self, peer: Peer) -> None:
        self.uploads.forget(peer.client_id)

    async def _consume(self, websocket: ServerConnection, *_: Any) -> None:
        """In place of viser's endless loop over a client's messages."""
        peer = self._peers[websocket]
        admission = Admission(_Page(peer, self), self.uploads)
        while True:
            frame = await websocket.recv(decode=False)
            try:
                admitted = admission.admit(frame)
            except inbound.Garbled:
                await websocket.close(CloseCode.INVALID_DATA)
                raise websocket.protocol.close_exc from None
            if admitted is not None:
                self._dispatch(peer, admitted)
            # More may have come already: the others have their turn first.
            await asyncio.sleep(0)

    def _dispatch(self, peer: Peer, admitted: inbound.Inbound) -> None:
        """Start a task for whoever handles a message, as viser does: in everybody's scope and in the client's.

        A message about a scene node names the scope of the node, so the other one need not be asked.
        """
        message: infra.Message = getattr(_messages, type(admitted).__name__)(**inbound.fields(admitted))
        owner = getattr(message, "owner", None)
        scopes = (self, peer) if owner is None else (self if owner == "" else peer,)
        for scope in scopes:
            if type(message) in scope._incoming_handlers:
                client_id = infra.ClientId(peer.client_id)
                task = asyncio.create_task(scope._handle_incoming_message(client_id, message))
                self._handling.add(task)
                task.add_done_callback(self._handling.discard)


class _ClientBuffer(AsyncMessageBuffer):
    """One client's messages on their way, with a shorter way out.

    viser's own takes four turns of the event loop, a timer and a task to send what has been flushed.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        near: Any = NearLoop(loop)
        super().__init__(near, persistent_messages=False)

    def push(self, message: infra.Message) -> None:
        """What is said to a client that has left is no mistake, only late: viser warns and keeps it."""
        if not self.done:
            super().push(message)

    async def _window_loop(self, client_id: int, *_: Any) -> AsyncGenerator[list[infra.Message], None]:
        while not self.done:
            await self.message_event.wait()
            self.message_event.clear()
            await self._gather()
            while self.message_from_id and not self.atomic_counter and not self.done:
                if window := self._take_window(client_id):
                    yield window

    async def _gather(self) -> None:
        """Wait for a flush, at most as long as viser does."""
        if not self.flush_event.is_set():
            timer = asyncio.get_running_loop().call_later(self.window_duration_sec, self.flush_event.set)
            await self.flush_event.wait()
            timer.cancel()
        self.flush_event.clear()

    def _take_window(self, client_id: int) -> list[infra.Message]:
        with self.buffer_lock:
            due = list(self.message_from_id)[: self.max_window_size]
            window = [self.pop_message_locked(message_id) for message_id in due]
        return [message for message in window if message and message.excluded_self_client != client_id]


def _message_buffer(loop: asyncio.AbstractEventLoop, persistent_messages: bool) -> AsyncMessageBuffer:
    """In place of viser's; the one for everybody stays as it is."""
    return AsyncMessageBuffer(loop, persistent_messages) if persistent_messages else _ClientBuffer(loop)


@functools.cache
def _type_hints(kind: type) -> dict[str, Any]:
    return typing.get_type_hints(kind)


def _remember_type_hints() -> None:
    """viser looks the types of a handle's properties up anew for each handle, which costs about a millisecond."""
    AssignablePropsBase._prop_hints = property(lambda handle: _type_hints(type(handle._impl.props)))  # type: ignore


_remember_type_hints()


def _guarded(server: viser.ViserServer) -> _GuardedServer:
    guarded = server._websock_server
    assert isinstance(guarded, _GuardedServer), "the server was not made by start_server"
    return guarded


def _rebound(function: Callable[..., Any], **names: Any) -> Any:
    """The same function, to which these global names mean something else."""
    assert isinstance(function, FunctionType)
    seen = function.__globals__ | names
    copy = FunctionType(function.__code__, seen, function.__name__, function.__defaults__, function.__closure__)
    copy.__kwdefaults__ = function.__kwdefaults__
    return copy


@contextmanager
def _quiet_console() -> Iterator[None]:
    """viser prints a panel when it starts and a line when it stops."""
    console = rich.get_console()
    quiet, console.quiet = console.quiet, True
    try:
        yield
    finally:
        console.quiet = quiet
