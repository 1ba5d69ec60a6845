"""The compiled core and its twin, given the same life: bytes, sensors and time; what they then say and do."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from app.control.drives import DRIVES
from app.link.board_geometry import BOARD_ROBOTS
from app.link.emulated.compiled import CompiledCore
from app.link.emulated.core import Outputs
from app.link.emulated.faults import Faults
from app.link.emulated.plant import DcJoint, Joint, Plant, ServoJoint, StepperJoint, Wiring, in_si
from app.link.emulated.twin.core import TwinCore
from app.link.emulated.twin.settings import Store
from app.link.protocol.codes import BoardKind, DriveKind, Flag, Reset
from app.link.protocol.frames import FrameDecoder, encode_frame
from app.link.protocol.messages import Message, Telemetry, pack, unpack
from app.link.protocol.settings import setting_id
from app.robots import make_robot

PERIOD_US = 5000
SERIAL = 4711


@dataclass
class Answers:
    """What one core has sent, by time and number."""

    decoder: FrameDecoder = field(default_factory=FrameDecoder)
    telemetry: list[Telemetry] = field(default_factory=list)
    others: list[tuple[Message, int]] = field(default_factory=list)

    def take(self, data: bytes) -> None:
        """Everything must be a message."""
        for payload in self.decoder.feed(data):
            message, number = unpack(payload)
            if isinstance(message, Telemetry):
                self.telemetry.append(message)
            else:
                self.others.append((message, number))
        assert self.decoder.bad == 0


class TwoCores:
    """The plant obeys the compiled one; both see it."""

    def __init__(
        self,
        robot_name: str,
        drive: DriveKind,
        reset: Reset = Reset.POWER,
        stored: bytes | None = None,
        now_us: int = 0,
    ) -> None:
        self.robot = make_robot(robot_name)
        kind = BOARD_ROBOTS[robot_name]
        self.compiled, self.twin = CompiledCore(), TwinCore()
        for core in (self.compiled, self.twin):
            core.start(kind, drive, BoardKind.HOST, PERIOD_US, SERIAL, reset, stored)
        self.store = Store(kind, drive, None)
        self.faults = Faults()
        self.number, self.now_us = 0, now_us
        self.said = (Answers(), Answers())
        self.plant = Plant([self._joint(drive, number) for number in range(len(self.robot.joint_names))])
        self.worst = 0.0
        """Largest difference of an output, as a share of what it may be; but for manual mode."""

    @property
    def telemetry(self) -> Telemetry | None:
        """The compiled core's newest."""
        return self.said[0].telemetry[-1] if self.said[0].telemetry else None

    def send(self, message: Message) -> None:
        """To both, as a frame."""
        self.number += 1
        self.send_bytes(encode_frame(pack(message, self.number)))

    def send_bytes(self, data: bytes) -> None:
        """To both, as they are."""
        self.compiled.receive(data)
        self.twin.receive(data)

    def run(self, periods: int, dt_us: int = PERIOD_US) -> None:
        """Let time pass; both must do the same all the time."""
        for _ in range(periods):
            self.now_us = (self.now_us + dt_us) & 0xFFFFFFFF
            inputs = self.plant.raw(self.faults), self.plant.switches(self.faults), self.faults.estop
            real, twin = (core.tick(self.now_us, *inputs) for core in (self.compiled, self.twin))
            for answers, core in zip(self.said, (self.compiled, self.twin), strict=True):
                answers.take(core.transmit())
            if not (self.telemetry and self.telemetry.flags & Flag.MANUAL):
                self.worst = max(self.worst, _difference(real, twin))
            self.plant.advance(real, self.faults)

    def _joint(self, drive: DriveKind, number: int) -> Joint:
        value = self.store.values
        offset, scale, low, high = (value[setting_id(name, number)] for name in ("offset", "scale", "min", "max"))
        wiring, period_s = Wiring(offset, scale, low, high), 1e-6 * PERIOD_US
        start = min(value[setting_id("home", number)] + 0.03, high)
        if drive == DriveKind.SERVO:
            return ServoJoint(wiring, start, period_s)
        if drive == DriveKind.STEPPER:
            return StepperJoint(wiring, start)
        motor = in_si(DRIVES[self.robot.name].motor)
        return DcJoint(wiring, start, motor, value[setting_id("supply")], period_s, adc_bits=12)


def _difference(real: Outputs, twin: Outputs) -> float:
    """0 for the same; 1 for a full drive against none, or a difference of state."""
    if real.powered != twin.powered:
        return math.inf
    pairs = [*zip(real.drive, twin.drive, strict=True), (real.pen_us, twin.pen_us), (real.laser, twin.laser)]
    return max(abs(a - b) / max(1.0, abs(a)) for a, b in pairs)


def differing(a: Telemetry, b: Telemetry, tolerance: float) -> list[str]:
    """Names of the fields in which two reports are not the same."""
    exact = ["state", "flags", "fault", "fault_joint", "refusal", "limit_switches", "t_us", "good", "bad"]
    found = [name for name in exact if getattr(a, name) != getattr(b, name)]
    return found + [
        name for name in ("position", "setpoint") if not close(getattr(a, name), getattr(b, name), tolerance)
    ]


def close(a: Sequence[float], b: Sequence[float], tolerance: float) -> bool:
    """Whether all numbers are the same but for rounding; two that are infinite are."""
    return all(x == y or abs(x - y) <= tolerance for x, y in zip(a, b, strict=True))
