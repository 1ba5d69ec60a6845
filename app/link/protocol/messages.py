"""What host and board say to each other, as values; one class a message.

Angles in rad, lengths in m. The four numbers of a target, a position or a drive are always four; unused ones are 0.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

from app.link.errors import ProtocolError
from app.link.protocol.codes import (
    BoardKind,
    Command,
    DriveKind,
    Fault,
    Flag,
    MessageType,
    Refusal,
    Reset,
    RobotKind,
    SettingsSource,
    State,
    TargetKind,
    TestKind,
)

Four: TypeAlias = tuple[float, ...]
"""Four numbers, one a joint or a coordinate of the pose."""

JOINTS = 4
_MANUAL, _PEN_DOWN = 1, 2
_FULL_DRIVE = 127


@dataclass(frozen=True)
class Hello:
    """Who are you? Answered by `Identity`."""


@dataclass(frozen=True)
class Alive:
    """The host is there; not answered."""


@dataclass(frozen=True)
class Setpoint:
    """Where to go; not answered, the newest wins."""

    kind: TargetKind
    target: Four
    """Joints or pose."""
    manual: bool = False
    """The tool's speed is limited; joints are accepted before homing."""
    pen_down: bool = False
    laser: int = 0
    """0 to 255, full."""


@dataclass(frozen=True)
class Order:
    """A command, answered by `Ack`."""

    command: Command
    argument: int = 0


@dataclass(frozen=True)
class Set:
    """Change a setting, answered by `Ack` with what holds then."""

    id: int
    value: float


@dataclass(frozen=True)
class Get:
    """Read a setting, answered by `Ack`."""

    id: int


@dataclass(frozen=True)
class Test:
    """A short experiment on one joint, answered by `Ack`, then `Sample`s."""

    kind: TestKind
    joint: int
    """From 0."""
    amplitude: float
    """Share of the supply -1..1, or rad / m."""
    duration_ms: int

    __test__: ClassVar[bool] = False


@dataclass(frozen=True)
class Telemetry:
    """Every 20 ms, unasked; its number is that of the last accepted set-point."""

    state: State
    flags: Flag
    fault: Fault
    fault_joint: int
    """From 1, 0 for none."""
    refusal: Refusal
    limit_switches: int
    """Bit a joint, 1 closed."""
    t_us: int
    """The board's clock, modulo 2^32."""
    position: Four
    setpoint: Four
    drive: Four
    """Share of the supply, -1..1, in steps of 1/127."""
    good: int
    """Frames that the board accepted, modulo 2^16."""
    bad: int
    load: int
    """Percent of the processor in use."""


@dataclass(frozen=True)
class Identity:
    """What the board is."""

    protocol: int
    board: BoardKind
    robot: RobotKind
    drive: DriveKind
    joints: int
    firmware: int
    """major * 256 + minor."""
    period_us: int
    """Of its control."""
    geometry: int
    """Hash of its geometry: see `app.link.board_geometry`."""
    serial: int
    reset: Reset
    settings: SettingsSource

    @property
    def version(self) -> str:
        """Of the firmware, `1.0`."""
        return f"{self.firmware >> 8}.{self.firmware & 0xFF}"


@dataclass(frozen=True)
class Ack:
    """The answer to a command, a setting or a test."""

    result: Refusal
    value: float


@dataclass(frozen=True)
class Sample:
    """Every 4 ms during a test."""

    t_us: int
    joint: int
    """From 0."""
    position: float
    drive: float
    """Share of the supply, -1..1."""


Message: TypeAlias = Hello | Alive | Setpoint | Order | Set | Get | Test | Telemetry | Identity | Ack | Sample


@dataclass(frozen=True)
class _Layout:
    """How one message lies in its bytes."""

    type: MessageType
    fields: str
    """As `struct` writes them, after type and number."""
    to_fields: Callable[[Any], tuple[Any, ...]]
    from_fields: Callable[..., Message]


def _setpoint(kind: int, flags: int, laser: int, *target: float) -> Setpoint:
    return Setpoint(TargetKind(kind), target, bool(flags & _MANUAL), bool(flags & _PEN_DOWN), laser)


def _setpoint_fields(m: Setpoint) -> tuple[Any, ...]:
    return m.kind, _MANUAL * m.manual | _PEN_DOWN * m.pen_down, m.laser, *_four(m.target)


def _telemetry(state: int, flags: int, fault: int, joint: int, refusal: int, switches: int, *rest: Any) -> Telemetry:
    t_us, position, setpoint, drive = rest[0], rest[1:5], rest[5:9], rest[9:13]
    shares = tuple(max(value / _FULL_DRIVE, -1.0) for value in drive)
    codes = State(state), Flag(flags & 0x3F), Fault(fault), joint, Refusal(refusal)
    return Telemetry(*codes, switches, t_us, position, setpoint, shares, *rest[13:])


