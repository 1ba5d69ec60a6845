"""What to serve and to whom. The command line reads it without loading the page's machinery."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import tyro
from tyro.constructors import PrimitiveConstructorSpec

from app.robots import ROBOTS


def _port(words: list[str]) -> int:
    try:
        port = int(words[0])
    except ValueError:
        raise ValueError(f"{words[0]!r} is not a whole number") from None
    if not 1 <= port <= 65535:
        raise ValueError(f"{port} is not a port, choose one from 1 to 65535")
    return port


def _robot(words: list[str]) -> str:
    if words[0] not in ROBOTS:
        raise ValueError(f"there is no robot {words[0]!r}, choose one of {', '.join(ROBOTS)}")
    return words[0]


def _pin(words: list[str]) -> str:
    if not (words[0].isascii() and words[0].isdigit() and 4 <= len(words[0]) <= 12):
        raise ValueError("a PIN has 4 to 12 digits")
    return words[0]


_PORT = PrimitiveConstructorSpec(
    nargs=1,
    metavar="PORT",
    instance_from_str=_port,
    is_instance=lambda value: isinstance(value, int),
    str_from_instance=lambda port: [str(port)],
)
_ROBOT = PrimitiveConstructorSpec(
    nargs=1,
    metavar="{" + ",".join(ROBOTS) + "}",
    instance_from_str=_robot,
    is_instance=lambda value: value in ROBOTS,
    str_from_instance=lambda name: [name],
)
_PIN = PrimitiveConstructorSpec(
    nargs=1,
    metavar="DIGITS",
    instance_from_str=_pin,
    is_instance=lambda value: value is None or isinstance(value, str),
    str_from_instance=lambda pin: [pin or "random"],
)


@dataclass(frozen=True)
class ServeOptions:
    """Serve the lab's page: every browser that opens it gets a robot of its own."""

    host: Annotated[str, tyro.conf.arg(metavar="ADDRESS")] = "127.0.0.1"
    """Address to listen on. The default is this computer only; 0.0.0.0 lets the network in."""
    port: Annotated[int, _PORT] = 8080
    """Port to listen on."""
    robot: Annotated[str, _ROBOT] = "par4"
    """Robot that a new visitor sees first."""
    open_browser: Annotated[bool, tyro.conf.arg(name="browser")] = True
    """Open the page in this computer's browser."""
    shadows: bool = True
    """Draw shadows; without them a computer that has no graphics processor is twice as quick."""
    allowed_hosts: Annotated[
        tuple[str, ...], tyro.conf.arg(name="allow-host", metavar="NAME"), tyro.conf.UseAppendAction
    ] = ()
    """Name under which browsers may also reach the page, say that of a proxy. May be given several times."""
    serial: Annotated[str | None, tyro.conf.arg(metavar="PORT")] = None
    """Port of the robot on the table: /dev/ttyUSB0, COM3, or an emulated board such as sim:par4 or sim:delta3."""
    pin: Annotated[str | None, _PIN] = None
    """What makes somebody the instructor, who may take the robot over. Without it, one is chosen and printed."""
    classroom: bool = False
    """Lead a class: students join with a name and the code that is printed, the instructor with the PIN."""
    class_name: Annotated[str, tyro.conf.arg(metavar="NAME")] = ""
    """What the class is called, on its reports and in its table of results."""
    data: Annotated[str | None, tyro.conf.arg(metavar="PATH")] = None
    """File or folder that keeps the class and everybody's progress. The default is your user data folder."""
