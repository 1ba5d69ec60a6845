"""One drive under a controller that runs on a microcontroller: read, compute, hold, once a period."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from app.control import Motor, Pid
from app.control.sampled_pid import Sampling, sampled_pid
from app.simulation.hardware import FINE_STEP_S, Hardware, sensor, shaft


@dataclass(frozen=True)
class DriveLoop:
    """A motor, its hardware, and the program that controls it."""

    motor: Motor
    pid: Pid
    sampling: Sampling = field(default_factory=Sampling)
    hardware: Hardware = field(default_factory=Hardware)


class Trace(NamedTuple):
    """What one drive did; `substeps` values a period."""

    y: list[float]
    """Where the joint was at the start of each step, in the motor's unit."""
    u: list[float]
    """Voltage wanted during each step, limited but before delay and pulse width."""
    ise: float
    """Sum of the squared error at the controller's instants times the period, unit^2 s."""


def fewest_substeps(hardware: Hardware, period_s: float) -> int:
    """Steps of the motor a period: one, unless its hardware has to be computed finely."""
    return math.ceil(period_s / FINE_STEP_S - 1e-9) if hardware.needs_fine_steps else 1


def simulate(
    loop: DriveLoop, reference: Sequence[float], *, substeps: int = 1, start: float = 0.0, seed: int = 0
) -> Trace:
    """The drive from rest at `start`.

    `reference` is the set-point of every period, in the motor's unit. `substeps` is the number of values wanted a
    period; there are more where the hardware has to be computed more finely.
    """
    period = loop.sampling.period_s
    substeps = max(substeps, fewest_substeps(loop.hardware, period))
    law = sampled_pid(loop.pid, loop.sampling, loop.hardware.supply_v, start)
    read = sensor(loop.hardware, seed, len(reference))
    turn = shaft(loop.motor, loop.hardware, period / substeps, start)
    y, ise = start, 0.0
    outputs, controls = [], []
    for r in reference:
        ise += (r - y) * (r - y)
        u = law(r, read(y))
        for _ in range(substeps):
            outputs.append(y)
            controls.append(u)
            y = turn(u)
    return Trace(outputs, controls, ise * period)
