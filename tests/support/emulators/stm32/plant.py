"""The machine around the processor: motors that turn, sensors that see it, and faults that can be switched on."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from app.control.drives import DRIVES
from app.link.firmware.generate import settings
from app.link.protocol.codes import DriveKind
from app.link.protocol.settings import setting_id
from app.simulation.hardware import Hardware, shaft

JOINTS = 4
STEP_S = 1e-3
MAX_STEPS = 200
"""Control periods made up for at once, after the thread had to wait."""
ADC_STEPS = 4095


@dataclass
class Faults:
    """What is broken at the moment."""

    estop_open: bool = False
    broken_sensor: int | None = None
    stuck_joint: int | None = None
    limit_switch: int | None = None


@dataclass
class Sensors:
    """What the processor is to read."""

    raw: list[float] = field(default_factory=lambda: [0.5] * JOINTS)
    switches: int = 0
    estop_open: bool = False


class Plant:
    """Four joints, moved on by the control periods that the processor has made: its time, not ours.

    Sensors are mounted as the built-in settings have it.
    """

    def __init__(self, robot: str, drive: DriveKind) -> None:
        self.faults = Faults()
        built_in = settings(robot, drive)
        self._offset = [built_in[setting_id("offset", joint)] for joint in range(JOINTS)]
        self._scale = [built_in[setting_id("scale", joint)] or 1.0 for joint in range(JOINTS)]
        self._stepper = drive is DriveKind.STEPPER
        self._supply_v, self._motor = DRIVES[robot].supply_v, DRIVES[robot].motor
        middle = [offset + 0.5 * scale for offset, scale in zip(self._offset, self._scale, strict=True)]
        self.put([0.05] * JOINTS if self._stepper else middle)

    def put(self, joints: list[float]) -> None:
        """The joints stand there, at rest: rad, or m for a stepper's carriage."""
        self.joints = list(joints)
        self._start = list(joints)
        self._shafts = [shaft(self._motor, Hardware(), STEP_S) for _ in joints]
        self._steps = [0.0] * JOINTS

    def run(self, periods: int, powered: bool, drive: tuple[float, ...]) -> None:
        """Moves on by so many milliseconds under what the processor's outputs are: shares of the supply, or steps."""
        for joint, share in enumerate(drive):
            if joint == self.faults.stuck_joint:
                continue
            if self._stepper:
                self._step(joint, round(share) if powered else self._steps[joint])
            else:
                self._turn(joint, min(periods, MAX_STEPS), self._supply_v * share if powered else 0.0)

    def sensors(self) -> Sensors:
        raw = list(self._steps) if self._stepper else [self._potentiometer(joint) for joint in range(JOINTS)]
        broken, switch = self.faults.broken_sensor, self.faults.limit_switch
        if broken is not None:
            raw[broken] = 0.0
        switches = sum(1 << joint for joint in range(JOINTS) if self._stepper and self._is_at_switch(joint))
        if switch is not None:
            switches |= 1 << switch
        return Sensors(raw, switches, self.faults.estop_open)

    def _is_at_switch(self, joint: int) -> bool:
        return self.joints[joint] < self._scale[joint]

    def _step(self, joint: int, target: float) -> None:
        """The switch at 0 also keeps the driver from stepping farther, however late the processor hears of it."""
        self._steps[joint] = max(target, math.ceil(-self._start[joint] / self._scale[joint]))
        self.joints[joint] = self._start[joint] + self._scale[joint] * self._steps[joint]

    def _turn(self, joint: int, periods: int, volts: float) -> None:
        turned = 0.0
        for _ in range(periods):
            turned = self._shafts[joint](volts)
        if periods:
            self.joints[joint] = self._start[joint] + math.radians(turned)

    def _potentiometer(self, joint: int) -> float:
        share = (self.joints[joint] - self._offset[joint]) / self._scale[joint]
        return round(ADC_STEPS * min(max(share, 0.0), 1.0)) / ADC_STEPS