def _telemetry_fields(m: Telemetry) -> tuple[Any, ...]:
    shares = [round(_FULL_DRIVE * min(max(share, -1.0), 1.0)) for share in _four(m.drive)]
    head = m.state, m.flags, m.fault, m.fault_joint, m.refusal, m.limit_switches, m.t_us
    return *head, *_four(m.position), *_four(m.setpoint), *shares, m.good, m.bad, m.load


def _identity(protocol: int, board: int, robot: int, drive: int, joints: int, *rest: int) -> Identity:
    firmware, period_us, geometry, serial, reset, settings = rest
    numbers = joints, firmware, period_us, geometry, serial
    kinds = BoardKind(board), RobotKind(robot), DriveKind(drive)
    return Identity(protocol, *kinds, *numbers, Reset(reset), SettingsSource(settings))


def _identity_fields(m: Identity) -> tuple[Any, ...]:
    head = m.protocol, m.board, m.robot, m.drive, m.joints
    return *head, m.firmware, m.period_us, m.geometry, m.serial, m.reset, m.settings


def _four(values: Four) -> Four:
    if len(values) > JOINTS:
        raise ValueError(f"A board has {JOINTS} joints at most, not {len(values)}.")
    return (*values, *(0.0,) * (JOINTS - len(values)))


_LAYOUTS: dict[type, _Layout] = {
    Hello: _Layout(MessageType.HELLO, "", lambda m: (), Hello),
    Alive: _Layout(MessageType.ALIVE, "", lambda m: (), Alive),
    Setpoint: _Layout(MessageType.SETPOINT, "BBB4f", _setpoint_fields, _setpoint),
    Order: _Layout(MessageType.COMMAND, "BB", lambda m: (m.command, m.argument), lambda c, a: Order(Command(c), a)),
    Set: _Layout(MessageType.SET, "Bf", lambda m: (m.id, m.value), Set),
    Get: _Layout(MessageType.GET, "B", lambda m: (m.id,), Get),
    Test: _Layout(
        MessageType.TEST,
        "BBfH",
        lambda m: (m.kind, m.joint, m.amplitude, m.duration_ms),
        lambda kind, *rest: Test(TestKind(kind), *rest),
    ),
    Telemetry: _Layout(MessageType.TELEMETRY, "6BI4f4f4bHHB", _telemetry_fields, _telemetry),
    Identity: _Layout(MessageType.IDENTITY, "5BHHIIBB", _identity_fields, _identity),
    Ack: _Layout(MessageType.ACK, "Bf", lambda m: (m.result, m.value), lambda r, v: Ack(Refusal(r), v)),
    Sample: _Layout(MessageType.SAMPLE, "IBff", lambda m: (m.t_us, m.joint, m.position, m.drive), Sample),
}
_STRUCTS = {kind: struct.Struct("<BH" + layout.fields) for kind, layout in _LAYOUTS.items()}
_BY_TYPE = {int(layout.type): kind for kind, layout in _LAYOUTS.items()}

PAYLOAD_FIELDS: dict[MessageType, str] = {layout.type: layout.fields for layout in _LAYOUTS.values()}
"""What follows type and number in each message, as `struct` writes it."""

PAYLOAD_LENGTHS: dict[MessageType, int] = {layout.type: _STRUCTS[kind].size for kind, layout in _LAYOUTS.items()}
"""Bytes of each message, type and number included."""


def pack(message: Message, number: int) -> bytes:
    """The payload of a message. Numbers count on from 65535 to 0.

    Raises:
        ProtocolError: if a number does not fit its field.
    """
    layout = _LAYOUTS[type(message)]
    try:
        return _STRUCTS[type(message)].pack(layout.type, number & 0xFFFF, *layout.to_fields(message))
    except (struct.error, OverflowError) as misfit:
        raise ProtocolError(f"A {type(message).__name__} cannot carry these numbers: {misfit}.") from misfit


def unpack(payload: bytes) -> tuple[Message, int]:
    """The message in a payload, and its number.

    Raises:
        ProtocolError: if this is no message of the protocol.
    """
    kind = _BY_TYPE.get(payload[0]) if payload else None
    if kind is None or len(payload) != _STRUCTS[kind].size:
        raise ProtocolError(f"{len(payload)} bytes that begin with {payload[:1].hex() or 'nothing'} are no message.")
    _, number, *fields = _STRUCTS[kind].unpack(payload)
    try:
        return _LAYOUTS[kind].from_fields(*fields), number
    except ValueError as unknown:
        raise ProtocolError(f"A {kind.__name__} of another protocol version came: {unknown}.") from unknown
