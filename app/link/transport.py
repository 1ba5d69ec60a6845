"""Bytes to and from a board, whatever lies between: a serial port, a socket, or a board emulated in this process."""

from __future__ import annotations

from typing import Protocol

import serial

from app.link.emulated.sim_transport import SIM, open_simulated
from app.link.errors import LinkError, LinkLost

BAUD = 115_200
_AT_ONCE = 4096
_WRITE_TIMEOUT_S = 0.05
"""Not 0: pyserial 3.5 would spin for ever on a port whose buffer is full."""


class Transport(Protocol):
    """An open way to a board. `read` and `write` raise `LinkLost` once the cable is gone."""

    @property
    def name(self) -> str:
        """The port, as it was opened."""
        ...

    def read(self) -> bytes:
        """What has come, at once; often nothing."""
        ...

    def write(self, data: bytes) -> None: ...

    def close(self) -> None:
        """Also twice, also after the cable was pulled."""
        ...


def open_transport(port: str) -> Transport:
    """Open `/dev/ttyUSB0`, `COM3`, `socket://host:port` or an emulated board, `sim:par4?noise=0.01`.

    Raises:
        LinkError: if there is no such port, or somebody else has it.
    """
    return open_simulated(port) if port.startswith(SIM) else SerialTransport(port)


class SerialTransport:
    """Through pyserial. Opening resets an Arduino Uno: it answers after about a second."""

    def __init__(self, port: str) -> None:
        self.name = port
        try:
            self._serial = serial.serial_for_url(port, BAUD, timeout=0, write_timeout=_WRITE_TIMEOUT_S, exclusive=True)
        except (OSError, ValueError) as problem:
            raise LinkError(_why_not(port, problem)) from problem

    def read(self) -> bytes:
        try:
            return self._serial.read(_AT_ONCE)
        except OSError as problem:
            raise self._lost() from problem

    def write(self, data: bytes) -> None:
        """A board that takes nothing loses these bytes: what is old is worth nothing, and its silence is noticed."""
        try:
            self._serial.write(data)
        except serial.SerialTimeoutException:
            return
        except OSError as problem:
            raise self._lost() from problem

    def close(self) -> None:
        self._serial.close()

    def _lost(self) -> LinkLost:
        return LinkLost(f"The connection to {self.name} is gone; check the cable and connect again.")


def _why_not(port: str, problem: Exception) -> str:
    reason = str(problem).lower()
    if "permission" in reason or "access is denied" in reason:
        return f"You may not use {port}; close other programs that use it, or join the group `dialout` (Linux)."
    if "lock" in reason or "busy" in reason:
        return f"Another program uses {port}; close it and connect again."
    if "refused" in reason or "timed out" in reason:
        return f"Nothing answers at {port}; start the board's server there and connect again."
    return f"There is no port {port}; plug the board in and choose one of the list."
