"""What switches the motors off, and what stops them when the host is silent."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.link.protocol.codes import DriveKind, Fault, State

if TYPE_CHECKING:
    from app.link.emulated.twin.machine import Machine

BEYOND = 0.05
"""rad or m that a position may lie beyond its limits."""
RAIL = 0.02
"""Raw value of a potentiometer below which, or so far from 1, its wire is broken."""
AT_SWITCH = 0.005
"""rad or m above `min` up to which a closed switch is no fault."""


def watch(m: Machine, dt_us: int) -> None:
    """Before each period's motion."""
    if m.estop_open and m.state != State.FAULT:
        m.fail(Fault.ESTOP)
    if m.powered:
        _watch_joints(m, dt_us)
    if m.powered:
        _watch_host(m)


def sensor_broken(m: Machine, joint: int) -> bool:
    """A potentiometer at its rail."""
    return m.drive_kind == DriveKind.DC and not RAIL <= m.raw[joint] <= 1.0 - RAIL


def _watch_joints(m: Machine, dt_us: int) -> None:
    for joint in range(m.joints):
        fault = _joint_fault(m, joint, dt_us)
        if fault != Fault.NONE:
            m.fail(fault, joint + 1)
            return


def _joint_fault(m: Machine, joint: int, dt_us: int) -> Fault:
    if sensor_broken(m, joint):
        return Fault.SENSOR
    if _beyond_limits(m, joint):
        return Fault.LIMIT
    if _switch_surprises(m, joint):
        return Fault.SWITCH
    return Fault.FOLLOWING if _lags_behind(m, joint, dt_us) else Fault.NONE


def _beyond_limits(m: Machine, joint: int) -> bool:
    known = m.drive_kind == DriveKind.DC or (m.drive_kind == DriveKind.STEPPER and m.homed)
    return known and m.state != State.HOMING and not m.room(joint, m.position[joint]) >= -BEYOND


def _switch_surprises(m: Machine, joint: int) -> bool:
    closed = bool(m.switches >> joint & 1) and m.state in (State.MOVING, State.TESTING)
    return closed and m.position[joint] > m.limits[joint][0] + AT_SWITCH


def _lags_behind(m: Machine, joint: int, dt_us: int) -> bool:
    error = abs(m.motion.setpoint[joint] - m.position[joint])
    far = m.drive_kind == DriveKind.DC and m.state != State.TESTING and error > m.setting("following")
    m.following_us[joint] = m.following_us[joint] + dt_us if far else 0
    return far and m.following_us[joint] >= 1000.0 * m.setting("following_time")


def _watch_host(m: Machine) -> None:
    hold_us, silent_us = 1000.0 * m.setting("hold_after"), m.since(m.frame_us)
    if silent_us >= 1000.0 * m.setting("off_after"):
        m.power_off(State.OFF)
        return
    waits_for = {State.MOVING: m.since(m.setpoint_us), State.HOMING: silent_us, State.TESTING: silent_us}
    if waits_for.get(m.state, 0) >= hold_us:
        m.stop(State.HELD)
