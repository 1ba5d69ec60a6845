"""Ways to a board: a pseudo-terminal for the cable, a socket, and names that lead nowhere."""

from __future__ import annotations

import os
import random
import socket
import time
from collections.abc import Callable, Iterator

import pytest

from app.link.errors import LinkError, LinkLost
from app.link.transport import SerialTransport, Transport, open_transport

PATIENCE_S = 5.0


class Cable:
    """A pseudo-terminal; the board's end is a file descriptor."""

    def __init__(self) -> None:
        self.board, self._host = os.openpty()
        os.set_blocking(self.board, False)
        self.port = os.ttyname(self._host)

    def let_go(self) -> None:
        """The host's own end; the transport has opened it by its name."""
        os.close(self._host)

    def pull(self) -> None:
        if self.board >= 0:
            os.close(self.board)
            self.board = -1


@pytest.fixture
def cable() -> Iterator[Cable]:
    cable = Cable()
    yield cable
    cable.pull()


@pytest.fixture
def transport(cable: Cable) -> Iterator[Transport]:
    opened = open_transport(cable.port)
    cable.let_go()
    yield opened
    opened.close()


def read_until(transport: Transport, enough: Callable[[bytes], bool]) -> bytes:
    """Reads until it is enough, with patience."""
    data, end = b"", time.monotonic() + PATIENCE_S
    while not enough(data) and time.monotonic() < end:
        data += transport.read()
        time.sleep(0.002)
    return data


def test_bytes_of_every_value_travel_both_ways(cable: Cable, transport: Transport):
    everything = bytes(range(256)) * 4
    os.write(cable.board, everything)
    assert read_until(transport, lambda data: len(data) >= 1024) == everything
    transport.write(everything)
    time.sleep(0.05)
    assert os.read(cable.board, 4096) == everything
    assert transport.name == cable.port


def test_reading_does_not_wait(transport: Transport):
    begin = time.monotonic()
    assert [transport.read() for _ in range(100)] == [b""] * 100
    assert time.monotonic() - begin < 1.0


def test_a_pulled_cable_is_noticed_while_reading(cable: Cable, transport: Transport):
    cable.pull()
    with pytest.raises(LinkLost, match="check the cable"):
        transport.read()


def test_a_pulled_cable_is_noticed_while_writing(cable: Cable, transport: Transport):
    cable.pull()
    with pytest.raises(LinkLost, match="check the cable"):
        transport.write(b"hello")


def test_a_board_that_takes_nothing_does_not_hang_the_host(transport: Transport):
    """A pseudo-terminal holds some kilobytes."""
    noise = random.Random(1).randbytes(1024)
    begin = time.monotonic()
    for _ in range(40):
        transport.write(noise)
    assert time.monotonic() - begin < 10.0


def test_closing_twice_and_after_the_cable_is_gone_is_fine(cable: Cable, transport: Transport):
    cable.pull()
    transport.close()
    transport.close()


@pytest.mark.parametrize(
    "port", ["/dev/no-such-port", "COM", "socket://127.0.0.1:1", "socket://nowhere", "rubbish://x", ""]
)
def test_a_port_that_cannot_be_opened_is_one_sentence(port: str):
    with pytest.raises(LinkError) as found:
        open_transport(port)
    sentence = str(found.value)
    assert sentence.endswith(".") and "\n" not in sentence and "Errno" not in sentence


def test_a_port_has_one_user(cable: Cable, transport: Transport):
    with pytest.raises(LinkError, match="Another program"):
        SerialTransport(cable.port)


def test_a_socket_is_a_port_too():
    with socket.create_server(("127.0.0.1", 0)) as server:
        transport = open_transport(f"socket://127.0.0.1:{server.getsockname()[1]}")
        board, _ = server.accept()
        with board:
            board.sendall(b"\0hello\0")
            assert read_until(transport, lambda data: len(data) >= 7) == b"\0hello\0"
            transport.write(b"answer")
            board.settimeout(PATIENCE_S)
            assert board.recv(100) == b"answer"
        with pytest.raises(LinkLost):
            read_until(transport, lambda data: False)
        transport.close()
