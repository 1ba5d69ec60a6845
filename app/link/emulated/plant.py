"""The joints that an emulated board moves, with their sensors: what is true, not what the board believes."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace

from app.control import Motor
from app.link.emulated.core import Outputs
from app.link.emulated.faults import Faults
from app.link.protocol.messages import JOINTS

SERVO_SPEED = 8.7
"""Of a hobby servo, rad/s: 0.12 s for 60 degrees."""

END_STOP = 0.2
"""The joints' mechanical ends lie so far beyond their limits, rad."""
END_STOP_M = 0.004
"""Those of a carriage, m: just behind its switch."""


@dataclass(frozen=True)
class Wiring:
    """How one joint is built in: joint = offset + scale * raw, rad or m."""

    offset: float
    scale: float
    low: float
    """Lowest joint value that the machine is made for; a carriage's switch closes here."""
    high: float


class Joint(ABC):
    """One joint: where it is, and what the board can read of it."""

    def __init__(self, wiring: Wiring, position: float) -> None:
        self.wiring = wiring
        self.position = position

    @abstractmethod
    def advance(self, drive: float, powered: bool, stuck: bool) -> None:
        """One control period under this output of the board."""

    def raw(self) -> float:
        """What the board reads."""
        return 0.0

    @property
    def switch_closed(self) -> bool:
        return False


class DcJoint(Joint):
    """A geared motor without load, exact under a held voltage, and a potentiometer behind a converter."""

    def __init__(self, wiring: Wiring, position: float, motor: Motor, supply_v: float, period_s: float, adc_bits: int):
        super().__init__(wiring, position)
        self._step = motor.zoh(period_s)
        self._supply_v = supply_v
        self._levels = 2**adc_bits - 1
        self._low, self._high = wiring.low - END_STOP, wiring.high + END_STOP
        self._speed = 0.0

    def advance(self, drive: float, powered: bool, stuck: bool) -> None:
        if stuck:
            self._speed = 0.0
            return
        a11, a12, a21, a22, b1, b2 = self._step
        u, y, v = drive * self._supply_v if powered else 0.0, self.position, self._speed
        y, v = a11 * y + a12 * v + b1 * u, a21 * y + a22 * v + b2 * u
        if not self._low <= y <= self._high:
            y, v = min(max(y, self._low), self._high), 0.0
        self.position, self._speed = y, v

    def raw(self) -> float:
        share = (self.position - self.wiring.offset) / self.wiring.scale
        return round(min(max(share, 0.0), 1.0) * self._levels) / self._levels


class ServoJoint(Joint):
    """Runs to where its pulse says, as fast as it can; without power it stays."""

    def __init__(self, wiring: Wiring, position: float, period_s: float) -> None:
        super().__init__(wiring, position)
        self._reach = SERVO_SPEED * period_s

    def advance(self, drive: float, powered: bool, stuck: bool) -> None:
        if powered and not stuck and drive > 0.0:
            way = self.wiring.offset + self.wiring.scale * drive - self.position
            self.position += min(max(way, -self._reach), self._reach)


class StepperJoint(Joint):
    """Makes the steps that it is told, on a carriage with a switch at its lower limit; loses those it cannot make."""

    def __init__(self, wiring: Wiring, position: float) -> None:
        super().__init__(wiring, position)
        self._steps = 0.0

    def advance(self, drive: float, powered: bool, stuck: bool) -> None:
        wanted = round(drive)
        if powered and not stuck:
            moved = self.position + self.wiring.scale * (wanted - self._steps)
            self.position = min(max(moved, self.wiring.low - END_STOP_M), self.wiring.high + END_STOP_M)
        self._steps = float(wanted)

    def raw(self) -> float:
        return self._steps

    @property
    def switch_closed(self) -> bool:
        return self.position <= self.wiring.low


class Plant:
    """All joints of a machine."""

    def __init__(self, joints: Sequence[Joint]) -> None:
        self._joints = tuple(joints)
        self._idle = (0.0,) * (JOINTS - len(self._joints))

    @property
    def positions(self) -> tuple[float, ...]:
        """(n,) where the joints are, rad or m."""
        return tuple([joint.position for joint in self._joints])

    def place(self, positions: Sequence[float]) -> None:
        """Somebody moves the joints (n,) by hand."""
        for joint, position in zip(self._joints, positions, strict=True):
            joint.position = position

    def advance(self, outputs: Outputs, faults: Faults) -> None:
        """One control period."""
        powered, stuck = bool(outputs.powered), faults.stuck_joint
        for number, (joint, drive) in enumerate(zip(self._joints, outputs.drive, strict=False)):
            joint.advance(drive, powered, number == stuck)

    def raw(self, faults: Faults) -> tuple[float, ...]:
        """(4,) what the board reads of its joints."""
        values = [joint.raw() for joint in self._joints]
        if faults.sensor_broken is not None and faults.sensor_broken < len(values):
            values[faults.sensor_broken] = 0.0
        return (*values, *self._idle)

    def switches(self, faults: Faults) -> int:
        """Bit a joint, 1 closed."""
        closed = sum(1 << number for number, joint in enumerate(self._joints) if joint.switch_closed)
        return closed | (0 if faults.limit_switch is None else 1 << faults.limit_switch)


def in_si(motor: Motor) -> Motor:
    """The motor with its output in rad or m instead of deg or mm."""
    return replace(motor, K=motor.K * (math.radians(1.0) if motor.unit == "deg" else 1e-3))
