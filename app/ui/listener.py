"""The socket the server listens on: who gets the page, who gets a websocket, and how fast they are read."""

from __future__ import annotations

import asyncio
import errno
import logging
import os
import socket
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from http import HTTPStatus
from typing import Any, TypeAlias

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.http11 import Request, Response
from websockets.protocol import Event
from websockets.server import ServerProtocol

from app.errors import UserMistake
from app.ui.guard import SECURITY_HEADERS, Guard, browser_id_in, identity_cookie, is_loopback, new_browser_id
from app.ui.rate_limit import TokenBucket

AnswerHttp: TypeAlias = Callable[[ServerConnection, Request], Response | None]

HEALTH_PATH = "/healthz"
CLOSE_TIMEOUT = 0.5
"""Seconds that a page is given to say goodbye."""
READ_BYTES = 16 * 1024
"""Read at once from one connection, before the others have their turn."""
BYTES_PER_TOKEN = 64 * 1024

_log = logging.getLogger(__name__)
# Not ours to report: port scanners, and other programs that do not speak HTTP.
_log.addFilter(lambda record: record.getMessage() != "opening handshake failed")


class PortTaken(UserMistake, OSError):
    """Another program listens on the port."""


def listen(host: str, port: int) -> socket.socket:
    """A listening socket on exactly this port; port 0 means any free one.

    Raises `PortTaken` if another program listens there, `UserMistake` if the address cannot be used.
    """
    try:
        found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
        family, kind, protocol, _, address = min(found, key=lambda entry: entry[0] != socket.AF_INET)
        # asyncio turns Nagle's delay (40 ms a drag) off only where the protocol is stated, which
        # `socket.create_server` does not do.
        listener = socket.socket(family, kind, protocol)
        if os.name == "posix":
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(address)
        listener.listen()
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            raise PortTaken(f"Port {port} is taken by another program: choose another with --port.") from None
        raise UserMistake(f"Cannot listen on {host}:{port}: {error.strerror}.") from None
    return listener


@asynccontextmanager
async def serve_guarded(
    listener: socket.socket,
    guard: Guard,
    handle: Callable[[ServerConnection], Awaitable[None]],
    answer_page: AnswerHttp,
    **options: Any,
) -> AsyncIterator[Server]:
    """`websockets.serve` behind the guard, and gone at once when the block ends."""
    local_only = is_loopback(listener.getsockname()[0])

    def answer(connection: ServerConnection, request: Request) -> Response | None:
        return answer_http(guard, local_only, answer_page, connection, request)

    def connect(protocol: ServerProtocol, server: Server, **limits: Any) -> Websocket:
        return Websocket(protocol, server, guard=guard, **limits)

    options |= {
        "process_request": answer,
        "create_connection": connect,
        "max_size": guard.max_message_bytes,
        "close_timeout": CLOSE_TIMEOUT,
        "logger": _log,
    }
    async with serve(handle, sock=listener, **options) as server:
        yield server
        # Browsers open connections in advance; nothing has been asked on them, so nobody waits for an answer.
        for connection in server.handlers:
            if connection.request is None:
                connection.transport.abort()


def answer_http(
    guard: Guard, local_only: bool, answer_page: AnswerHttp, connection: ServerConnection, request: Request
) -> Response | None:
    """Answer a request; None lets it become a websocket."""
    hosts, origins = request.headers.get_all("Host"), request.headers.get_all("Origin")
    refusal = guard.refusal(hosts, origins, local_only=local_only)
    if refusal is not None:
        response = connection.respond(*refusal)
    elif len(connection.server.handlers) > guard.max_connections:
        response = connection.respond(HTTPStatus.SERVICE_UNAVAILABLE, "Too many pages are open: try again.\n")
    elif request.path == HEALTH_PATH:
        response = connection.respond(HTTPStatus.OK, "ok")
    else:
        response = answer_page(connection, request)
    if response is None:
        return None
    response.headers.update(SECURITY_HEADERS)
    is_page = response.headers.get("Content-Type", "").startswith("text/html")
    if is_page and browser_id_in(cookies(request)) is None:
        response.headers["Set-Cookie"] = identity_cookie(new_browser_id())
    return response


def cookies(request: Request) -> str:
    """The request's Cookie headers as one."""
    return ";".join(request.headers.get_all("Cookie"))


class Websocket(ServerConnection):
    """One connection, read no faster than its token bucket allows.

    A frame costs a token, and so do 64 KiB. Whoever runs out is not read for a while, so that TCP slows them down
    and nothing is lost. Pings and fragments count as well, which never reach a reader of messages.
    """

    def __init__(self, *arguments: Any, guard: Guard, **limits: Any) -> None:
        super().__init__(*arguments, **limits)
        self._bucket = TokenBucket(guard.frames_per_second, guard.frame_burst)
        self._frames = 0
        self._waiting = False

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(transport)
        vars(transport)["max_size"] = READ_BYTES
        # websockets pauses reading on its own account, and must not end our pause with its own.
        self.recv_messages.resume = self._read_on

    def process_event(self, event: Event) -> None:
        self._frames += 1
        super().process_event(event)

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        wait = self._bucket.take(self._frames + len(data) / BYTES_PER_TOKEN)
        self._frames = 0
        if wait > 0:
            self._waiting = True
            self.transport.pause_reading()
            self.loop.call_later(wait, self._end_wait)

    def _end_wait(self) -> None:
        self._waiting = False
        self._read_on()

    def _read_on(self) -> None:
        if not (self._waiting or self.recv_messages.paused):
            self.transport.resume_reading()
