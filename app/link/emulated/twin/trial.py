"""Short experiments on one DC drive: a voltage pulse, or a step of the set-point."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from app.link.emulated.twin.pid import JointPid
from app.link.protocol.codes import DriveKind, Refusal, State, TestKind
from app.link.protocol.messages import Test

if TYPE_CHECKING:
    from app.link.emulated.twin.machine import Machine

MARGIN = 0.05
"""rad or m that the joint stays inside its limits."""
LARGEST_STEP = 0.35
"""rad or m"""
LONGEST_MS = 5000


def check(m: Machine, kind: int, joint: int, amplitude: float, duration_ms: int, not_ready: Refusal) -> Refusal:
    """OK, or why there is no such test now; `not_ready` is the state's own reason."""
    if kind not in tuple(TestKind) or joint >= m.joints or m.drive_kind != DriveKind.DC:
        return Refusal.UNKNOWN
    if not_ready != Refusal.OK:
        return not_ready
    pulse = kind == TestKind.PULSE
    if not abs(amplitude) <= (1.0 if pulse else LARGEST_STEP) or not 0 < duration_ms <= LONGEST_MS:
        return Refusal.VALUE
    if not m.homed:
        return Refusal.NOT_HOMED
    end = m.motion.setpoint[joint] + (0.0 if pulse else amplitude)
    inside = m.room(joint, m.position[joint]) > MARGIN and m.room(joint, end) > MARGIN
    return Refusal.OK if inside else Refusal.LIMIT


class Trial:
    """One test under way."""

    def __init__(self, m: Machine, test: Test, number: int) -> None:
        self.test, self.number = test, number
        self._begin_us = m.now_us
        start = list(m.motion.setpoint)
        if test.kind == TestKind.STEP:
            start[test.joint] += test.amplitude
        m.place(start)

    def pulse_on(self, joint: int) -> float:
        """Share of the supply that this joint gets instead of its PID's output; NaN for none."""
        mine = self.test.kind == TestKind.PULSE and self.test.joint == joint
        return self.test.amplitude if mine else math.nan

    def tick(self, m: Machine) -> None:
        """One control period."""
        joint = self.test.joint
        if not m.room(joint, m.position[joint]) > MARGIN:
            self._hold_here(m)
            m.rest()
        elif m.since(self._begin_us) >= 1000 * self.test.duration_ms:
            self.release(m)
            m.rest()

    def release(self, m: Machine) -> None:
        """The joint is under its PID again."""
        if self.test.kind == TestKind.PULSE and m.state == State.TESTING:
            self._hold_here(m)

    def _hold_here(self, m: Machine) -> None:
        joints = list(m.motion.setpoint)
        joints[self.test.joint] = m.position[self.test.joint]
        m.place(joints)
        m.pids[self.test.joint] = JointPid()
