"""Where the joints are: a DC drive's sensor knows, and the joint goes home; a servo is sent home; a stepper looks for
its switch first."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from app.link.protocol.codes import DriveKind, Fault, State

if TYPE_CHECKING:
    from app.link.emulated.twin.machine import Machine

NEAR = 0.02
"""rad or m"""
SETTLED_US = 100_000
LIMIT_US = 20_000_000
TRAVEL = 1.2
"""Of the joint's range, until its switch must have closed."""


class Homing:
    """One homing, from READY to READY or a fault."""

    def __init__(self, m: Machine) -> None:
        self._searching = set(range(m.joints)) if m.drive_kind == DriveKind.STEPPER else set()
        self._head_home(m)

    def tick(self, m: Machine, dt: float, dt_us: int) -> None:
        """One control period."""
        if not self._searching:
            self._go_home(m, dt, dt_us)
            return
        for joint in sorted(self._searching):
            self._search(m, joint, dt)
            if m.state != State.HOMING:
                return
        if not self._searching:
            self._head_home(m, m.motion.setpoint)

    def _head_home(self, m: Machine, start: list[float] | None = None) -> None:
        m.place(m.position if start is None else start)
        self._begin_us = m.now_us
        m.settled_us = 0

    def _search(self, m: Machine, joint: int, dt: float) -> None:
        low, high = m.limits[joint]
        travelled = m.home_speeds[joint] * 1e-6 * m.since(self._begin_us)
        if m.switches >> joint & 1:
            self._take_origin(m, joint, low)
        elif travelled > TRAVEL * (high - low):
            m.fail(Fault.HOMING, joint + 1)
        else:
            m.motion.approach(joint, -math.inf, m.home_speeds[joint], dt)

    def _take_origin(self, m: Machine, joint: int, low: float) -> None:
        """The switch is where the joint is at its lower limit."""
        offset, scale = m.wiring[joint]
        m.origin[joint] = m.raw[joint] - (low - offset) / scale
        m.position[joint] = m.motion.setpoint[joint] = low
        m.motion.velocity[joint] = 0.0
        self._searching.discard(joint)

    def _go_home(self, m: Machine, dt: float, dt_us: int) -> None:
        for joint in range(m.joints):
            m.motion.approach(joint, m.home[joint], m.home_speeds[joint], dt)
        astray = next((joint + 1 for joint in range(m.joints) if not self._is_home(m, joint)), 0)
        m.settled_us = 0 if astray else m.settled_us + dt_us
        if m.settled_us >= SETTLED_US:
            m.homed = True
            m.place(m.motion.setpoint)
            m.rest()
        elif astray and m.since(self._begin_us) >= LIMIT_US:
            m.fail(Fault.HOMING, astray)

    def _is_home(self, m: Machine, joint: int) -> bool:
        setpoint, home = m.motion.setpoint[joint], m.home[joint]
        at = setpoint if m.drive_kind == DriveKind.SERVO else m.position[joint]
        return setpoint == home and abs(at - home) <= NEAR
