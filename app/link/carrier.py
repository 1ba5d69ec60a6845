"""Carries bytes between a pilot and the port that it wants, opens that port and opens it again."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from app.link.errors import LinkError, LinkLost
from app.link.pilot import Pilot
from app.link.ports import Port, list_ports
from app.link.transport import Transport, open_transport

TICK_S = 0.01
"""Between two set-points."""


class Carrier:
    """To be turned by whoever has the time; opening a port takes some milliseconds, nothing else blocks."""

    def __init__(
        self,
        pilot: Pilot,
        open_port: Callable[[str], Transport] = open_transport,
        ports: Callable[[], Sequence[Port]] = list_ports,
    ) -> None:
        self._pilot, self._open_port, self._ports = pilot, open_port, ports
        self._transport: Transport | None = None
        self._opened = ""
        """The wanted port for which the transport was opened."""
        self._plug: Port | None = None
        """What the first connection was made to: a board may come back under another name."""
        self.next_tick_s = 0.0
        """When the pilot is to decide again."""

    def turn(self, now: float) -> None:
        """Read, decide, write."""
        try:
            self._follow_wish(now)
            if self._transport is not None:
                self._pilot.receive(self._transport.read(), now)
            if now >= self.next_tick_s:
                self._tick(now)
            self.write()
        except LinkLost as lost:
            self._close()
            self._pilot.gone(str(lost), now)

    def write(self) -> None:
        """What the pilot wants to say, at once."""
        output = self._pilot.take_output()
        if output and self._transport is not None:
            self._transport.write(output)

    def close(self) -> None:
        self._close()

    def _tick(self, now: float) -> None:
        # on a grid, so that a turn that comes a little late does not make all others late; never two at once
        self.next_tick_s = max(self.next_tick_s + TICK_S, now - TICK_S) if self.next_tick_s else now + TICK_S
        reason = self._pilot.tick(now)
        if reason:
            self._close()
            self._pilot.gone(reason, now)

    def _follow_wish(self, now: float) -> None:
        connection = self._pilot.connection
        if self._transport is not None and (self._opened != connection.port or connection.asked_anew):
            self.write()  # the last word to a board that is left: halt
            self._close()
        if self._transport is None and connection.port and now >= connection.retry_s:
            self._open(connection.port, now)

    def _open(self, port: str, now: float) -> None:
        connection = self._pilot.connection
        if not connection.same_only:
            self._plug = next((known for known in self._ports() if known.device == port), None)
        try:
            self._transport = self._open_port(self._present_name(port) if connection.same_only else port)
        except LinkError as error:
            self._pilot.gone(str(error), now)
        else:
            self._opened = port
            connection.asked_anew = False
            self._pilot.opened(now)

    def _present_name(self, port: str) -> str:
        """Where the same USB adapter is now. LinkLost if another one has taken its place."""
        plug = self._plug
        if plug is None or plug.simulated or plug.vid is None:
            return port
        key = (plug.vid, plug.pid, plug.serial_number)
        same = [known.device for known in self._ports() if (known.vid, known.pid, known.serial_number) == key]
        if not same:
            raise LinkLost(f"The board of {port} is not plugged in; plug it in again.")
        return port if port in same else same[0]

    def _close(self) -> None:
        transport, self._transport, self._opened = self._transport, None, ""
        if transport is not None:
            transport.close()
