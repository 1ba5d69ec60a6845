"""`deltalab link`: the robot on the cable, from a terminal."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from app.errors import UserMistake
from app.link_console import answer, connected, describe, position_line, robot_of, state_of, stay_for, wait_for

if TYPE_CHECKING:
    from app.link.lease import Person
    from app.link.link import RobotLink
    from app.link.programs import Jog
    from app.robots import Robot

HOMING_S = 60.0
MOTION_S = 120.0
SLOW_SHARE = 0.2
"""Of a joint's speed limit, or of the tool's, where no speed is asked for."""


@dataclass(frozen=True)
class Ports:
    """List serial ports and emulated boards."""


@dataclass(frozen=True)
class Info:
    """Connect to a board and say what it is; nothing moves."""

    port: tyro.conf.Positional[str]
    """Serial port, socket://host:port, or an emulated board such as sim:delta3."""


@dataclass(frozen=True)
class Monitor:
    """Show what a board reports; nothing moves."""

    port: tyro.conf.Positional[str]
    """Serial port, socket://host:port, or an emulated board such as sim:delta3."""
    seconds: float = 0.0
    """End after this time; 0 goes on until Ctrl-C."""
    csv: Path | None = None
    """File for everything that was reported, at full rate."""


@dataclass(frozen=True)
class JogOnce:
    """Move one joint, or one axis of the tool, by a step. Ctrl-C stops the robot."""

    port: tyro.conf.Positional[str]
    """Serial port, socket://host:port, or an emulated board such as sim:delta3."""
    joint: int | None = None
    """Number of the joint, from 1."""
    axis: Annotated[str | None, tyro.conf.arg(metavar="NAME")] = None
    """Or a coordinate of the tool, say z; the robot is homed first."""
    by_deg: float | None = None
    """How far, in degrees."""
    by_mm: float | None = None
    """Or in millimetres."""
    home: bool = False
    """Home the robot first."""


def ports(command: Ports) -> None:
    from app.link.ports import list_ports

    for port in list_ports():
        usb = f"  {port.vid:04x}:{port.pid:04x}" if port.vid is not None and port.pid is not None else ""
        number = f"  serial {port.serial_number}" if port.serial_number else ""
        print(f"{port.device:<16}{port.description}{usb}{number}")


def info(command: Info) -> None:
    with connected(command.port) as link:
        status = wait_for(link, lambda now: now.telemetry is not None)
        print("\n".join(describe(status)))


def monitor(command: Monitor) -> None:
    with connected(command.port) as link:
        answer(link.start_recording())
        try:
            _show(link, command.seconds)
        finally:
            recording = answer(link.stop_recording())
            if command.csv is not None:
                _save(recording.csv(), command.csv)


def jog(command: JogOnce) -> None:
    from app.link.lease import Person

    person = Person("terminal", "The terminal", instructor=True)
    with connected(command.port) as link:
        step, size = read_step(command, robot_of(link))
        try:
            answer(link.request(person))
            _perform(link, person, step, size, homes=command.home or step.space == "pose")
        except KeyboardInterrupt:
            answer(link.stop(person))
            print("Stopped: the motors hold until this command ends; then they go off, and the arms may fall.")
            raise


def read_step(command: JogOnce, robot: Robot) -> tuple[Jog, float]:
    """The jog and its size (rad or m) that a command line asks for."""
    from app.link.programs import Jog

    if (command.joint is None) == (command.axis is None):
        raise UserMistake("Say what is to move: either --joint with its number, or --axis with its name.")
    if (command.by_deg is None) == (command.by_mm is None):
        raise UserMistake("Say how far: either --by-deg or --by-mm.")
    space, names = ("joint", robot.joint_names) if command.joint is not None else ("pose", robot.pose_names)
    index = command.joint - 1 if command.joint is not None else _index(names, str(command.axis))
    if not 0 <= index < len(names):
        raise UserMistake(f"The robot {robot.name} has no such axis: choose a joint from 1 to {len(names)}.")
    unit = robot.joint_unit if space == "joint" else ("m" if index < 3 else "rad")
    by = command.by_mm if unit == "m" else command.by_deg
    if not by:
        measure, option = ("mm", "--by-mm") if unit == "m" else ("degrees", "--by-deg")
        raise UserMistake(f"{names[index]} of {robot.name} moves in {measure}: use {option}, and not by 0.")
    size = by * (1e-3 if unit == "m" else math.pi / 180.0)
    speed = SLOW_SHARE * (0.25 if unit == "m" else 2.0)
    return Jog(space, index, 1 if size > 0.0 else -1, speed), abs(size)


def _perform(link: RobotLink, person: Person, step: Jog, size: float, *, homes: bool) -> None:
    from app.link.protocol.codes import Flag, State

    wait_for(link, lambda now: now.telemetry is not None)
    answer(link.enable(person))
    wait_for(link, lambda now: state_of(now) is State.READY)
    if homes:
        answer(link.home(person))
        stay_for(link, person, lambda now: now.telemetry is not None and Flag.HOMED in now.telemetry.flags, HOMING_S)
        wait_for(link, lambda now: state_of(now) is State.READY)
    print(position_line(link.status))
    answer(link.step(person, step, size))
    stay_for(link, person, lambda now: now.activity == "idle", MOTION_S)
    print(position_line(link.status))
    if state_of(link.status) is not State.READY:
        raise UserMistake(link.status.sentence)
    print("Done. The motors go off now: the arms may fall.")


def _show(link: RobotLink, seconds: float) -> None:
    """One line five times a second."""
    end = time.monotonic() + (seconds or float("inf"))
    while time.monotonic() < end:
        status = wait_for(link, lambda now: now.telemetry is not None)
        print(position_line(status), flush=True)
        time.sleep(0.2)


def _save(text: str, path: Path) -> None:
    try:
        path.write_text(text)
    except OSError as error:
        raise UserMistake(f"Cannot write {path}: {error.strerror}.") from error


def _index(names: tuple[str, ...], wanted: str) -> int:
    if wanted not in names:
        raise UserMistake(f"The tool has no coordinate {wanted!r}: choose one of {', '.join(names)}.")
    return names.index(wanted)
