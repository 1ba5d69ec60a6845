"""The HTTP side: one port, guarded answers, and connections that do not wait for Nagle."""

from __future__ import annotations

import logging
import socket
import threading
import urllib.request
from collections.abc import Iterator

import psutil
import pytest

from app.errors import UserMistake
from app.ui.guard import COOKIE, SECURITY_HEADERS, Guard, browser_id_in
from app.ui.viser_adapter import PortTaken, start_server
from tests.support.small_lab import HOST, SmallLab, bare_lab, eventually, guarded_lab
from tests.support.wire import run_async


@pytest.fixture
def lab() -> Iterator[SmallLab]:
    with guarded_lab() as lab:
        yield lab


def listening_ports() -> set[int]:
    """Of this process."""
    connections = psutil.Process().net_connections(kind="tcp")
    return {connection.laddr.port for connection in connections if connection.status == psutil.CONN_LISTEN}


def test_a_taken_port_is_refused_and_no_other_one_opened() -> None:
    with socket.create_server((HOST, 0)) as other:
        port = other.getsockname()[1]
        threads, ports = threading.active_count(), listening_ports()
        sentence = rf"^Port {port} is taken by another program: choose another with --port\.$"
        with pytest.raises(PortTaken, match=sentence):
            start_server(HOST, port, Guard())
        assert threading.active_count() == threads
        assert listening_ports() == ports


def test_an_address_of_another_machine_is_refused() -> None:
    with pytest.raises(UserMistake, match=r"^Cannot listen on 203\.0\.113\.1:8080: .+\.$"):
        start_server("203.0.113.1", 8080, Guard())


def test_two_servers_have_their_own_guards() -> None:
    with guarded_lab(Guard(allowed_hosts=("lab.example.org",))) as one, guarded_lab() as two:
        assert one.server.get_port() != two.server.get_port()
        assert one.get(headers={"Host": "lab.example.org"}).status == 200
        assert two.get(headers={"Host": "lab.example.org"}).status == 403


def test_viser_itself_stays_as_it_was() -> None:
    with guarded_lab(), bare_lab() as bare:
        assert bare.get(headers={"Host": "evil.example"}).status == 200
        assert bare.get().getheader("Content-Security-Policy") is None


@pytest.mark.parametrize(("path", "status"), [("/", 200), ("/healthz", 200), ("/nowhere", 404)])
def test_every_answer_has_the_security_headers(lab: SmallLab, path: str, status: int) -> None:
    answer = lab.get(path)
    assert answer.status == status
    assert {name: answer.getheader(name) for name in SECURITY_HEADERS} == SECURITY_HEADERS


def test_refusals_have_the_security_headers_too(lab: SmallLab) -> None:
    answer = lab.get(headers={"Host": "evil.example"})
    assert answer.status == 403
    assert answer.getheader("X-Content-Type-Options") == "nosniff"


def test_health_is_one_word(lab: SmallLab) -> None:
    with urllib.request.urlopen(f"{lab.url}/healthz") as answer:
        assert answer.read() == b"ok"


def test_the_page_gives_a_cookie_to_who_has_none(lab: SmallLab) -> None:
    cookie = lab.get().getheader("Set-Cookie") or ""
    identity = browser_id_in(cookie.split(";")[0])
    assert identity
    assert lab.get(headers={"Cookie": f"{COOKIE}={identity}"}).getheader("Set-Cookie") is None
    assert lab.get(headers={"Cookie": f"{COOKIE}=malformed"}).getheader("Set-Cookie")
    assert lab.get("/healthz").getheader("Set-Cookie") is None


def test_too_many_connections_are_turned_away() -> None:
    with guarded_lab(Guard(max_connections=2)) as lab:

        async def scene() -> None:
            async with lab.visit(), lab.visit():
                assert lab.get().status == 503
            await eventually(lambda: lab.get().status == 200, "free place")

        run_async(scene())


def test_what_is_not_http_leaves_no_trace(lab: SmallLab, caplog: pytest.LogCaptureFixture) -> None:
    for request in (
        b"\x16\x03\x01\x02\x00",
        b"HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n",
        b"GET / HTTP/1.1\r\n\r\n",
        b"",
    ):
        with socket.create_connection((HOST, lab.server.get_port())) as connection:
            connection.sendall(request)
            connection.shutdown(socket.SHUT_WR)
            connection.recv(100)
    assert lab.get().status == 200
    assert [record.getMessage() for record in caplog.records if record.levelno >= logging.WARNING] == []


def test_small_messages_are_not_held_back_by_nagle(lab: SmallLab) -> None:
    """Otherwise a drag's answer waits for the browser's next message: 33 to 50 ms."""

    async def scene() -> None:
        async with lab.visit() as client:
            number = lab.client_of(client).client_id
            connection = lab.server._websock_server._live_connections[number]
            accepted = connection.transport.get_extra_info("socket")
            assert accepted.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)

    run_async(scene())
