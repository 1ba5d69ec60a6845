"""The ports of this computer, and the emulated boards, which need none."""

from __future__ import annotations

from dataclasses import dataclass

from serial.tools import list_ports as system

from app.link.board_geometry import BOARD_ROBOTS
from app.link.emulated.sim_transport import SIM
from app.robots import ROBOTS


@dataclass(frozen=True)
class Port:
    """Something that can be connected to."""

    device: str
    """What `open_transport` takes."""
    description: str
    vid: int | None = None
    """USB vendor and product: 2341:0043 is an Arduino Uno."""
    pid: int | None = None
    serial_number: str | None = None
    """Of the USB adapter, where it has one."""
    simulated: bool = False


def list_ports() -> list[Port]:
    """The real ones first, then an emulated board for every robot."""
    found = [
        Port(port.device, port.description or port.device, port.vid, port.pid, port.serial_number)
        for port in sorted(system.comports(), key=lambda port: port.device)
    ]
    emulated = [Port(SIM + name, f"Emulated board: {ROBOTS[name].title}", simulated=True) for name in BOARD_ROBOTS]
    return found + emulated
