"""A cable between the host and a board, with its own pseudo terminal, that can be pulled, disturbed and delayed."""

from __future__ import annotations

import contextlib
import os
import select
import tempfile
import threading
import time
import tty
from collections import deque
from collections.abc import Callable
from pathlib import Path

from app.link.emulated.faults import Faults, Line
from app.link.errors import LinkLost
from app.link.transport import SerialTransport, Transport

ARRIVAL_S = 1.0
"""Within so long the system has passed bytes through a pseudo terminal; usually it is a tenth of a millisecond."""


class Cable:
    """`port` is what the host opens, with pyserial. The board's end is opened when the host opens its own, as a USB
    port resets an Uno then. Bytes pass when `carry` is called."""

    def __init__(self, open_board: Callable[[], Transport]) -> None:
        self.open_board = open_board
        self.faults = Faults()
        """Of which noise, loss and delay are the cable's."""
        self.frozen = False
        """Nothing passes, and then everything at once."""
        self._folder = tempfile.TemporaryDirectory()
        self.port = str(Path(self._folder.name) / "ttyBoard")
        self._lock = threading.Lock()
        self._extra: deque[bytes] = deque()
        self._to_board, self._to_host = Line(seed=1), Line(seed=2)
        self._master: int | None = None
        self._board: Transport | None = None
        self._said = self._heard = self.passed = 0
        """Bytes that the host has written, that came here, and that were written for it, since it opened its end."""
        self.plug_in()

    def plug_in(self) -> None:
        """The host's system finds the port again."""
        with self._lock:
            self._master, slave = os.openpty()
            tty.setraw(slave)
            os.set_blocking(self._master, False)
            os.symlink(os.ttyname(slave), self.port)
            os.close(slave)  # so that the master can tell when somebody opens it

    def pull(self) -> None:
        """The port is gone; the board runs on."""
        with self._lock:
            if self._master is not None:
                os.unlink(self.port)
                os.close(self._master)
            self._master = None
            self._hang_up()

    def inject(self, data: bytes) -> None:
        """Bytes that nobody sent reach the board."""
        self._extra.append(data)

    def close(self) -> None:
        self.pull()
        self._folder.cleanup()

    def open_counted(self, port: str) -> Transport:
        """The host's end as a transport for which the pseudo terminal takes no time, however busy the computer is."""
        with self._lock:
            self._said = self._heard = self.passed = 0
        return _Counted(SerialTransport(port), self)

    def said(self, count: int) -> None:
        self._said += count

    def carry(self, now: float) -> None:
        """Pass on what has come."""
        with self._lock:
            if not self.frozen and self._master is not None and self._host_is_there(self._master):
                self._carry(self._master, now)

    def _host_is_there(self, master: int) -> bool:
        poll = select.poll()
        poll.register(master, select.POLLIN)
        if dict(poll.poll(0)).get(master, 0) & select.POLLHUP:
            self._hang_up()
            return False
        if self._board is None:
            self._board = self.open_board()
        return True

    def _hang_up(self) -> None:
        if self._board is not None:
            self._board.close()
        self._board = None

    def _carry(self, master: int, now: float) -> None:
        assert self._board is not None
        self._to_board.put(self._read(master), now, self.faults)
        try:
            outward = self._to_board.get(now) + b"".join(self._extra.popleft() for _ in range(len(self._extra)))
            if outward:
                self._board.write(outward)
            self._to_host.put(self._board.read(), now, self.faults)
        except LinkLost:
            self._hang_up()
            return
        inward = self._to_host.get(now)
        if inward:
            with contextlib.suppress(BlockingIOError):  # nobody reads: a real line would lose the bytes too
                self.passed += os.write(master, inward)

    def _read(self, master: int) -> bytes:
        data, deadline = b"", time.monotonic() + ARRIVAL_S
        while True:
            with contextlib.suppress(BlockingIOError, OSError):  # nothing there, or closed just now
                data += os.read(master, 4096)
            if self._heard + len(data) >= self._said or time.monotonic() > deadline:
                self._heard += len(data)
                return data


class _Counted:
    """Tells the cable how much it must wait for, and waits for what the cable has passed on."""

    def __init__(self, port: SerialTransport, cable: Cable) -> None:
        self._port, self._cable, self.name = port, cable, port.name
        self._got = 0
        self.close = port.close

    def read(self) -> bytes:
        data, deadline = self._port.read(), time.monotonic() + ARRIVAL_S
        while self._got + len(data) < self._cable.passed and time.monotonic() < deadline:
            data += self._port.read()
        self._got += len(data)
        return data

    def write(self, data: bytes) -> None:
        self._port.write(data)
        self._cable.said(len(data))
