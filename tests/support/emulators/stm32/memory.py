"""The memory of a processor that runs in QEMU, read and written from outside through its qtest socket."""

from __future__ import annotations

import socket
import struct

TIMEOUT_S = 20.0


class Memory:
    """Not safe for two threads at once."""

    def __init__(self, connection: socket.socket) -> None:
        self._socket = connection
        self._socket.settimeout(TIMEOUT_S)
        self._answers = self._socket.makefile("r")

    def read(self, address: int, layout: str) -> tuple[float, ...]:
        """The values of a `struct` layout."""
        answer = self._ask(f"read {address:#x} {struct.calcsize(layout):#x}")
        return struct.unpack(layout, bytes.fromhex(answer.removeprefix("0x")))

    def write(self, address: int, layout: str, *values: float) -> None:
        data = struct.pack(layout, *values)
        self._ask(f"write {address:#x} {len(data):#x} 0x{data.hex()}")

    def close(self) -> None:
        self._answers.close()
        self._socket.close()

    def _ask(self, command: str) -> str:
        self._socket.sendall(command.encode() + b"\n")
        answer = self._answers.readline()
        if not answer.startswith("OK"):
            raise ConnectionError(f"QEMU answered {answer!r} to {command!r}.")
        return answer.removeprefix("OK").strip()
