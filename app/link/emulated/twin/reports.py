"""What the board says, and when."""

from __future__ import annotations

import struct

from app.link.emulated.twin.machine import Machine
from app.link.protocol.codes import Refusal, State
from app.link.protocol.messages import Ack, Identity, Sample, Telemetry, pack

TELEMETRY_US = 20_000
SAMPLE_US = 4_000
MOST_ANSWERS = 4
"""More are not kept; the host asks again."""

_CLOCK = 0xFFFFFFFF


class Reports:
    """What waits to be sent."""

    def __init__(self) -> None:
        self.identity_number: int | None = None
        self.sample_due = False
        """A test has just begun."""
        self._answers: list[tuple[int, Ack]] = []
        self._telemetry = self._sample = False
        self._telemetry_us = self._sample_us = 0

    @property
    def waiting(self) -> bool:
        return bool(self._answers or self._telemetry or self._sample or self.identity_number is not None)

    def answer(self, number: int, result: Refusal, value: float) -> None:
        """To the frame with this number."""
        if len(self._answers) < MOST_ANSWERS:
            self._answers.append((number, Ack(result, value)))

    def tick(self, m: Machine) -> None:
        """After each control period."""
        if m.since(self._telemetry_us) >= TELEMETRY_US:
            self._telemetry, self._telemetry_us = True, _next(m, self._telemetry_us, TELEMETRY_US)
        if m.state != State.TESTING:
            return
        if self.sample_due or m.since(self._sample_us) >= SAMPLE_US:
            late = m.now_us if self.sample_due else _next(m, self._sample_us, SAMPLE_US)
            self._sample, self._sample_us, self.sample_due = True, late, False

    def take(self, m: Machine, identity: Identity, setpoint_number: int, good: int, bad: int) -> list[bytes]:
        """Everything, as payloads."""
        payloads = [pack(ack, number) for number, ack in self._answers]
        if self.identity_number is not None:
            payloads.append(pack(identity, self.identity_number))
        if self._sample and m.test is not None:
            joint = m.test.test.joint
            payloads.append(pack(Sample(m.now_us, joint, m.position[joint], m.duty[joint]), m.test.number))
        if self._telemetry:
            payloads.append(pack(_telemetry(m, good, bad), setpoint_number))
        self._answers, self.identity_number = [], None
        self._telemetry = self._sample = False
        return payloads


def _next(m: Machine, last_us: int, every_us: int) -> int:
    """When a report was due: on a grid, unless the board comes much too late."""
    return (last_us + every_us) & _CLOCK if m.since(last_us) < 2 * every_us else m.now_us


def _telemetry(m: Machine, good: int, bad: int) -> Telemetry:
    position, setpoint = tuple(map(_as_float32, m.position)), tuple(map(_as_float32, m.motion.setpoint))
    codes = m.state, m.flags, m.fault, m.fault_joint, m.refusal
    numbers = position, setpoint, tuple(m.duty)
    return Telemetry(*codes, m.switches, m.now_us, *numbers, good, bad, 0)


def _as_float32(value: float) -> float:
    """Infinite where 4 bytes are too few."""
    try:
        struct.pack("<f", value)
    except OverflowError:
        return float("inf") if value > 0.0 else float("-inf")
    return value
