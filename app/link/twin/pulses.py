"""Which voltage pulses show a mounted joint's motor without driving the joint into its limits."""

from __future__ import annotations

import math

from app.control import Motor
from app.control.drives import Drive
from app.link.errors import LinkError
from app.link.protocol.codes import TestKind
from app.link.protocol.messages import Test
from app.simulation.run import SHOWN

GUARD = 0.05
"""The board ends a pulse so close to a limit, rad or m."""
MARGIN = 0.75
"""Part of the room that pulses use by the model; the rest is for a motor stronger than the model."""
SHORTEST_S, LONGEST_S = 0.16, 1.5
"""40 samples at least."""
STRONGEST, WEAKEST = 0.8, 0.08
"""Shares of the supply."""


def pulse_plan(joint: int, position: float, limits: tuple[float, float], drive: Drive) -> list[Test]:
    """There and back, strongly and half as strongly, to the side with more room: to be run one after another.

    Each lasts until the motor has almost reached its speed. `joint` counts from 0; `position` and `limits` (low, high)
    are rad or m. LinkError where the joint stands too close to its limits for any useful pulse.
    """
    low, high = map(float, limits)
    position = float(position)
    room = MARGIN * (max(position - low, high - position) - GUARD)
    spare = min(position - low, high - position) - GUARD
    way = 1.0 if high - position >= position - low else -1.0
    if spare <= 0.0:
        raise LinkError(f"Joint {joint + 1} is too close to its limit for a pulse; move it to the middle of its range.")
    wanted = min(max(4.0 / drive.motor.T1, SHORTEST_S), LONGEST_S)
    for duration in (wanted, SHORTEST_S):
        share = min(STRONGEST, room / travel(drive.motor, drive.supply_v, duration))
        if share >= 2.0 * WEAKEST:
            pulses = (way * share, -way * share, way * share / 2.0, -way * share / 2.0)
            return [Test(TestKind.PULSE, joint, amplitude, round(1e3 * duration)) for amplitude in pulses]
    raise LinkError(f"Joint {joint + 1} has too little room for a pulse; move it to the middle of its range.")


def travel(motor: Motor, volts: float, duration_s: float) -> float:
    """How far a pulse from rest turns the joint by the model, coasting to rest included; rad or m.

    A motor without droop at K u / T1 coasts on until it has turned by K u w / T1 in all; droop only takes away.
    """
    factor = SHOWN["m" if motor.unit == "mm" else "rad"][1]
    return motor.K * abs(volts) * duration_s / motor.T1 / factor if motor.T1 else math.inf
