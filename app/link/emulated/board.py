"""A board that lives in this process: the firmware's core, the machine that it moves, and the cable to it."""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from app.control.drives import DRIVES
from app.link.board_geometry import BOARD_ROBOTS
from app.link.emulated.core import Core, Outputs
from app.link.emulated.cores import make_core
from app.link.emulated.faults import Faults, Line
from app.link.emulated.plant import DcJoint, Joint, Plant, ServoJoint, StepperJoint, Wiring, in_si
from app.link.errors import LinkError
from app.link.protocol.codes import BoardKind, DriveKind, Reset
from app.link.protocol.messages import JOINTS
from app.link.protocol.settings import SETTING_COUNT, setting_id
from app.robots import Robot, make_robot

SERIAL_NUMBER = 1_000_000
"""Emulated boards are numbered from here on, by the number of their robot."""

BOOTLOADER_S = 0.2
"""An Uno loses what comes so soon after a reset. A real one's takes about 1 s."""

_AWAY_FROM_HOME = 0.1
"""How far a sleeping robot's joints are from home, rad or m."""


@dataclass(frozen=True)
class _Model:
    """The board that a robot usually has."""

    board: BoardKind
    drive: DriveKind
    period_us: int
    adc_bits: int = 12


_UNO, _STM32 = BoardKind.UNO, BoardKind.STM32F407
_MODELS = {
    "par4": _Model(_STM32, DriveKind.DC, 1000),
    "delta3": _Model(_UNO, DriveKind.SERVO, 5000, adc_bits=10),
    "linear": _Model(_STM32, DriveKind.STEPPER, 1000),
    "fivebar": _Model(_STM32, DriveKind.DC, 1000),
}


class EmulatedBoard:
    """Time passes only in `advance`: the same calls give the same bytes. Not for several threads at once."""

    def __init__(
        self,
        robot_name: str,
        *,
        drive: DriveKind | None = None,
        faults: Faults = Faults(),  # noqa: B008 (frozen)
        core: Literal["compiled", "twin"] | None = None,
        boot_s: float | None = None,
        serial: int | None = None,
        misaligned: Sequence[float] = (),
    ) -> None:
        """`misaligned`: by how much the board reads each joint too high, rad or m; what calibration has to find."""
        if robot_name not in _MODELS:
            raise LinkError(f"There is no emulated board for {robot_name!r}; choose one of {', '.join(_MODELS)}.")
        self.robot: Robot = make_robot(robot_name)
        self.model = _MODELS[robot_name]
        self.kind = BOARD_ROBOTS[robot_name]
        self.drive = drive or self.model.drive
        self.serial = SERIAL_NUMBER + self.kind if serial is None else serial
        self.faults = faults
        self._misaligned = (*misaligned, *(0.0,) * JOINTS)
        self._boot_us = round(1e6 * (boot_s if boot_s is not None else BOOTLOADER_S * (self.board == _UNO)))
        self._core: Core = make_core(core)
        self._stored: bytes | None = None
        self._now_us, self._due_us = 0, 0.0
        self._into, self._out_of = Line(seed=1), Line(seed=2)
        self.reset(Reset.POWER)
        self._settings = struct.unpack_from(f"<{SETTING_COUNT}f", self._core.image())
        self.plant = Plant([self._joint(number) for number in range(len(self.robot.joint_names))])

    @property
    def board(self) -> BoardKind:
        """Which board it imitates."""
        return self.model.board

    @property
    def time_s(self) -> float:
        """How long it has lived."""
        return 1e-6 * self._now_us

    @property
    def true_joints(self) -> tuple[float, ...]:
        """(n,) where the machine's joints really are, rad or m."""
        return self.plant.positions

    @property
    def powered(self) -> bool:
        return bool(self.outputs.powered)

    @property
    def pen(self) -> bool:
        """Whether the pen's servo stands where the pen is down."""
        up, down = self._setting("pen_up"), self._setting("pen_down")
        return abs(self.outputs.pen_us - down) < abs(self.outputs.pen_us - up)

    @property
    def laser(self) -> float:
        """0..1"""
        return self.outputs.laser

    def reset(self, reset: Reset = Reset.LINE) -> None:
        """The core starts again, as after the reset button; the machine stays where it is."""
        self.outputs = Outputs(False, (0.0,) * 4, 0.0, 0.0)
        self._awake_us = self._now_us + self._boot_us
        self._born_us = self._now_us
        self._into.cut()
        period = self.model.period_us
        self._core.start(self.kind, self.drive, self.board, period, self.serial, reset, self._stored)

    def receive(self, data: bytes) -> None:
        """Bytes from the host."""
        self._into.put(data, self.time_s, self.faults)

    def transmit(self) -> bytes:
        """Bytes that have come to the host since the last call."""
        return self._out_of.get(self.time_s)

    def advance(self, seconds: float) -> None:
        """Let time pass, in whole control periods; what is left over comes with the next call."""
        self._due_us += 1e6 * seconds
        period = self.model.period_us
        while self._due_us >= period:
            self._due_us -= period
            self._now_us += period
            self._period()

    def _period(self) -> None:
        faults, core = self.faults, self._core
        data = self._into.get(self.time_s)
        if self._now_us < self._awake_us:
            return
        if data:
            core.receive(data)
        raw, switches = self.plant.raw(faults), self.plant.switches(faults)
        self.outputs = core.tick((self._now_us - self._born_us) & 0xFFFFFFFF, raw, switches, faults.estop)
        self.plant.advance(self.outputs, faults)
        if core.take_save_request():
            self._stored = core.image()
        answer = core.transmit()
        if answer:
            self._out_of.put(answer, self.time_s, faults)

    def _joint(self, number: int) -> Joint:
        """One joint as it lies when the board gets power for the first time."""
        error = self._misaligned[number]
        low, high, offset = (self._setting(name, number) - error for name in ("min", "max", "offset"))
        wiring = Wiring(offset, self._setting("scale", number), low, high)
        home = float(self.robot.inverse(self.robot.home)[number])
        start = min(home + _AWAY_FROM_HOME, 0.5 * (home + high))
        period_s = 1e-6 * self.model.period_us
        if self.drive == DriveKind.SERVO:
            return ServoJoint(wiring, start, period_s)
        if self.drive == DriveKind.STEPPER:
            return StepperJoint(wiring, start)
        motor = in_si(DRIVES[self.robot.name].motor)
        return DcJoint(wiring, start, motor, self._setting("supply"), period_s, self.model.adc_bits)

    def _setting(self, name: str, joint: int | None = None) -> float:
        """As built in: what the machine was made for."""
        value = self._settings[setting_id(name, joint)]
        return value if math.isfinite(value) else 0.0
