"""How fast and how calm a law is to be: its bandwidth, from which every gain follows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Self

from app.robots import make_robot
from app.robots.limits import drive_limits

Gains = tuple[float, ...]

DECENTRALISED = frozenset({"PD", "PID", "PD+", "PDff"})
"""Laws that control each joint as a mass of its own; the others let the model decouple the robot."""
MAX_HZ = 1000.0


class TuningError(ValueError):
    """A tuning that makes no sense; the message is one sentence for the user."""


@dataclass(frozen=True)
class Tuning:
    """Per axis (joint, or coordinate of the tool): the error obeys edd + 2 zeta w ed + w^2 e = 0."""

    bandwidth_hz: Gains
    """w / 2 pi."""
    damping: Gains
    """zeta."""
    inertia: Gains
    """M_j, kg m^2 or kg: what a decentralised law takes each joint for."""
    integral_rate: float = 25.0
    """Ki / Kp, 1/s."""
    integral_limit: Gains = ()
    """The most that the integral may contribute: N m or N for PID, m/s^2 and rad/s^2 for TSIIDC. Empty: no bound."""
    integral_first: bool = False
    """Whether an error counts in the period in which it is met; else from the next one on."""
    observer_hz: float = 20.0
    """Of the disturbance observer."""
    horizon: int = 12
    """Steps that MPC looks ahead."""
    horizon_step: int = 0
    """Periods in one of these steps; 0: so that the horizon spans a period of the bandwidth."""
    reaching: float = 1.0
    """How strongly sliding mode pulls, in units of its bandwidth."""

    def __post_init__(self) -> None:
        positive = [*self.bandwidth_hz, *self.inertia, *self.damping, self.observer_hz, self.reaching]
        if not all(0.0 < value < math.inf for value in positive) or self.integral_rate < 0.0:
            raise TuningError("Bandwidth, damping and inertia must be numbers above 0, and the integral not below 0.")
        if max(self.bandwidth_hz) > MAX_HZ:
            raise TuningError(
                f"A bandwidth of {max(self.bandwidth_hz):g} Hz is too fast; choose at most {MAX_HZ:g} Hz."
            )
        if not 2 <= self.horizon <= 40:
            raise TuningError(f"MPC looks 2 to 40 steps ahead, not {self.horizon}.")

    @classmethod
    def default(cls, robot: str, law: str) -> Tuning:
        """The spec's settings for linear (A6) and fivebar (B7), round ones for the others."""
        start = _start(robot)
        if robot == "linear" and law in DECENTRALISED:
            return replace(start, damping=(1.1,) * 3)
        if law == "TSIIDC":
            return replace(start, integral_limit=INTEGRAL_ACCELERATION[robot])
        return start

    @classmethod
    def equal(cls, robot: str, law: str, bandwidth_hz: float) -> Tuning:
        """The same bandwidth on every axis and for every law: a fair comparison."""
        tuning = cls.default(robot, law)
        return replace(tuning, bandwidth_hz=(float(bandwidth_hz),) * len(tuning.bandwidth_hz))

    @classmethod
    def from_gains(cls, robot: str, law: str, kp: Sequence[float], kd: Sequence[float], ki: float = 0.0) -> Tuning:
        """From gains per axis: N m/rad or N/m and their like for decentralised laws, 1/s^2 and 1/s for the others.

        `ki` is the first axis' integral gain; the others' keep its ratio to kp.
        """
        tuning = cls.default(robot, law)
        masses = tuning.inertia if law in DECENTRALISED else (1.0,) * len(tuning.inertia)
        if not all(gain > 0.0 for gain in (*kp, *kd)):
            raise TuningError("The gains kp and kd must be above 0.")
        omega = [math.sqrt(gain / mass) for gain, mass in zip(kp, masses, strict=True)]
        damping = [gain / (2.0 * w * mass) for gain, w, mass in zip(kd, omega, masses, strict=True)]
        hertz = tuple(w / math.tau for w in omega)
        return replace(tuning, bandwidth_hz=hertz, damping=tuple(damping), integral_rate=ki / kp[0])

    def changed(self, **values: object) -> Self:
        """A copy with some fields replaced; a single number is taken for every axis."""
        axes = len(self.bandwidth_hz)
        spread = {
            name: (float(value),) * axes if name in PER_AXIS and isinstance(value, int | float) else value
            for name, value in values.items()
        }
        return replace(self, **spread)  # pyright: ignore[reportArgumentType]

    def gains(self) -> tuple[Gains, Gains, Gains]:
        """kp = w^2 (1/s^2), kd = 2 zeta w (1/s), ki (1/s^3) of a unit mass."""
        omega = [math.tau * hertz for hertz in self.bandwidth_hz]
        kp = tuple(w * w for w in omega)
        kd = tuple(2.0 * zeta * w for zeta, w in zip(self.damping, omega, strict=True))
        return kp, kd, tuple(self.integral_rate * gain for gain in kp)

    def joint_gains(self) -> tuple[Gains, Gains, Gains]:
        """The same for masses M_j: Kp = M_j w^2 and so on."""
        kp, kd, ki = (tuple(m * gain for m, gain in zip(self.inertia, gains, strict=True)) for gains in self.gains())
        return kp, kd, ki

    def sum_limits(self, ki: Sequence[float]) -> Gains:
        """Largest sums of errors such that ki times them stays within `integral_limit`."""
        if not self.integral_limit:
            return (math.inf,) * len(ki)
        return tuple(limit / k if k else math.inf for limit, k in zip(self.integral_limit, ki, strict=True))


PER_AXIS = frozenset({"bandwidth_hz", "damping", "inertia", "integral_limit"})

INTEGRAL_ACCELERATION: dict[str, Gains] = {
    "par4": (20.0, 20.0, 20.0, 300.0),
    "delta3": (20.0, 20.0, 20.0),
    "linear": (),
    "fivebar": (20.0, 20.0, 10.0, 300.0),
}
"""m/s^2 and rad/s^2. The 5R's third is the one of the spec's table; 1.25 m/s^2 would fit its motor better."""


@cache
def _start(robot: str) -> Tuning:
    if robot == "linear":
        w = 60.0
        return Tuning((w / math.tau,) * 3, (1.0,) * 3, (3000.0 / w**2,) * 3, 10.0, integral_first=True)
    if robot == "fivebar":
        inertia = (0.614, 0.608, 0.03664, 0.03665)
        return Tuning((30.0, 30.0, 28.0, 28.0), (0.7, 0.7, 0.6, 0.6), inertia, 25.0, (40.0, 40.0, 15.0, 15.0))
    return _declared(robot)


def _declared(robot: str) -> Tuning:
    """9 Hz and damping 0.7; each joint taken for its inertia at home."""
    machine = make_robot(robot)
    masses = machine.dynamics.mass_matrix(machine.home, "joint").diagonal()
    axes = len(masses)
    bound = tuple(0.5 * drive_limits(machine).effort)
    return Tuning((9.0,) * axes, (0.7,) * axes, tuple(map(float, masses)), 10.0, tuple(map(float, bound)))
