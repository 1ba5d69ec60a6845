"""The compiled core with four simple joints around it: time moves only when a test says so."""

from __future__ import annotations

import math

from app.control.drives import DRIVES
from app.link.board_geometry import BOARD_ROBOTS
from app.link.emulated.compiled import CompiledCore
from app.link.emulated.core import Outputs
from app.link.firmware.generate import settings
from app.link.protocol.codes import BoardKind, Command, DriveKind, Flag, Refusal, Reset, State, TargetKind
from app.link.protocol.frames import FrameDecoder, encode_frame
from app.link.protocol.messages import Ack, Alive, Get, Message, Order, Sample, Set, Setpoint, Telemetry, pack, unpack
from app.link.protocol.settings import setting_id
from app.robots import make_robot

STEP_MS = 5


class Bench:
    """A board of the host kind. The joints begin at `joints` (rad or m), in the middle of their range by default."""

    def __init__(
        self,
        robot: str = "par4",
        drive: DriveKind = DriveKind.DC,
        *,
        joints: list[float] | None = None,
        reset: Reset = Reset.POWER,
        stored: bytes | None = None,
        serial: int = 7,
    ) -> None:
        self.robot, self.drive = make_robot(robot), drive
        self.values = settings(robot, drive)
        self.count = len(self.robot.joint_names)
        self.home = tuple(self.robot.inverse(self.robot.home).tolist())
        self.joints = joints or [sum(limits) / 2 for limits in self.robot.joint_limits.tolist()]
        """Where they truly are."""
        self.speeds = [0.0] * self.count
        self.stuck: set[int] = set()
        self.raw_is: dict[int, float] = {}
        """Joints whose sensor reads this, whatever the truth."""
        self.switches = 0
        """Closed besides; bit a joint."""
        self.no_switches = False
        self.estop = False
        self.now_us = 0
        self.telemetry: list[Telemetry] = []
        self.samples: list[Sample] = []
        self.acks: dict[int, Ack] = {}
        self.others: list[Message] = []
        self._number = 0
        self._frames = FrameDecoder()
        stepper = drive == DriveKind.STEPPER
        self._zero = [self.joints[j] if stepper else self.setting("offset", j) for j in range(self.count)]
        unit = 1e-3 if self.robot.joint_unit == "m" else math.pi / 180
        self._motor, self._motor_unit = DRIVES[robot].motor.zoh(1e-3 * STEP_MS), unit
        self.core = CompiledCore()
        kind = BOARD_ROBOTS[robot]
        self.core.start(kind, drive, BoardKind.HOST, 1000 * STEP_MS, serial, reset, stored)
        self.outputs = self.tick()

    def setting(self, name: str, joint: int | None = None) -> float:
        return self.values[setting_id(name, joint)]

    def closed(self) -> int:
        """A stepper's switch closes at its lower limit."""
        if self.drive != DriveKind.STEPPER or self.no_switches:
            return self.switches
        return self.switches | sum(
            1 << j for j in range(self.count) if self.joints[j] <= self.setting("min", j) + 2.5e-5
        )

    def tick(self) -> Outputs:
        """One control period of 5 ms; what the board said is sorted afterwards."""
        raw = [self.raw_is.get(j, self._raw(j)) for j in range(self.count)]
        self.outputs = self.core.tick(self.now_us, (*raw, 0.0)[:4], self.closed(), self.estop)
        self.now_us += 1000 * STEP_MS
        self._move_joints()
        self.listen()
        return self.outputs

    def listen(self) -> None:
        for payload in self._frames.feed(self.core.transmit()):
            message, number = unpack(payload)
            if isinstance(message, Telemetry):
                self.telemetry.append(message)
            elif isinstance(message, Ack):
                self.acks[number] = message
            elif isinstance(message, Sample):
                self.samples.append(message)
            else:
                self.others.append(message)

    def send(self, message: Message, number: int | None = None) -> int:
        if number is None:
            self._number += 1
            number = self._number
        self.core.receive(encode_frame(pack(message, number)))
        return number

    def ask(self, message: Message, number: int | None = None) -> Ack:
        number = self.send(message, number)
        self.listen()
        return self.acks.pop(number)

    def order(self, command: Command) -> Refusal:
        return self.ask(Order(command)).result

    def set(self, name: str, value: float, joint: int | None = None) -> Refusal:
        """With effect on what `setting` tells, if it is done."""
        answer = self.ask(Set(setting_id(name, joint), value))
        if answer.result == Refusal.OK:
            self.values[setting_id(name, joint)] = value
        return answer.result

    def get(self, name: str, joint: int | None = None) -> float:
        return self.ask(Get(setting_id(name, joint))).value

    def run(self, ms: float, *, alive: bool = True) -> Telemetry:
        """Time goes by, with or without signs of life; what the board says at the end."""
        for _ in range(round(ms / STEP_MS)):
            if alive:
                self.send(Alive())
            self.tick()
        return self.telemetry[-1]

    def forget(self) -> None:
        """What the board said until now, but for the last."""
        del self.telemetry[:-1]

    def state(self) -> State:
        """At once: telemetry is up to 20 ms old, so the time until the next one passes, with a sign of life."""
        seen = len(self.telemetry)
        self.send(Alive())
        while len(self.telemetry) == seen:
            self.tick()
        return self.telemetry[-1].state

    def aim(self, target: tuple[float, ...], kind: TargetKind = TargetKind.JOINTS, **options) -> None:
        self.send(Setpoint(kind, target, **options))

    def stream(self, target: tuple[float, ...], ms: float, **options) -> Telemetry:
        """The same target every 10 ms."""
        for _ in range(round(ms / 10)):
            self.aim(target, **options)
            self.run(10, alive=False)
        return self.telemetry[-1]

    def refusal_of(self, target: tuple[float, ...], **options) -> Refusal:
        self.aim(target, **options)
        self.state()
        return self.telemetry[-1].refusal

    def make_ready(self, *, homed: bool = True) -> Bench:
        """Powered, and home if asked for."""
        assert self.order(Command.ENABLE) == Refusal.OK
        if homed:
            assert self.order(Command.HOME) == Refusal.OK
            for _ in range(2000):
                if self.run(20).state != State.HOMING:
                    break
            assert self.telemetry[-1].flags & Flag.HOMED and self.telemetry[-1].state == State.READY
        return self

    def towards(self, step: float) -> tuple[float, ...]:
        """Home, with the first joint moved by a step."""
        return (self.home[0] + step, *self.home[1:])

    def _raw(self, joint: int) -> float:
        return (self.joints[joint] - self._zero[joint]) / self.setting("scale", joint)

    def _move_joints(self) -> None:
        if not self.outputs.powered and self.drive != DriveKind.DC:
            return
        for joint in set(range(self.count)) - self.stuck:
            wanted = self.outputs.drive[joint]
            if self.drive == DriveKind.DC:
                self._turn_motor(joint, wanted * self.setting("supply"))
            elif self.drive == DriveKind.STEPPER:
                self.joints[joint] += (round(wanted) - self._raw(joint)) * self.setting("scale", joint)
            else:
                self.joints[joint] = self.setting("offset", joint) + self.setting("scale", joint) * wanted

    def _turn_motor(self, joint: int, volts: float) -> None:
        a, unit = self._motor, self._motor_unit
        y, v = self.joints[joint] / unit, self.speeds[joint] / unit
        self.joints[joint] = (a.a11 * y + a.a12 * v + a.b1 * volts) * unit
        self.speeds[joint] = (a.a21 * y + a.a22 * v + a.b2 * volts) * unit
