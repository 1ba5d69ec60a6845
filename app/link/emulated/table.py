"""Emulated boards that stay on the table: who opens a port again finds the same board, as on a real cable."""

from __future__ import annotations

from app.link.emulated.board import EmulatedBoard
from app.link.emulated.faults import Faults
from app.link.emulated.options import SIM, board_of
from app.link.emulated.sim_transport import SimTransport
from app.link.transport import Transport, open_transport

UNWATCHED_S = 1.0
"""Time that a board is given while nobody is connected: long enough for its watchdogs to switch it off."""


class Table:
    """Opens ports, and remembers the board of every emulated one. One thread opens; any may look."""

    def __init__(self) -> None:
        self._boards: dict[str, EmulatedBoard] = {}

    def open(self, port: str) -> Transport:
        """As `open_transport`; raises LinkError as well while the emulated cable is pulled."""
        if not port.startswith(SIM):
            return open_transport(port)
        board = self._boards.get(port)
        if board is None:
            board = self._boards[port] = board_of(port)
        elif not board.faults.unplugged:
            board.advance(UNWATCHED_S)
        return SimTransport(board, port)

    def faults(self, port: str) -> Faults | None:
        """What is wrong with the emulated board at a port; None for any other port."""
        board = self._boards.get(port)
        return None if board is None else board.faults

    def break_board(self, port: str, faults: Faults) -> None:
        """Give the emulated board at a port these faults."""
        if port in self._boards:
            self._boards[port].faults = faults
