"""The simulated machine beside the real one: what its joints would do under the same set-points."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from app.control import Motor, Pid
from app.control.drives import DRIVES
from app.control.sampled_pid import Sampling
from app.link.errors import LinkError
from app.link.protocol.codes import DriveKind
from app.link.protocol.settings import setting_id
from app.link.twin.gains import gains_from_board
from app.robots import ROBOTS
from app.simulation.hardware import Hardware
from app.simulation.run import SHOWN
from app.simulation.sampled_loop import DriveLoop, simulate

Array = NDArray[np.float64]

SERVO_TIME_S = 0.03
SERVO_SPEED = 8.7
"""rad/s; declared, not measured: 60 degrees in 0.12 s, as data sheets of hobby servos say."""


class Twin(Protocol):
    """A model of all drives of a robot."""

    @property
    def note(self) -> str:
        """What it is, for students."""
        ...

    def follow(self, t: Array, setpoint: Array) -> Array:
        """(k, n) joints at times t (k,), s, under set-points (k, n), from rest at the first one; rad or m."""
        ...


@dataclass(frozen=True)
class DcTwin:
    """Motors, each under the board's PID."""

    motor: Motor
    pids: tuple[Pid, ...]
    """One a joint, in volts per `motor.unit`."""
    period_s: float
    u_max: float
    """Largest voltage."""
    note: str = "The drive model of the control lab under the board's own gains."

    def follow(self, t: Array, setpoint: Array) -> Array:
        """What holds a joint where it stands at first goes on holding it: the model answers to the change."""
        factor = SHOWN["m" if self.motor.unit == "mm" else "rad"][1]
        grid = np.arange(t[0], t[-1] + self.period_s, self.period_s)
        sampling = Sampling(self.period_s, "backward Euler", "clamping")
        joints = np.empty_like(setpoint)
        for joint, pid in enumerate(self.pids):
            change = factor * (np.interp(grid, t, setpoint[:, joint]) - setpoint[0, joint])
            loop = DriveLoop(self.motor, pid, sampling, Hardware(supply_v=self.u_max))
            answer = np.array(simulate(loop, change.tolist()).y) / factor
            joints[:, joint] = setpoint[0, joint] + np.interp(t, grid, answer)
        return joints


@dataclass(frozen=True)
class ServoTwin:
    """Servos with their own controllers: of first order, their speed limited."""

    time_s: float = SERVO_TIME_S
    speed: float = SERVO_SPEED
    """rad/s or m/s."""
    note: str = "Hobby servos report nothing: the measured joints are the set-points, the twin shows the likely delay."

    def follow(self, t: Array, setpoint: Array) -> Array:
        joints = np.empty_like(setpoint)
        y = joints[0] = setpoint[0]
        for k, step in enumerate(np.diff(t).tolist(), 1):
            way = (setpoint[k - 1] - y) * -math.expm1(-step / self.time_s)
            y = joints[k] = y + np.clip(way, -self.speed * step, self.speed * step)
        return joints


@dataclass(frozen=True)
class StepperTwin:
    """Steppers that lose no step are where they were sent."""

    note: str = "Steppers that lose no step are exactly at their set-points."

    def follow(self, t: Array, setpoint: Array) -> Array:
        return setpoint.copy()


def board_twin(
    robot: str, drive: DriveKind, period_us: int, settings: Mapping[int, float], motor: Motor | None = None
) -> Twin:
    """The twin of a board, from what it says of itself (`Identity`) and its settings; `motor` as identified, or that
    of `DRIVES`. LinkError where the settings were not read yet."""
    if drive == DriveKind.SERVO:
        return ServoTwin()
    if drive == DriveKind.STEPPER:
        return StepperTwin()
    kind = ROBOTS[robot].build
    pids = tuple(gains_from_board(settings, joint, kind.joint_unit) for joint in range(len(kind.joint_names)))
    try:
        u_max = settings[setting_id("supply")] * settings[setting_id("duty_max")]
    except KeyError:
        raise LinkError("The board's settings are not known yet; read them first.") from None
    return DcTwin(motor or DRIVES[robot].motor, pids, period_us * 1e-6, u_max)
