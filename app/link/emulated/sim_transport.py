"""An emulated board that runs in real time, with the interface of a serial port."""

from __future__ import annotations

import threading
import time

from app.link.emulated.board import EmulatedBoard
from app.link.emulated.options import SIM, board_of
from app.link.errors import LinkError, LinkLost
from app.link.protocol.codes import BoardKind, Reset

__all__ = ["SIM", "SimTransport", "open_simulated"]

STEP_S = 0.005
LONGEST_GAP_S = 0.03
"""Where the computer was busy for longer, the board's time stood still: its host had none either, and it would hold."""


def open_simulated(port: str) -> SimTransport:
    """`sim:par4?noise=0.01`: a new board, just switched on.

    Raises:
        LinkError: if the name or an option makes no sense.
    """
    return SimTransport(board_of(port), port)


class SimTransport:
    """Opening resets a board of the Uno's kind, as its USB port does."""

    def __init__(self, board: EmulatedBoard, name: str | None = None) -> None:
        self.board = board
        self.name = name or SIM + board.robot.name
        if board.faults.unplugged:
            raise LinkError(f"The cable of {self.name} is pulled; plug it in and connect again.")
        if board.board == BoardKind.UNO:
            board.reset(Reset.LINE)
        self._lock = threading.Lock()
        self._closed = threading.Event()
        self._last = time.monotonic()
        self._thread = threading.Thread(target=self._run, name=self.name, daemon=True)
        self._thread.start()

    def read(self) -> bytes:
        """What has come by now."""
        with self._lock:
            self._check()
            self._catch_up()
            return self.board.transmit()

    def write(self, data: bytes) -> None:
        with self._lock:
            self._check()
            self._catch_up()
            self.board.receive(data)

    def close(self) -> None:
        """The board stops existing in time."""
        self._closed.set()
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def _run(self) -> None:
        while not self._closed.wait(STEP_S):
            with self._lock:
                self._catch_up()

    def _catch_up(self) -> None:
        now = time.monotonic()
        self.board.advance(min(now - self._last, LONGEST_GAP_S))
        self._last = now

    def _check(self) -> None:
        if self._closed.is_set() or self.board.faults.unplugged:
            raise LinkLost(f"The connection to {self.name} is gone; check the cable and connect again.")
