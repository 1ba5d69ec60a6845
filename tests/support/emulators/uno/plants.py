"""What hangs on the Uno's pins: three joints for each of its variants, moved in step with the processor."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

from tests.support.emulators.uno.uno import UnoSim

JOINTS = range(3)
POWER, ESTOP, LASER, PEN = 12, 2, 5, 8
SWITCHES = (17, 18, 19)
PWM, WAY = (3, 6, 11), (4, 7, 10)
SERVOS = (9, 10, 11)
HOME_RAD = 0.159657397
HOME_M = 0.0835545071


class Plant(Protocol):
    """Joints that move as the pins say."""

    step_us: int
    joints: list[float]
    """rad or m."""

    def attach(self, uno: UnoSim) -> None:
        """Before the first step."""
        ...

    def step(self, uno: UnoSim) -> None:
        """Go on by `step_us`, and show the sensors the new positions."""
        ...


@dataclass
class DcPlant:
    """Geared motors with H-bridges of two equal inputs: speed follows the voltage with a lag."""

    joints: list[float] = field(default_factory=lambda: [HOME_RAD + 0.05] * 3)
    step_us: int = 1000
    supply_v: float = 6.0
    rad_per_s_per_v: float = 1.0
    lag_s: float = 0.04
    stuck: int | None = None
    broken_wire: int | None = None

    def __post_init__(self) -> None:
        self._speeds = [0.0] * 3

    def attach(self, uno: UnoSim) -> None:
        self._show(uno)

    def step(self, uno: UnoSim) -> None:
        powered, h = uno.level(POWER), 1e-6 * self.step_us
        for j in JOINTS:
            share = uno.pwm(PWM[j]) - uno.level(WAY[j])
            goal = self.rad_per_s_per_v * self.supply_v * share if powered else 0.0
            self._speeds[j] += (goal - self._speeds[j]) * (1.0 - math.exp(-h / self.lag_s))
            if j == self.stuck:
                self._speeds[j] = 0.0
            self.joints[j] += h * self._speeds[j]
        self._show(uno)

    def _show(self, uno: UnoSim) -> None:
        """270 degrees of the potentiometer are 5 V; 0 rad lies at 5/12 of it."""
        for j in JOINTS:
            share = self.joints[j] / math.radians(270) + 5 / 12
            uno.analog(j, 0.0 if j == self.broken_wire else 5.0 * share)


@dataclass
class ServoPlant:
    """RC servos: 1500 us is 0 rad, 2000 us pi / 4; without pulses they are limp and stay."""

    joints: list[float] = field(default_factory=lambda: [0.3, 0.3, 0.3])
    step_us: int = 1000
    rad_per_s: float = 8.0

    def attach(self, uno: UnoSim) -> None:
        pass

    def step(self, uno: UnoSim) -> None:
        reach = 1e-6 * self.step_us * self.rad_per_s
        for j, pin in enumerate(SERVOS):
            if uno.rises(pin) == 0 or uno.now_us - uno.risen_us(pin) > 45_000 or not uno.level(POWER):
                continue
            goal = (uno.pulse_us(pin) - 1500) * math.pi / 2000
            self.joints[j] += min(max(goal - self.joints[j], -reach), reach)


@dataclass
class StepperPlant:
    """Carriages with 40 steps a millimetre and a switch at 0; the drivers are enabled by a low level."""

    joints: list[float] = field(default_factory=lambda: [0.004, 0.005, 0.006])
    step_us: int = 1000
    m_per_step: float = 25e-6
    dead_switch: int | None = None

    def attach(self, uno: UnoSim) -> None:
        for step, direction in zip(PWM, WAY, strict=True):
            uno.count_steps(step, direction)
        self._seen = [0, 0, 0]
        self._closed = [False] * 3

    def step(self, uno: UnoSim) -> None:
        enabled = not uno.level(POWER)
        for j in JOINTS:
            steps = uno.steps(PWM[j])
            if enabled:
                self.joints[j] += self.m_per_step * (steps - self._seen[j])
            self._seen[j] = steps
            closed = self.joints[j] <= 0.0 and j != self.dead_switch
            if closed != self._closed[j]:
                uno.drive_pin(SWITCHES[j], not closed)
                self._closed[j] = closed


PLANTS: dict[str, type[DcPlant] | type[ServoPlant] | type[StepperPlant]] = {
    "delta3_dc": DcPlant,
    "delta3_servo": ServoPlant,
    "linear_stepper": StepperPlant,
}
