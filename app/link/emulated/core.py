"""The firmware's core as the emulated board sees it: compiled from C, or its twin in Python."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from app.link.protocol.codes import BoardKind, DriveKind, Reset, RobotKind


class Outputs(NamedTuple):
    """What a board does with its pins after a control period."""

    powered: bool
    drive: tuple[float, ...]
    """(4,) DC: share of the supply -1..1; servo: pulse in us; stepper: steps to be at."""
    pen_us: float
    """Pulse of the pen's servo."""
    laser: float
    """0..1"""


class Core(Protocol):
    """PROTOCOL.md as a program: bytes and sensors in, bytes and outputs out. It has no clock of its own."""

    def start(
        self,
        robot: RobotKind,
        drive: DriveKind,
        board: BoardKind,
        period_us: int,
        serial: int,
        reset: Reset,
        stored: bytes | None,
    ) -> None:
        """As after a reset; `stored` is an `image` from permanent memory."""
        ...

    def receive(self, data: bytes) -> None: ...

    def tick(self, now_us: int, raw: tuple[float, ...], limit_switches: int, estop_open: bool) -> Outputs:
        """One control period. `raw` (4,): potentiometers 0..1 or steps made; the switches are bits, 1 closed."""
        ...

    def transmit(self) -> bytes:
        """Frames to send, often none."""
        ...

    def image(self) -> bytes:
        """The settings as they go to permanent memory: 76 floats and their CRC."""
        ...

    def take_save_request(self) -> bool:
        """True once after each SAVE that was granted."""
        ...
